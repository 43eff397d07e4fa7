"""The report's two pictures."""
from pathlib import Path

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "impact-pair"  # names inside the file that do not change
import matplotlib.pyplot as plt  # noqa: E402 (the backend comes first)

from claims import Verdict
from report import OURS
from runs import SIMULATORS

COLOURS = ("#D55E00", "#CC79A7", "#56B4E9", "#E69F00", "#009E73")  # Okabe and Ito: distinguishable by all eyes
MARKS = ("o", "s", "^", "D", "v")
CLASS_COLOURS = {Verdict.RIGHT: "#009E73", Verdict.INEXACT: "#F0E442", Verdict.MISSED: "#D55E00",
                 Verdict.INVENTED: "#CC79A7", Verdict.UNKNOWN: "#BBBBBB", "undecided": "#FFFFFF"}
HATCHES = {Verdict.RIGHT: "", Verdict.INEXACT: "..", Verdict.MISSED: "//", Verdict.INVENTED: "xx",
           Verdict.UNKNOWN: "--", "undecided": "oo"}
FLOOR = 1e-17  # periods; a smaller error is drawn here


def save(figure: plt.Figure, path: Path) -> None:
    """As SVG without a date, so that the same numbers give the same file."""
    figure.savefig(path, metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)


def errors(path: Path, errors_of: list[list[float]], widths: dict[str, list[float]], title: str) -> None:
    """True errors (periods) against the number of the impact, for each reference; and certified widths."""
    figure, axes = plt.subplots(figsize=(9, 5.2))
    for simulator, line, colour, mark in zip(SIMULATORS, errors_of, COLOURS, MARKS):
        axes.semilogy(range(1, len(line) + 1), [max(error, FLOOR) for error in line], color=colour, marker=mark,
                      markersize=3.5, linewidth=1, markevery=4, label=f"error: {simulator.name}")
    for (name, line), style in zip(widths.items(), ("--", "-")):
        axes.semilogy(range(1, len(line) + 1), line, color="black", linestyle=style, linewidth=1.6,
                      label=f"guaranteed width: {name}")
    axes.axhline(1e-6, color="grey", linewidth=0.8, linestyle=":")
    axes.set_xlabel("impact")
    axes.set_ylabel("error or width of the time, in periods 2π/W")
    axes.set_title(title)
    axes.grid(alpha=0.25)
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False)
    save(figure, path)


def bars(path: Path, counts: dict[str, dict[str, int]], title: str) -> None:
    """Classes of the hard flights as stacked bars, one for each simulator."""
    figure, axes = plt.subplots(figsize=(9, 3.2))
    names = list(counts)
    left = [0] * len(names)
    for name in (*Verdict, "undecided"):
        sizes = [counts[simulator].get(name, 0) for simulator in names]
        if any(sizes):
            axes.barh(names, sizes, left=left, color=CLASS_COLOURS[name], hatch=HATCHES[name], edgecolor="black",
                      linewidth=0.6, label=str(name))
        for row, size in enumerate(sizes):
            if size >= 8:
                axes.text(left[row] + size / 2, row, size, ha="center", va="center", fontsize=8,
                          bbox={"facecolor": "white", "edgecolor": "none", "pad": 1})
        left = [before + size for before, size in zip(left, sizes)]
    axes.invert_yaxis()
    axes.set_xlim(0, max(left))
    axes.set_xlabel("flights")
    axes.set_title(title)
    axes.get_yticklabels()[names.index(OURS)].set_fontweight("bold")
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False)
    save(figure, path)
