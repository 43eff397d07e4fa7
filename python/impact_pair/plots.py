"""Pictures by matplotlib: one function per panel; each takes an ``Axes`` (or makes one) and returns it.

What is certified is drawn from its bounds: bands between them, and a line or dots in their middles. The paper's figures, each in a line::

    impact_pair.plots.figure(14)

Panels are those of the paper's figures 12-17: (a) ``displacement``, (b) ``velocity``, (c) ``phase_plane``, (d)
``absolute_phase_plane``, (e) ``switch_plane``, (f) ``absolute_switch_plane``, (g) ``section_left``, (h) ``section_right``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .bounds import middles, outward
from .errors import RangeError
from .scene import Scene

if TYPE_CHECKING:
    from .answers import Manifold
    from .bounds import Doubles
    from .orbit import Orbit
    from .sweep import SweepResult

#: Blue and green are distinguishable with colour-vision deficiency.
BLUE, GREEN, VERMILION, GREY = "#0072b2", "#009e73", "#d55e00", "#999999"
#: Points of a curve per forcing period.
IN_A_CYCLE = 200
#: Outcomes of a sweep, in the order of their colours.
OUTCOMES = ("attracted", "periodic", "rests-forever", "never-impacts", "not-attracted", "undecided")


def _axes(ax: Any | None) -> Any:
    if ax is not None:
        return ax
    from matplotlib import pyplot as plt

    return plt.subplots()[1]


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


def displacement(orbit: Orbit, ax: Any | None = None, cycles: float = 8) -> Any:
    """Draw (a): y [length] over t [time], with the walls."""
    ax = _axes(ax)
    found = orbit(_times(orbit, cycles))
    ax.fill_between(found.t, *found.y_bounds.T, color=BLUE, alpha=0.3, linewidth=0)
    ax.plot(found.t, found.y, color=BLUE, linewidth=1)
    for side in (-0.5, 0.5):
        ax.axhline(side * _floats([orbit.scene["gap"]])[0], color=GREY, linewidth=1)
    ax.set(xlabel="t", ylabel="y")
    return ax


def velocity(orbit: Orbit, ax: Any | None = None, cycles: float = 8) -> Any:
    """Draw (b): y' [length/time] over t [time]."""
    ax = _axes(ax)
    found = orbit(_times(orbit, cycles))
    ax.fill_between(found.t, *found.v_bounds.T, color=BLUE, alpha=0.3, linewidth=0)
    ax.plot(found.t, found.v, color=BLUE, linewidth=1)
    ax.set(xlabel="t", ylabel="y'")
    return ax


def phase_plane(orbit: Orbit, ax: Any | None = None, cycles: float = 40) -> Any:
    """Draw (c): y' [length/time] over y [length]."""
    ax = _axes(ax)
    found = orbit(_times(orbit, cycles))
    ax.plot(found.y, found.v, color=BLUE, linewidth=0.7)
    ax.set(xlabel="y", ylabel="y'")
    return ax


def absolute_phase_plane(orbit: Orbit, ax: Any | None = None, cycles: float = 40) -> Any:
    """Draw (d): x' [length/time] over x = y + E(t) [length]; E in floating point."""
    ax = _axes(ax)
    found = orbit(_times(orbit, cycles))
    moved, speed = _shaking(orbit, found.t)
    ax.plot(found.y + moved, found.v + speed, color=BLUE, linewidth=0.7)
    ax.set(xlabel="x", ylabel="x'")
    return ax


def _impacts(orbit: Orbit, ax: Any, x: Doubles, y: Doubles, sides: tuple[int, ...]) -> None:
    colour = {-1: BLUE, 1: GREEN} if orbit.certified else {-1: VERMILION, 1: VERMILION}
    for side in sides:
        at = orbit.sides == side
        ax.plot(x[at], y[at], "." if side < 0 else "x", color=colour[side], markersize=3, linestyle="none")


def _phases(orbit: Orbit) -> Doubles:
    """W t + tau of the fastest harmonic modulo 2 pi [rad], in floating point."""
    _, w, tau = max(_terms(orbit), key=lambda term: term[1])
    return np.asarray(np.mod(w * orbit.t + tau, 2 * math.pi))


def switch_plane(orbit: Orbit, ax: Any | None = None, sides: tuple[int, ...] = (-1, 1)) -> Any:
    """Draw (e): y' [length/time] before the impacts over W t + tau mod 2 pi [rad], (18)-(21)."""
    ax = _axes(ax)
    _impacts(orbit, ax, _phases(orbit), orbit.v, sides)
    ax.set(xlabel="Ωt + τ mod 2π", ylabel="y'", xlim=(0, 2 * math.pi))
    return ax


