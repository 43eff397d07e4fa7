"""Pictures by matplotlib: one function per panel; each takes an ``Axes`` (or makes one) and returns it.

What is certified is drawn from its bounds: bands between them, and a line or dots in their middles. The paper's figures, each in a line::

    impact_pair.plots.figure(14)

Each function takes ``width``, ``"single"`` or ``"double"`` for a column or a page of a journal, or inches, and ``header``, whether the
parameters and what is certified are written above it: by default where it makes its ``Axes`` itself.

Panels are those of the paper's figures 12-17: (a) ``displacement``, (b) ``velocity``, (c) ``phase_plane``, (d)
``absolute_phase_plane``, (e) ``switch_plane``, (f) ``absolute_switch_plane``, (g) ``section_left``, (h) ``section_right``.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ._kinds import BLUE, CLASSES, GREEN, GREY, VERMILION, class_of, colours_of, kinds_of
from .answers import Manifold
from .bounds import middles, outward
from .errors import RangeError
from .scene import Scene
from .sweep import SweepResult

if TYPE_CHECKING:
    from .bounds import Doubles
    from .orbit import Orbit

    #: A width of a figure: of a column or a page of a journal, or in inches.
    Width = Literal["single", "double"] | float | None
    #: What is magnified: from where to where, on both axes.
    Window = tuple[tuple[float, float], tuple[float, float]]

#: Points of a curve per forcing period.
IN_A_CYCLE = 200
#: Widths of figures in journals [inches]: 90 and 190 mm.
WIDTHS = {"single": 90 / 25.4, "double": 190 / 25.4}
#: Kinds of outcomes that a legend names.
MOST_NAMED = 12


def _axes(width: Width) -> Any:
    from matplotlib import pyplot as plt

    inches = WIDTHS[width] if isinstance(width, str) else width
    size = None if inches is None else (inches, 0.75 * inches)
    return plt.subplots(figsize=size, layout="constrained")[1]


def _drawn(draw: Callable[..., None]) -> Callable[..., Any]:
    """Make a picture of what draws on an ``Axes``."""

    @functools.wraps(draw)
    def picture(found: Any, ax: Any | None = None, *given: Any, width: Width = None, header: bool | None = None, **how: Any) -> Any:
        own = _axes(width) if ax is None else ax
        draw(found, own, *given, **how)
        if header or (header is None and ax is None):
            own.set_title("\n".join(_said(found)), fontsize="small", loc="left")
        return own

    return picture


def _said(found: Any) -> list[str]:
    """Return the lines of a header: the parameters that do not vary in exact words, and what is certified."""
    varied: set[str] = set()
    scene = found.head["scene"] if isinstance(found, SweepResult) else found.document["scene"]
    said = repr(found).splitlines()[-1].strip("<>")
    if isinstance(found, Manifold):
        varied, said = {"amplitude", "frequency"} if found.document["over"] == "frequency" else {"amplitude"}, "certified at each point"
    if isinstance(found, SweepResult):
        varied = {over["key"] for over in found.head["over"]}
    given = {key: ", ".join(value) for key, value in scene["excitation"].items()} | {
        "gap": scene["gap"],
        "restitution": scene["restitution"],
    }
    names = {"amplitude": "A", "frequency": "Ω", "phase": "τ", "gap": "d", "restitution": "e"}
    return [", ".join(f"{name} = {given[key]}" for key, name in names.items() if key not in varied), said]


def _angles(ax: Any, axis: str) -> None:
    """Set the ticks of an axis of phases: quarters of 2 pi, endpoints included."""
    setter = {"x": (ax.set_xlim, ax.set_xticks), "y": (ax.set_ylim, ax.set_yticks)}[axis]
    setter[0](0, 2 * math.pi)
    setter[1]([0.5 * math.pi * k for k in range(5)], ["0", "π/2", "π", "3π/2", "2π"])


def _terms(orbit: Orbit) -> list[tuple[float, float, float]]:
    """Return amplitude, frequency and phase of each harmonic as doubles, for pictures."""
    shaken = orbit.scene["excitation"]
    columns = [_floats(shaken[key]) for key in ("amplitude", "frequency", "phase")]
    return list(zip(*columns, strict=True))


def _floats(texts: list[str]) -> list[float]:
    return [float(x) for x in middles(outward((text, text) for text in texts))]


def _shaking(orbit: Orbit, t: Doubles) -> tuple[Doubles, Doubles]:
    """E and E' of (1), in floating point."""
    terms = _terms(orbit)
    moved = sum((a * np.sin(w * t + tau) for a, w, tau in terms), np.zeros_like(t))
    speed = sum((a * w * np.cos(w * t + tau) for a, w, tau in terms), np.zeros_like(t))
    return np.asarray(moved), np.asarray(speed)


