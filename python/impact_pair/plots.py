"""Pictures by matplotlib: one function per panel; each takes an ``Axes`` (or makes one) and returns it.

Certified quantities are drawn from their bounds: bands between them, and a line or dots in their middles.
The paper's figures, each in a line::

    impact_pair.plots.figure(14)

Each function takes ``width``, ``"single"`` or ``"double"`` for a column or a page of a journal, or inches, and ``header``, whether the
parameters and certification are written above it: by default where it makes its ``Axes`` itself.

Panels are those of the paper's figures 12-17: (a) ``displacement``, (b) ``velocity``, (c) ``phase_plane``, (d)
``absolute_phase_plane``, (e) ``switch_plane``, (f) ``absolute_switch_plane``, (g) ``section_left``, (h) ``section_right``.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _core, _kinds, _manifold
from ._kinds import BLUE, CLASSES, GREEN, VERMILION, class_of
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
    #: The magnified range of both axes, each from and to.
    Window = tuple[tuple[float, float], tuple[float, float]]

#: The grey of lines that one adds.
GREY = _kinds.GREY
#: Points of a curve per forcing period.
IN_A_CYCLE = 200
#: Widths of figures in journals [inches]: 90 and 190 mm.
WIDTHS = {"single": 90 / 25.4, "double": 190 / 25.4}
#: Figures less wide than this have smaller letters [inches].
NARROW = 5.0
#: The name of a ring in the legend of a map.
RING = "an attractor, where it hits the left wall"


#: The walls in words.
WALLS = {-1: "impact on the left wall", 1: "impact on the right wall"}
#: Symbols of what is no impact, as those of the command line.
STOPS = {"graze": "D", "rest": "s", "release": "^"}
#: The paper's names of the panels, and the quantities on their axes, by letter.
TITLES = {letter: title for letter, title, _ in _core.PANELS}
QUANTITIES = {letter: quantities for letter, _, quantities in _core.PANELS}
#: Names of keys on axes, as on those of the command line's pictures.
AXES = {
    "amplitude": "amplitude of the box A [length]",
    "frequency": "angular frequency Ω [rad/time]",
    "phase": "phase of the excitation τ [rad]",
    "gap": "gap d [length]",
    "restitution": "coefficient of restitution e",
    "start.time": "time of the start $t_0$ [time]",
    "start.phase": "phase at the start $Ωt_0 + τ$ [rad]",
    "start.position": "relative displacement at the start $y_0$ [length]",
    "start.velocity": "relative velocity at the start $v_0$ [length/time]",
}


def _named(key: str) -> str:
    """Return the name of a key; of a term with its number."""
    plain, _, term = key.rpartition(".")
    return f"{AXES[plain]}, term {term}" if term.isdigit() else AXES[key]


def _label(ax: Any, letter: str) -> None:
    """Name the quantities on the axes of a panel."""
    across, up = QUANTITIES[letter]
    ax.set(xlabel=across, ylabel=up)


def _inches(width: Width) -> float | None:
    return WIDTHS[width] if isinstance(width, str) else width


def _letters(width: Width) -> Any:
    """Return a context in which letters have the sizes of journals, in a column of them."""
    import matplotlib as mpl

    is_narrow = (_inches(width) or NARROW) < NARROW
    return mpl.rc_context({"font.size": 8, "axes.labelsize": 7, "xtick.labelsize": 7, "ytick.labelsize": 7} if is_narrow else {})


def _axes(width: Width) -> Any:
    from matplotlib import pyplot as plt

    inches = _inches(width)
    size = None if inches is None else (inches, 0.75 * inches)
    return plt.subplots(figsize=size, layout="constrained")[1]


def _drawn(draw: Callable[..., None]) -> Callable[..., Any]:
    """Make a picture of what draws on an ``Axes``."""

    @functools.wraps(draw)
    def picture(found: Any, ax: Any | None = None, *given: Any, width: Width = None, header: bool | None = None, **how: Any) -> Any:
        with _letters(width):
            own = _axes(width) if ax is None else ax
            draw(found, own, *given, **how)
            if header or (header is None and ax is None):
                own.set_title("\n".join(_summary(found)), fontsize="small", loc="left")
        return own

    return picture


def _summary(found: Any) -> list[str]:
    """Return the lines of a header: the parameters that do not vary in exact words, and the certification."""
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


def _curve(orbit: Orbit, t: Doubles, x: Doubles, y: Doubles, ax: Any) -> None:
    """Draw a motion, which jumps at impacts: its jumps are faint."""
    at = np.searchsorted(t, orbit.t[(orbit.t > t[0]) & (orbit.t < t[-1])])
    ax.plot(x, y, color=BLUE, linewidth=0.5, alpha=0.3)
    ax.plot(np.insert(x, at, np.nan), np.insert(y, at, np.nan), color=BLUE, linewidth=0.8)


def _walls(orbit: Orbit) -> tuple[float, float]:
    half = 0.5 * _floats([orbit.scene["gap"]])[0]
    return -half, half


def _stops(orbit: Orbit, ax: Any, t: Doubles, place: Callable[[Doubles, Doubles], tuple[Doubles, Doubles]]) -> None:
    """Draw the grazes, rests and releases that are shown, at the places of their times and walls."""
    for kind, symbol in STOPS.items():
        times = middles(orbit.event_bounds)
        at = (orbit.event_kinds == kind) & (times >= t[0]) & (times <= t[-1])
        if at.any():
            x, y = place(times[at], _walls(orbit)[1] * orbit.event_sides[at])
            ax.plot(x, y, symbol, color="black", markerfacecolor="white", markersize=5, linestyle="none", label=kind)
            ax.legend(fontsize="x-small")


@_drawn
def displacement(orbit: Orbit, ax: Any, cycles: float = 8) -> None:
    """Draw (a): y [length] over t [time], with the walls; grazes, rests and releases are marked."""
    found = orbit(_times(orbit, cycles))
    ax.fill_between(found.t, *found.y_bounds.T, color=BLUE, alpha=0.3, linewidth=0)
    ax.plot(found.t, found.y, color=BLUE, linewidth=1)
    for wall in _walls(orbit):
        ax.axhline(wall, color="black", linewidth=1.2)
    _stops(orbit, ax, found.t, lambda t, y: (t, y))
    _label(ax, "a")
    ax.set(xlim=found.t[[0, -1]])


@_drawn
def velocity(orbit: Orbit, ax: Any, cycles: float = 8) -> None:
    """Draw (b): y' [length/time] over t [time]."""
    found = orbit(_times(orbit, cycles))
    ax.fill_between(found.t, *found.v_bounds.T, color=BLUE, alpha=0.3, linewidth=0)
    _curve(orbit, found.t, found.t, found.v, ax)
    _stops(orbit, ax, found.t, lambda t, y: (t, np.zeros_like(y)))
    _label(ax, "b")
    ax.set(xlim=found.t[[0, -1]])


