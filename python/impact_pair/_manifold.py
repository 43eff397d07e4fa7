"""Parameter manifolds, figures 10 and 11, by matplotlib: with the colours, dashes, marks and names of the command line."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from ._kinds import BLUE, GREY, VERMILION
from .bounds import middles

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .answers import Curve, Manifold
    from .bounds import Doubles

#: Colour, width and name of a part, by what is proved of it.
PARTS = {
    "stable": (BLUE, 2.5, "admissible and stable"),
    "unstable": (VERMILION, 1.2, "admissible, unstable"),
    "earlier": (GREY, 0.6, "a wall is touched earlier"),
}
#: Symbols of points, and their names.
MARKS = {"fold": ("o", "fold"), "pitchfork": ("s", "pitchfork"), "graze": ("x", "graze of the near wall")}


def sides(found: Manifold) -> tuple[int, ...]:
    """Return the signs of what is drawn: over the velocity both walls, one the mirror image of the other (72)."""
    return (1, -1) if found.document["over"] == "velocity" else (1,)


def kind(part: dict[str, Any]) -> str:
    """Return the kind of a part of a curve."""
    if part["physical"] is False:
        return "earlier"
    return "stable" if part["stability"] == "stable" else "unstable"


def stretches(curve: Curve) -> Iterator[tuple[str, bool, slice]]:
    """Yield kind, whether ``sin th0 > 0``, and the points of each stretch of one kind."""
    numbered = [(i, part) for i, part in enumerate(curve.parts) if part is not None]
    looks = [(i, kind(part), part["sine"] != "negative") for i, part in numbered]
    for (name, is_solid, _), run in groupby(enumerate(looks), lambda one: (one[1][1], one[1][2], one[1][0] - one[0])):
        numbers = [look[0] for _, look in run]
        yield name, is_solid, slice(numbers[0], numbers[-1] + 2)


def draw(found: Manifold, ax: Any) -> None:
    """Draw curves and marks."""
    for curve in found.curves:
        x, y = middles(curve.at_bounds), middles(curve.amplitude_bounds)
        for side in sides(found):
            for name, is_solid, part in stretches(curve):
                colour, width, _ = PARTS[name]
                style = "-" if is_solid else "--"
                ax.plot(side * x[part], y[part], style, color=colour, linewidth=width)
            for mark, (symbol, _) in MARKS.items():
                at = [one == mark for one in curve.marks]
                ax.plot(side * x[at], y[at], symbol, color="black", markerfacecolor="none", markersize=5, linestyle="none")


def explain(found: Manifold, ax: Any) -> None:
    """Draw the legend below, of what there is."""
    from matplotlib.lines import Line2D

    kinds = {name for curve in found.curves for name, _, _ in stretches(curve)}
    marks = {mark for curve in found.curves for mark in curve.marks}
    lines = [Line2D([], [], color=colour, linewidth=width, label=label) for name, (colour, width, label) in PARTS.items() if name in kinds]
    lines += [
        Line2D([], [], color="black", marker=symbol, markerfacecolor="none", markersize=5, linestyle="none", label=label)
        for mark, (symbol, label) in MARKS.items()
        if mark in marks
    ]
    lines += [Line2D([], [], color="none", label=r"solid: $\sin\theta_0 > 0$, dashed: $< 0$")]
    ax.legend(handles=lines, fontsize="x-small", loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=3, frameon=False)


def name(found: Manifold, ax: Any) -> None:
    """Write the names of the curves at those of their ends that are further apart."""
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    ends: dict[int, list[tuple[int, Doubles]]] = {0: [], -1: []}
    for curve in found.curves:
        x, y = middles(curve.at_bounds), middles(curve.amplitude_bounds)
        points = np.concatenate([np.stack([side * x, y], -1) for side in sides(found)])
        points = points[np.argsort(points[:, 0])]
        inside = points[(points[:, 0] >= left) & (points[:, 0] <= right) & (points[:, 1] >= bottom) & (points[:, 1] <= top)]
        for end, places in ends.items():
            if len(inside):
                places.append((curve.cycles, inside[end]))

    def room(end: int) -> float:
        places = [place / [right - left, top - bottom] for _, place in ends[end]]
        return min((np.abs(a - b).max() for i, a in enumerate(places) for b in places[:i]), default=1.0)

    end = max((-1, 0), key=room)
    for cycles, place in ends[end]:
        is_high = place[1] > 0.95 * top
        offset = (4, -9 if is_high else -3) if end else (6, 5)
        ax.annotate(f"$N = {cycles}$", place, offset, textcoords="offset points", fontsize="x-small", annotation_clip=False)


def magnify(found: Manifold, ax: Any, window: tuple[tuple[float, float], tuple[float, float]]) -> None:
    """Frame a window, and draw it again above d/2, beyond which the curves that tend to it do not go."""
    from matplotlib.patches import Rectangle

    (x0, x1), (y0, y1) = window
    ax.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, facecolor="none", edgecolor="black", linewidth=0.7))
    part = ax.inset_axes([0.42, 0.74, 0.56, 0.2], xlim=window[0], ylim=window[1])
    part.tick_params(labelsize="x-small")
    part.set_title("in the frame, magnified", fontsize="x-small", loc="left", pad=2)
    draw(found, part)