def _cycle(orbit: Orbit) -> float:
    """2 pi/W of the fastest harmonic."""
    return 2 * math.pi / max(w for _, w, _ in _terms(orbit))


def _times(orbit: Orbit, cycles: float) -> Doubles:
    start = _floats([orbit.scene["start"]["time"]])[0]
    end = start + cycles * _cycle(orbit)
    even = np.linspace(start, end, int(cycles * IN_A_CYCLE) + 1)
    near = orbit.t[orbit.t < end]
    return np.unique(np.concatenate([even, near - 1e-9, near + 1e-9]))


@_drawn
def displacement(orbit: Orbit, ax: Any, cycles: float = 8) -> None:
    """Draw (a): y [length] over t [time], with the walls."""
    found = orbit(_times(orbit, cycles))
    ax.fill_between(found.t, *found.y_bounds.T, color=BLUE, alpha=0.3, linewidth=0)
    ax.plot(found.t, found.y, color=BLUE, linewidth=1)
    for side in (-0.5, 0.5):
        ax.axhline(side * _floats([orbit.scene["gap"]])[0], color=GREY, linewidth=1)
    ax.set(xlabel="t", ylabel="y")


@_drawn
def velocity(orbit: Orbit, ax: Any, cycles: float = 8) -> None:
    """Draw (b): y' [length/time] over t [time]."""
    found = orbit(_times(orbit, cycles))
    ax.fill_between(found.t, *found.v_bounds.T, color=BLUE, alpha=0.3, linewidth=0)
    ax.plot(found.t, found.v, color=BLUE, linewidth=1)
    ax.set(xlabel="t", ylabel="y'")


@_drawn
def phase_plane(orbit: Orbit, ax: Any, cycles: float = 40) -> None:
    """Draw (c): y' [length/time] over y [length]."""
    found = orbit(_times(orbit, cycles))
    ax.plot(found.y, found.v, color=BLUE, linewidth=0.7)
    ax.set(xlabel="y", ylabel="y'")


@_drawn
def absolute_phase_plane(orbit: Orbit, ax: Any, cycles: float = 40) -> None:
    """Draw (d): x' [length/time] over x = y + E(t) [length]; E in floating point."""
    found = orbit(_times(orbit, cycles))
    moved, speed = _shaking(orbit, found.t)
    ax.plot(found.y + moved, found.v + speed, color=BLUE, linewidth=0.7)
    ax.set(xlabel="x", ylabel="x'")


def _impacts(orbit: Orbit, ax: Any, x: Doubles, y: Doubles, sides: tuple[int, ...]) -> None:
    colour = {-1: BLUE, 1: GREEN} if orbit.certified else {-1: VERMILION, 1: VERMILION}
    for side in sides:
        at = orbit.sides == side
        ax.plot(x[at], y[at], "." if side < 0 else "x", color=colour[side], markersize=3, linestyle="none")


def _phases(orbit: Orbit) -> Doubles:
    """W t + tau of the fastest harmonic modulo 2 pi [rad], in floating point."""
    _, w, tau = max(_terms(orbit), key=lambda term: term[1])
    return np.asarray(np.mod(w * orbit.t + tau, 2 * math.pi))


@_drawn
def switch_plane(orbit: Orbit, ax: Any, sides: tuple[int, ...] = (-1, 1)) -> None:
    """Draw (e): y' [length/time] before the impacts over W t + tau mod 2 pi [rad], (18)-(21)."""
    _impacts(orbit, ax, _phases(orbit), orbit.v, sides)
    ax.set(xlabel="Ωt + τ mod 2π", ylabel="y'")
    _angles(ax, "x")


@_drawn
def absolute_switch_plane(orbit: Orbit, ax: Any) -> None:
    """Draw (f): x' [length/time] over x [length] at the impacts, (22)."""
    moved, speed = _shaking(orbit, orbit.t)
    wall = 0.5 * _floats([orbit.scene["gap"]])[0] * orbit.sides
    _impacts(orbit, ax, wall + moved, orbit.v + speed, (-1, 1))
    ax.set(xlabel="x", ylabel="x'")