@_drawn
def phase_plane(orbit: Orbit, ax: Any, cycles: float = 40) -> None:
    """Draw (c): y' [length/time] over y [length], with the walls."""
    found = orbit(_times(orbit, cycles))
    for wall in _walls(orbit):
        ax.axvline(wall, color="black", linewidth=1.2)
    _curve(orbit, found.t, found.y, found.v, ax)
    _stops(orbit, ax, found.t, lambda _, y: (y, np.zeros_like(y)))
    _label(ax, "c")


@_drawn
def absolute_phase_plane(orbit: Orbit, ax: Any, cycles: float = 40) -> None:
    """Draw (d): x' [length/time] over x = y + E(t) [length]; E in floating point."""
    found = orbit(_times(orbit, cycles))
    moved, speed = _shaking(orbit, found.t)
    _curve(orbit, found.t, found.y + moved, found.v + speed, ax)
    _label(ax, "d")


def _impacts(orbit: Orbit, ax: Any, x: Doubles, y: Doubles, sides: tuple[int, ...]) -> None:
    colour = {-1: BLUE, 1: GREEN} if orbit.certified else {-1: VERMILION, 1: VERMILION}
    for side in sides:
        at = orbit.sides == side
        ax.plot(x[at], y[at], "." if side < 0 else "x", color=colour[side], markersize=2, linestyle="none", label=WALLS[side])
    if len(sides) > 1:
        ax.legend(fontsize="x-small")


def _phases(orbit: Orbit) -> Doubles:
    """W t + tau of the fastest harmonic modulo 2 pi [rad], in floating point."""
    _, w, tau = max(_terms(orbit), key=lambda term: term[1])
    return np.asarray(np.mod(w * orbit.t + tau, 2 * math.pi))