def absolute_switch_plane(orbit: Orbit, ax: Any | None = None) -> Any:
    """Draw (f): x' [length/time] over x [length] at the impacts, (22)."""
    ax = _axes(ax)
    moved, speed = _shaking(orbit, orbit.t)
    wall = 0.5 * _floats([orbit.scene["gap"]])[0] * orbit.sides
    _impacts(orbit, ax, wall + moved, orbit.v + speed, (-1, 1))
    ax.set(xlabel="x", ylabel="x'")
    return ax


def section_left(orbit: Orbit, ax: Any | None = None) -> Any:
    """Draw (g): the Poincaré section of the left wall."""
    return switch_plane(orbit, ax, (-1,))


def section_right(orbit: Orbit, ax: Any | None = None) -> Any:
    """Draw (h): the Poincaré section of the right wall."""
    return switch_plane(orbit, ax, (1,))


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


def panels(orbit: Orbit, letters: str = "abcdefgh") -> Any:
    """Draw panels on one sheet; returns the array of their ``Axes``."""
    from matplotlib import pyplot as plt

    rows = -(-len(letters) // 2)
    figure, axes = plt.subplots(rows, min(2, len(letters)), squeeze=False, figsize=(11, 3.2 * rows), layout="constrained")
    for letter, ax in zip(letters, axes.flat, strict=False):
        PANELS[letter](orbit, ax).set_title(f"({letter})", loc="left")
    figure.suptitle("; ".join(repr(orbit).splitlines()[-1:]))
    return axes


def figure(number: int, impacts: int = 4000) -> Any:
    """Draw a figure of the paper: 10 and 11 are parameter manifolds, 12 to 17 eight panels of an orbit; returns its ``Axes``."""
    if number in (10, 11):
        over = {"frequency": (1, 60, 200)} if number == 10 else {"velocity": (-200, -1, 200)}
        return manifold(Scene.named(f"figure-{number}").manifold(over, (1, 7)))
    if number not in range(12, 18):
        raise RangeError(f"the figure is {number}, but must be from 10 to 17", "number", str(number))
    return panels(Scene.named(f"figure-{number}").run(impacts=impacts))


def manifold(found: Manifold, ax: Any | None = None) -> Any:
    """Draw figures 10 and 11: A_N [length] over W [rad/time] or v [length/time]; thick where the motion is proved stable."""
    ax = _axes(ax)
    for curve in found.curves:
        x, y = middles(curve.at_bounds), middles(curve.amplitude_bounds)
        stable = [part is not None and part["stability"] == "stable" for part in curve.parts]
        physical = [part is not None and part["physical"] is not False for part in curve.parts]
        ax.plot(x, y, color=GREY, linewidth=0.5, linestyle="dotted")
        ax.plot(x, np.where(physical, y, np.nan), color=BLUE, linewidth=0.8)
        ax.plot(x, np.where(stable, y, np.nan), color=BLUE, linewidth=2.5, label=f"N = {curve.cycles}")
    ax.set(xlabel={"frequency": "Ω", "velocity": "v"}[found.document["over"]], ylabel="A")
    return ax


def diagram(found: SweepResult, ax: Any | None = None, show: str = "phase") -> Any:
    """Draw a bifurcation diagram: the phase [rad] or velocity [length/time] of each impact over the parameter."""
    ax = _axes(ax)
    states = found.states
    key = found.head["over"][0]["key"].replace(".", "_")
    ax.plot(middles(states[key]), middles(states[show]), ",", color=BLUE)
    ax.set(xlabel=key, ylabel={"phase": "Ωt + τ mod 2π", "velocity": "y'"}[show])
    return ax


def basins(found: SweepResult, ax: Any | None = None, values: str = "outcome") -> Any:
    """Draw a map over two keys: ``values`` is ``"outcome"``, ``"exponent"`` (per impact), or ``"word"``."""
    ax = _axes(ax)
    counts = [over["count"] for over in found.head["over"]]
    table = found.table
    at = table["record"] == "point"
    if values == "exponent":
        colours: Any = middles(table["exponent"][at])
    else:
        names = list(table[values][at])
        order = OUTCOMES if values == "outcome" else sorted({str(name) for name in names})
        colours = np.array([order.index(str(name)) for name in names], dtype=float)
    ends = [_floats([over["from"], over["to"]]) for over in found.head["over"]]
    image = ax.imshow(np.reshape(colours, counts).T, origin="lower", aspect="auto", extent=(*ends[0], *ends[1]), interpolation="nearest")
    ax.figure.colorbar(image, ax=ax, label=values)
    ax.set(xlabel=found.head["over"][0]["key"], ylabel=found.head["over"][1]["key"])
    return ax