@_drawn
def section_left(orbit: Orbit, ax: Any) -> None:
    """Draw (g): the Poincaré section of the left wall."""
    switch_plane(orbit, ax, (-1,))


@_drawn
def section_right(orbit: Orbit, ax: Any) -> None:
    """Draw (h): the Poincaré section of the right wall."""
    switch_plane(orbit, ax, (1,))


#: The panels by the paper's letters.
PANELS: Mapping[str, Callable[..., Any]] = {
    "a": displacement,
    "b": velocity,
    "c": phase_plane,
    "d": absolute_phase_plane,
    "e": switch_plane,
    "f": absolute_switch_plane,
    "g": section_left,
    "h": section_right,
}


def panels(orbit: Orbit, letters: str = "abcdefgh", *, width: Width = None, header: bool = True) -> Any:
    """Draw panels on one sheet; returns the array of their ``Axes``."""
    from matplotlib import pyplot as plt

    rows = -(-len(letters) // 2)
    inches = 11 if width is None else WIDTHS[width] if isinstance(width, str) else width
    figure, axes = plt.subplots(rows, min(2, len(letters)), squeeze=False, figsize=(inches, 0.29 * inches * rows), layout="constrained")
    for letter, ax in zip(letters, axes.flat, strict=False):
        PANELS[letter](orbit, ax).set_title(f"({letter})", loc="left")
    if header:
        figure.suptitle("\n".join(_said(orbit)), fontsize="medium")
    return axes


def figure(number: int, impacts: int = 4000, *, width: Width = None, header: bool = True) -> Any:
    """Draw a figure of the paper: 10 and 11 are parameter manifolds, 12 to 17 eight panels of an orbit; returns its ``Axes``."""
    if number in (10, 11):
        over = {"frequency": (1, 60, 200)} if number == 10 else {"velocity": (-200, -1, 200)}
        return manifold(Scene.named(f"figure-{number}").manifold(over, (1, 7)), width=width, header=header)
    if number not in range(12, 18):
        raise RangeError(f"the figure is {number}, but must be from 10 to 17", "number", str(number))
    return panels(Scene.named(f"figure-{number}").run(impacts=impacts), width=width, header=header)


#: Amplitudes beyond this many gaps are cut off: near W = 0 they have no bound.
HIGHEST = 0.75


@_drawn
def manifold(found: Manifold, ax: Any, inset: Window | None = None) -> None:
    """Draw figures 10 and 11: A_N [length] over W [rad/time] or v [length/time]; thick where the motion is proved stable.

    Over v both walls are drawn, one the mirror image of the other. ``inset`` is a window ``((x0, x1), (y0, y1))`` that is magnified.
    """
    _manifold(found, ax)
    gap = _floats([found.document["scene"]["gap"]])[0]
    ax.axhline(0.5 * gap, color="black", linewidth=0.7, linestyle="dotted")
    ax.set(ylim=(0, HIGHEST * gap), xlabel={"frequency": "Ω", "velocity": "y′ before the impact"}[found.document["over"]], ylabel="A")
    for curve in found.curves:
        heights = middles(curve.amplitude_bounds)
        least = (middles(curve.at_bounds)[heights.argmin()], heights.min())
        ax.annotate(f"N = {curve.cycles}", least, (3, 6), textcoords="offset points", fontsize="x-small")
    ax.legend(fontsize="x-small", loc="upper left" if found.document["over"] == "velocity" else "upper right")
    if inset is not None:
        part = ax.inset_axes([0.55, 0.35, 0.42, 0.4], xlim=inset[0], ylim=inset[1])
        _manifold(found, part)
        ax.indicate_inset_zoom(part, edgecolor="black")


def _manifold(found: Manifold, ax: Any) -> None:
    sides = (1, -1) if found.document["over"] == "velocity" else (1,)
    for i, (curve, side) in enumerate((curve, side) for curve in found.curves for side in sides):
        x, y = side * middles(curve.at_bounds), middles(curve.amplitude_bounds)
        stable = [part is not None and part["stability"] == "stable" for part in curve.parts]
        physical = [part is not None and part["physical"] is not False for part in curve.parts]
        lines = (
            (y, {"color": GREY, "linewidth": 0.5, "linestyle": "dotted"}, "earlier contact"),
            (np.where(physical, y, np.nan), {"color": BLUE, "linewidth": 0.8}, "admissible, not stable"),
            (np.where(stable, y, np.nan), {"color": BLUE, "linewidth": 2.5}, "proved stable"),
        )
        for height, style, label in lines:
            ax.plot(x, height, label=None if i else label, **style)


@_drawn
def diagram(found: SweepResult, ax: Any, show: str = "phase") -> None:
    """Draw a bifurcation diagram: the phase [rad] or velocity [length/time] of each impact over the parameter, coloured by proof."""
    found.require_whole()
    states = found.states
    key = found.head["over"][0]["key"]
    outcomes = found.to_dict("points")["outcome"]
    classes = np.array([class_of(str(outcome)) for outcome in outcomes])
    of_state, at = classes[states["point"].astype(int)], middles(states[key.replace(".", "_")])
    for name, colour in CLASSES.items():
        if name in classes:
            here = of_state == name
            ax.plot(at[here], middles(states[show])[here], ".", markersize=1, color=colour, label=name)
    low, high = _floats([found.head["over"][0][end] for end in ("from", "to")])
    where = np.linspace(low, high, len(classes))[classes == "undecided, impacts before"]
    ax.plot(where, np.ones_like(where), "|", color=CLASSES["undecided, impacts before"], transform=ax.get_xaxis_transform(), clip_on=False)
    ax.set(xlabel=key, ylabel={"phase": "Ωt + τ mod 2π", "velocity": "y′"}[show], xlim=(low, high))
    if show == "phase":
        _angles(ax, "y")
    ax.legend(fontsize="x-small", markerscale=8, loc="best")


@_drawn
def basins(found: SweepResult, ax: Any, values: str = "outcome") -> None:
    """Draw a map over two keys, each value in the middle of its cell.

    ``values`` is ``"outcome"``, ``"exponent"`` (per impact) or ``"word"``. Outcomes are named, and attractors of one pair that are mirror
    images of each other have colours of their own; rings are where attractors hit the left wall first.
    """
    found.require_whole()
    axes = found.head["over"]
    if len(axes) != 2:
        raise RangeError(f"the sweep is over {len(axes)} key, but a map is over 2", "over", str(len(axes)))
    edges = [_edges(_floats([over["from"], over["to"]]), over["count"]) for over in axes]
    shape = [over["count"] for over in axes]
    if values == "exponent":
        colours = middles(np.stack([found.to_dict("points")[f"exponent_{end}"] for end in ("lower", "upper")], -1))
        image = ax.pcolormesh(*edges, np.reshape(colours, shape).T, rasterized=True)
        ax.figure.colorbar(image, ax=ax, label="exponent per impact")
    elif values in ("outcome", "word"):
        _categories(found, ax, edges, shape, by_place=values == "outcome")
    else:
        raise RangeError(f"values is {values!r}, but must be outcome, exponent or word", "values", values)
    for over, axis in zip(axes, "xy", strict=True):
        if over["key"] == "start.phase" and np.allclose(_floats([over["from"], over["to"]]), [0, 2 * math.pi]):
            _angles(ax, axis)
    ax.set(xlabel=axes[0]["key"], ylabel=axes[1]["key"])


def _edges(ends: list[float], count: int) -> Doubles:
    """Return the edges of cells whose middles are the values of a key."""
    low, high = ends
    half = 0.5 * (high - low) / max(count - 1, 1)
    return np.linspace(low - half, high + half, count + 1)


def _categories(found: SweepResult, ax: Any, edges: list[Doubles], shape: list[int], *, by_place: bool) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    keys = [over["key"] for over in found.head["over"]]
    kinds, numbers = kinds_of(found, by_place=by_place and all(key.startswith("start.") for key in keys))
    colours = colours_of(kinds)
    order = ListedColormap(colours)
    ax.pcolormesh(*edges, np.reshape(numbers, shape).T, cmap=order, vmin=-0.5, vmax=len(kinds) - 0.5, rasterized=True)
    ranked = sorted(zip(kinds, colours, strict=True), key=lambda kind: -kind[0].points)
    patches = [Patch(facecolor=colour, edgecolor="black", linewidth=0.4, label=kind.name) for kind, colour in ranked[:MOST_NAMED]]
    ax.legend(handles=patches, fontsize="x-small", loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2, frameon=False)
    if keys == ["start.phase", "start.velocity"] and found.head["scene"]["start"].get("wall") == "left":
        for kind, colour in zip(kinds, colours, strict=True):
            if kind.first is not None:
                ax.plot(*kind.first, "o", markersize=7, markerfacecolor=colour, markeredgecolor="white", markeredgewidth=1.5)