@_drawn
def switch_plane(orbit: Orbit, ax: Any, sides: tuple[int, ...] = (-1, 1)) -> None:
    """Draw (e): y' [length/time] before the impacts over W t + tau mod 2 pi [rad], (18)-(21)."""
    _impacts(orbit, ax, _phases(orbit), orbit.v, sides)
    _label(ax, "e")
    _angles(ax, "x")


@_drawn
def absolute_switch_plane(orbit: Orbit, ax: Any) -> None:
    """Draw (f): x' [length/time] over x [length] at the impacts, (22)."""
    moved, speed = _shaking(orbit, orbit.t)
    wall = _walls(orbit)[1] * orbit.sides
    _impacts(orbit, ax, wall + moved, orbit.v + speed, (-1, 1))
    _label(ax, "f")


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
    inches = _inches(width) or 11
    with _letters(width):
        figure, axes = plt.subplots(rows, min(2, len(letters)), squeeze=False, figsize=(inches, 0.29 * inches * rows), layout="constrained")
    for letter, ax in zip(letters, axes.flat, strict=False):
        PANELS[letter](orbit, ax).set_title(f"({letter})  {TITLES[letter]}", loc="left", fontsize="medium")
    if header:
        figure.suptitle("\n".join(_summary(orbit)), fontsize="medium")
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

    Over v both walls are drawn, one the mirror image of the other. ``inset`` is a window ``((x0, x1), (y0, y1))`` that is magnified
    above d/2.
    """
    gap = _floats([found.document["scene"]["gap"]])[0]
    at = np.concatenate([side * middles(curve.at_bounds) for curve in found.curves for side in _manifold.sides(found)])
    xlabel = {"frequency": "angular frequency Ω [rad/time]", "velocity": "relative velocity v before the impact [length/time]"}
    ax.set(xlim=(at.min(), at.max()), ylim=(0, HIGHEST * gap), xlabel=xlabel[found.document["over"]], ylabel="amplitude $A_N$ [length]")
    ax.axhline(0.5 * gap, color="black", linewidth=0.7, linestyle="dotted")
    ax.annotate("$d/2$", (at.max(), 0.5 * gap), (4, 2), textcoords="offset points", fontsize="x-small", annotation_clip=False)
    _manifold.draw(found, ax)
    _manifold.name(found, ax)
    _manifold.explain(found, ax)
    if inset is not None:
        _manifold.magnify(found, ax, inset)


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
    ylabel = {"phase": "phase Ωt + τ of the impact [rad]", "velocity": "relative velocity y′ before the impact [length/time]"}
    ax.set(xlabel=_named(key), ylabel=ylabel[show], xlim=(low, high))
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
        _categories(found, ax, edges, shape, by_word=values == "word")
    else:
        raise RangeError(f"values is {values!r}, but must be outcome, exponent or word", "values", values)
    for over, axis in zip(axes, "xy", strict=True):
        if over["key"] == "start.phase" and np.allclose(_floats([over["from"], over["to"]]), [0, 2 * math.pi]):
            _angles(ax, axis)
    ax.set(xlim=edges[0][[0, -1]], ylim=edges[1][[0, -1]])
    ax.set(xlabel=_named(axes[0]["key"]), ylabel=_named(axes[1]["key"]))


def _edges(ends: list[float], count: int) -> Doubles:
    """Return the edges of cells whose middles are the values of a key."""
    low, high = ends
    half = 0.5 * (high - low) / max(count - 1, 1)
    return np.linspace(low - half, high + half, count + 1)


def _categories(found: SweepResult, ax: Any, edges: list[Doubles], shape: list[int], *, by_word: bool) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    numbers, colours, legend, rings = found.on_map(by_word=by_word)
    order = ListedColormap(colours)
    ax.pcolormesh(*edges, np.reshape(numbers, shape).T, cmap=order, vmin=-0.5, vmax=len(colours) - 0.5, rasterized=True)
    ring: dict[str, Any] = {"marker": "o", "markersize": 7, "markeredgecolor": "black", "linestyle": "none"}
    entries: list[Any] = [Patch(facecolor=colour, edgecolor="black", linewidth=0.4, label=name) for colour, name in legend]
    entries += [Line2D([], [], markerfacecolor="white", label=RING, **ring)] if rings else []
    ax.legend(handles=entries, fontsize="x-small", loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2, frameon=False)
    for phase, velocity, colour in rings:
        ax.plot(phase, velocity, markerfacecolor=colour, **ring)
