"""Answers of the other verbs, as objects above their documents."""

from __future__ import annotations

import csv
import html
import io
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._document import Document
from ._exact import plain
from ._file import read
from .bounds import Bounds, outward, pair
from .errors import ListError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .bounds import Doubles


@dataclass(frozen=True)
class PeriodicOrbit:
    """A periodic orbit that is proved to be unique within its bounds; ``fields`` is its document."""

    fields: dict[str, Any]

    @property
    def walls(self) -> list[str]:
        """The walls of its impacts (n,), in time order."""
        return [impact["wall"] for impact in self.fields["impacts"]]

    @property
    def phase_bounds(self) -> Doubles:
        """Bounds of W t + tau at its impacts (n, 2) [rad]."""
        return outward(impact["phase"] for impact in self.fields["impacts"])

    @property
    def v_bounds(self) -> Doubles:
        """Bounds of y' just before its impacts (n, 2) [length/time]."""
        return outward(impact["velocity"] for impact in self.fields["impacts"])

    @property
    def phases(self) -> list[Bounds]:
        """Bounds of W t + tau at its impacts as exact decimals [rad]."""
        return [Bounds(*impact["phase"]) for impact in self.fields["impacts"]]

    @property
    def velocities(self) -> list[Bounds]:
        """Bounds of y' just before its impacts as exact decimals [length/time]."""
        return [Bounds(*impact["velocity"]) for impact in self.fields["impacts"]]

    @property
    def stability(self) -> str:
        """Stable, unstable or undecided."""
        return str(self.fields["stability"])

    @property
    def physical(self) -> bool | None:
        """True if it is admissible: no wall is touched earlier on any flight; None if undecided."""
        found: bool | None = self.fields["physical"]
        return found

    @property
    def symmetric(self) -> bool | None:
        """True if it is its own mirror image; None if undecided."""
        found: bool | None = self.fields["symmetric"]
        return found

    @property
    def trace(self) -> Bounds | None:
        """The trace of the Jacobian over the period."""
        return pair(self.fields.get("trace"))

    @property
    def determinant(self) -> Bounds | None:
        """The determinant of the Jacobian over the period."""
        return pair(self.fields.get("determinant"))

    @property
    def eigenvalues(self) -> list[tuple[Bounds, Bounds]]:
        """Real and imaginary part of each eigenvalue."""
        return [(Bounds(*value["re"]), Bounds(*value["im"])) for value in self.fields.get("eigenvalues") or []]

    def __repr__(self) -> str:
        impacts = zip(self.walls, self.phases, self.velocities, strict=True)
        listed = "; ".join(f"{wall} W t + tau = {phase}, v = {velocity}" for wall, phase, velocity in impacts)
        return f"<{self.stability} orbit: {listed}>"


class Periodic(Document):
    """Proved periodic orbits: those of a word, or all two-impact motions in N cycles."""

    @property
    def word(self) -> str:
        """The word, a sequence of mappings, the right-most first in time."""
        return str(self.document["word"])

    @property
    def cycles(self) -> int:
        """Number of forcing periods of the orbits."""
        return int(self.document["cycles"])

    @property
    def exhaustive(self) -> bool:
        """True if the list is proved complete, apart from motions with sticking."""
        return bool(self.document["exhaustive"])

    @cached_property
    def orbits(self) -> list[PeriodicOrbit]:
        """The orbits."""
        return [PeriodicOrbit(orbit) for orbit in self.document["orbits"]]

    def __len__(self) -> int:
        return len(self.orbits)

    def __iter__(self) -> Iterator[PeriodicOrbit]:
        return iter(self.orbits)

    def __getitem__(self, i: int) -> PeriodicOrbit:
        return self.orbits[i]

    def to_pandas(self) -> Any:
        """Return a DataFrame with one row per impact."""
        import pandas as pd

        rows = [
            {"orbit": i, "wall": wall, "phase_lower": phase[0], "phase_upper": phase[1], "v_lower": v[0], "v_upper": v[1]}
            | {"stability": orbit.stability, "physical": orbit.physical, "symmetric": orbit.symmetric}
            for i, orbit in enumerate(self)
            for wall, phase, v in zip(orbit.walls, orbit.phase_bounds, orbit.v_bounds, strict=True)
        ]
        return pd.DataFrame(rows)

    def __repr__(self) -> str:
        rest = "proved to be all without sticking" if self.exhaustive else "others are not excluded"
        lines = [f"{self.word} in {self.cycles} cycles: {len(self)} orbits, {rest}", *map(repr, self)]
        return "\n".join(lines)


@dataclass(frozen=True)
class Bifurcation:
    """A proved bifurcation: exactly one lies within its bounds."""

    #: fold, pitchfork, period-doubling or graze.
    kind: str
    parameter: Bounds
    word: str
    cycles: int
    orbit: PeriodicOrbit


class Bifurcations(Document):
    """Proved bifurcations in the order of the parameter, and the branches that were followed."""

    @cached_property
    def points(self) -> list[Bifurcation]:
        """The bifurcations."""
        return [
            Bifurcation(found["kind"], Bounds(*found["parameter"]), found["word"], found["cycles"], PeriodicOrbit(found["orbit"]))
            for found in self.document["points"]
        ]

    @property
    def parameter_bounds(self) -> Doubles:
        """Bounds of the parameter (n, 2)."""
        return outward(point.parameter.decimals for point in self.points)

    def __len__(self) -> int:
        return len(self.points)

    def __iter__(self) -> Iterator[Bifurcation]:
        return iter(self.points)

    def to_pandas(self) -> Any:
        """Return a DataFrame with one row per bifurcation."""
        import pandas as pd

        rows = [
            {"kind": point.kind, "parameter_lower": low, "parameter_upper": high, "word": point.word, "cycles": point.cycles}
            for point, (low, high) in zip(self.points, self.parameter_bounds, strict=True)
        ]
        return pd.DataFrame(rows)

    def __repr__(self) -> str:
        over = self.document["over"]
        lines = [f"over {over['key']} from {over['low']} to {over['high']}: {len(self)} bifurcations"]
        return "\n".join(lines + [f"{point.kind:16} {point.parameter}" for point in self.points])


@dataclass(frozen=True)
class Curve:
    """A parameter manifold of one N: A_N over W or v, certified at each of its n points."""

    cycles: int
    #: Bounds of W [rad/time] or v [length/time] (n, 2).
    at_bounds: Doubles
    #: Bounds of A_N [length] (n, 2).
    amplitude_bounds: Doubles
    #: The kind of a special point: graze, pitchfork, fold, or None (n,).
    marks: list[str | None]
    #: Properties proved between each point and the next (n,): ``sine``, ``physical``, ``stability``.
    parts: list[dict[str, Any] | None]


class Manifold(Document):
    """The curves of figures 10 and 11."""

    @cached_property
    def curves(self) -> list[Curve]:
        """A curve for each N."""
        over = self.document["over"]
        return [
            Curve(
                curve["cycles"],
                outward(point[over] for point in curve["points"]),
                outward(point["amplitude"] for point in curve["points"]),
                [point.get("mark") for point in curve["points"]],
                [point.get("after") for point in curve["points"]],
            )
            for curve in self.document["curves"]
        ]

    def _repr_svg_(self) -> str | None:
        return self.svg

    def __repr__(self) -> str:
        said = ", ".join(f"N = {curve.cycles}: {len(curve.marks)} points" for curve in self.curves)
        return f"<parameter manifolds over {self.document['over']}: {said}>"


class Trap(Document):
    """A trapping region: no sticking, no complete chatter, bounds for all time."""

    @property
    def boxes(self) -> int:
        """Number of boxes."""
        return int(self.document["boxes"])

    @property
    def entered_at_impact(self) -> int | None:
        """The impact from which on the scene's own orbit is in it, 0 for its start; None if undecided."""
        found: int | None = self.document["entered_at_impact"]
        return found

    @property
    def words(self) -> int | None:
        """An upper bound of the number of words of N walls; None if they are not counted."""
        found = self.document.get("words")
        return None if found is None else int(found["count"])

    @property
    def words_entropy(self) -> float | None:
        """An upper bound of the topological entropy of the words [nats per impact]; None if they are not counted."""
        found = self.document.get("words")
        return None if found is None else float(outward([(found["entropy_at_most"], found["entropy_at_most"])])[0, 1])

    def __repr__(self) -> str:
        if not self.certified:
            return f"undecided: no region is proved; {self.document['message']}"
        return f"<region of {self.boxes} boxes, entered at impact {self.entered_at_impact}>"


class Cycles(Document):
    """All periodic orbits with given numbers of impacts in a trapping region; an orbit and its mirror image are one."""

    @property
    def exhaustive(self) -> bool:
        """True if the list is complete."""
        return bool(self.document["exhaustive"])

    @property
    def fixed_points(self) -> dict[int, int]:
        """The number of fixed points of the n-th iterate in the region, by n; only for n where it is proved."""
        return {int(impacts): int(count) for impacts, count in self.document["fixed_points"].items()}

    @cached_property
    def orbits(self) -> list[PeriodicOrbit]:
        """Each cycle, proved."""
        return [PeriodicOrbit(orbit) for orbit in self.document["orbits"]]

    def __len__(self) -> int:
        return len(self.orbits)

    def __iter__(self) -> Iterator[PeriodicOrbit]:
        return iter(self.orbits)

    def __repr__(self) -> str:
        rest = "proved to be all" if self.exhaustive else "others are not excluded"
        counts = ", ".join(f"{impacts}: {count}" for impacts, count in self.fixed_points.items())
        return f"<{len(self)} cycles, {rest}; fixed points by impacts: {counts}>"


@dataclass(frozen=True)
class Window:
    """A stable periodic orbit at an exact value of a parameter, and the window in which it is stable."""

    key: str
    at: str
    start: Bounds | None
    end: Bounds | None
    ends: tuple[str | None, str | None]
    stable_between: bool
    reduced_impacts: int
    flights: str
    word: str
    cycles: int
    orbit: PeriodicOrbit


class Windows(Document):
    """Stable periodic orbits found over a parameter near a scene, the nearest first; others are not excluded."""

    @cached_property
    def windows(self) -> list[Window]:
        """Each window, proved."""

        def bounds(found: list[str] | None) -> Bounds | None:
            return None if found is None else Bounds(*found)

        return [
            Window(
                found["key"],
                found["at"],
                bounds(found["from"]),
                bounds(found["to"]),
                (found["ends"][0], found["ends"][1]),
                found["stable_between"],
                found["reduced_impacts"],
                found["flights"],
                found["word"],
                found["cycles"],
                PeriodicOrbit(found["orbit"]),
            )
            for found in self.document["windows"]
        ]

    def __len__(self) -> int:
        return len(self.windows)

    def __iter__(self) -> Iterator[Window]:
        return iter(self.windows)

    def __repr__(self) -> str:
        said = "certified" if self.certified else "undecided"
        return f"<{said}: {len(self)} windows, others are not excluded>"


@dataclass(frozen=True)
class Component:
    """A set of states that motions may stay in for ever, and what is proved of them."""

    kind: str
    reduced_impacts: int | None
    word: str | None
    cycles: int | None
    spectral_radius: Bounds | None
    boxes: int
    area: float
    closed: bool
    orbit: PeriodicOrbit | None
    """The periodic motion; a saddle without one is a set of saddle type."""
    reason: str | None
    """The limit that leaves it undecided: ``most``, ``halvings``, ``work`` or ``interrupted``."""
    entropy: float | None
    """A lower bound of the topological entropy per impact of a horseshoe that is proved to be in it, if one was looked for."""


@dataclass(frozen=True)
class Basin:
    """A proved lower bound of the basin of an attractor."""

    component: int
    """Its position among the components."""
    area: float
    """A lower bound of the part of the state space whose motions end in it."""


class GlobalAnalysis(Document):
    """A global analysis of a pair: the components that motions may stay in for ever, and the class in a sentence."""

    @property
    def kind(self) -> str:
        """``one-rest-cycle``, ``one-attractor``, ``attractors``, ``closed`` or ``undecided``."""
        return str(self.document["class"])

    @property
    def statement(self) -> str:
        """The class in a sentence."""
        return str(self.document["statement"])

    @cached_property
    def components(self) -> list[Component]:
        """Each component, those first from which motions may go on to others."""

        def component(found: dict[str, Any]) -> Component:
            radius, orbit, horseshoe = found.get("spectral_radius"), found.get("orbit"), found.get("horseshoe")
            return Component(
                found["kind"],
                found.get("reduced_impacts"),
                found.get("word"),
                found.get("cycles"),
                None if radius is None else Bounds(*radius),
                found["boxes"],
                float(found["area"]),
                found["closed"],
                None if orbit is None else PeriodicOrbit(orbit),
                found.get("reason"),
                None if horseshoe is None else float(horseshoe["entropy"]["per_impact"]),
            )

        return [component(found) for found in self.document["components"]]

    @cached_property
    def basins(self) -> list[Basin]:
        """The basin of each attractor, as far as it is proved: boxes all of whose motions end in it."""
        found = self.document.get("basins") or {"areas": []}
        return [Basin(basin["component"], float(basin["area"])) for basin in found["areas"]]

    @property
    def order(self) -> list[tuple[int, int]]:
        """Pairs of components: motions may go from the first to the second."""
        return [(first, second) for first, second in self.document["order"]]

    def __repr__(self) -> str:
        return f"<{'certified' if self.certified else 'undecided'}: {self.statement}>"


@dataclass(frozen=True)
class Beside:
    """Proved counts of common points beside a tangency, with the parameters of both invariant manifolds and the states in these boxes.

    For each value of the parameter in ``two`` the invariant manifolds have exactly two common points along the flights, for each in
    ``none`` none. States are phase and speed.
    """

    two: Bounds
    none: Bounds
    unstable: Bounds
    stable: Bounds
    states: tuple[tuple[Bounds, Bounds], ...]


def _states(found: list[dict[str, list[str]]]) -> tuple[tuple[Bounds, Bounds], ...]:
    return tuple((Bounds(*state["phase"]), Bounds(*state["speed"])) for state in found)


def _beside(found: dict[str, Any]) -> Beside:
    two, none, unstable, stable = (Bounds(*found[key]) for key in ("two", "none", "unstable", "stable"))
    return Beside(two, none, unstable, stable, _states(found["states"]))


@dataclass(frozen=True)
class Tangency:
    """A homoclinic tangency: for exactly one value of the parameter in its bounds the invariant manifolds of the saddle are tangent.

    It is quadratic (``quadratic`` is not 0) and unfolds with a speed other than 0 (``unfolding``). Where a datum of the scene is an
    interval, that is so for each value in it, among the tangencies whose states are in ``states``.
    """

    key: str
    parameter: Bounds
    flights: str
    phase: Bounds
    speed: Bounds
    eigenvalues: tuple[Bounds, Bounds]
    unstable: Bounds
    stable: Bounds
    quadratic: Bounds
    unfolding: Bounds
    least_speed: str
    least_flight: str
    resonances_excluded_to: int
    states: tuple[tuple[Bounds, Bounds], ...] | None
    beside: Beside | None


class Tangencies(Document):
    """Homoclinic tangencies found over a parameter, the nearest to the scene's own value first; others are not excluded."""

    @cached_property
    def tangencies(self) -> list[Tangency]:
        """Each tangency, proved."""
        return [
            Tangency(
                found["key"],
                Bounds(*found["parameter"]),
                found["flights"],
                Bounds(*found["saddle"]["phase"]),
                Bounds(*found["saddle"]["speed"]),
                (Bounds(*found["saddle"]["eigenvalues"][0]), Bounds(*found["saddle"]["eigenvalues"][1])),
                Bounds(*found["unstable"]),
                Bounds(*found["stable"]),
                Bounds(*found["quadratic"]),
                Bounds(*found["unfolding"]),
                found["least_speed"],
                found["least_flight"],
                found["resonances_excluded_to"],
                None if "states" not in found else _states(found["states"]),
                None if "beside" not in found else _beside(found["beside"]),
            )
            for found in self.document["tangencies"]
        ]

    def __len__(self) -> int:
        return len(self.tangencies)

    def __iter__(self) -> Iterator[Tangency]:
        return iter(self.tangencies)

    def __repr__(self) -> str:
        said = "certified" if self.certified else "undecided"
        return f"<{said}: {len(self)} homoclinic tangencies, others are not excluded>"


class Chaos(Document):
    """A horseshoe: words that can follow one another, and a lower bound of the topological entropy."""

    @property
    def entropy(self) -> float:
        """A lower bound of the topological entropy of the impact map [nats per impact]; 0 if nothing is proved."""
        return self._down("per_impact")

    @property
    def entropy_per_cycle(self) -> float:
        """A lower bound of the topological entropy [nats per forcing period]; 0 if nothing is proved."""
        return self._down("per_cycle")

    def _down(self, key: str) -> float:
        text = self.document["entropy"][key]
        return float(outward([(text, text)])[0, 0])

    @property
    def words(self) -> list[dict[str, Any]]:
        """The words: first and last h-set, impacts, half forcing periods, flights."""
        return list(self.document["words"])

    @property
    def left_out(self) -> dict[int, str]:
        """The words, by their places in ``words``, that are left out of the hyperbolic set, and why; empty if it was not requested."""
        return {left["word"]: left["reason"] for left in self.document.get("left_out", [])}

    def __repr__(self) -> str:
        per = self.document["entropy"]
        said = "certified" if self.certified else "undecided"
        bounds = f"{per['per_impact']} per impact, {per['per_cycle']} per forcing period"
        return f"{said}: topological entropy at least {bounds}; {len(self.words)} words"


def percent(said: str, share: float) -> str:
    """Return a share in hundredths of a percent: of what is undecided rounded up, of what is proved down."""
    millionths = round(share * 1e6)
    parts = -(-millionths // 100) if said == "undecided" else millionths // 100
    return f"{parts / 100:.2f}%"


class ChaosCells(Document):
    """Verdicts over a range of a parameter: a horseshoe, or a stable periodic orbit."""

    @property
    def shares(self) -> dict[str, float]:
        """Fractions of the range.

        Those proved to hold a ``horseshoe``; where the scene's own orbit is ``attracted``; where another ``stable`` periodic orbit exists;
        with a horseshoe and a stable orbit, ``both``; with none of these, ``undecided``.
        """
        return dict(self.document["shares"])

    @property
    def stretches(self) -> list[dict[str, Any]]:
        """The subintervals with their verdicts, in the order of the parameter."""
        return list(self.document["stretches"])

    def __repr__(self) -> str:
        parts = ", ".join(f"{percent(said, part)} {said}" for said, part in self.shares.items())
        return f"<{self.document['over']['key']} in {len(self.stretches)} stretches: {parts}>"


class Description(Document):
    """Proved properties of a motion: its fate, exponent, region, horseshoe, and what is undecided."""

    @property
    def fate(self) -> str:
        """The kind: attracted, periodic, rests-forever, never-impacts, stays-in-region or undecided."""
        return str(self.document["fate"]["kind"])

    @property
    def message(self) -> str:
        """The fate in words."""
        return str(self.document["fate"]["message"])

    @property
    def since(self) -> int | None:
        """The impact from which on the motion is near the attracting orbit, or in the region; 0 is the start."""
        found: int | None = self.document["fate"].get("from")
        return found

    @property
    def period(self) -> tuple[int, int] | None:
        """Impacts and forcing periods of the attracting orbit, or of the periodic motion; of a complete chatter the listed impacts."""
        found = self.document["fate"].get("period")
        return None if found is None else (found["impacts"], found["cycles"])

    @property
    def word(self) -> str | None:
        """The word of the attracting orbit, the right-most mapping first in time."""
        found: str | None = self.document["fate"].get("word")
        return found

    @property
    def orbit(self) -> PeriodicOrbit | None:
        """The attracting orbit."""
        found = self.document["fate"].get("orbit")
        return None if found is None else PeriodicOrbit(found)

    @property
    def exponent_limit(self) -> Bounds | None:
        """Bounds of the Lyapunov exponent per impact in the limit; None where the motion is not attracted, and after a graze."""
        return pair(self.document["exponent"]["limit"])

    @property
    def exponent_finite_time(self) -> Bounds | None:
        """Bounds of the exponent per impact over the certified impacts; ``-inf`` where the ball comes to rest."""
        return pair(self.document["exponent"]["finite_time"])

    @property
    def region(self) -> Trap | None:
        """The trapping region, if one is proved."""
        found = self.document["region"]
        return None if found is None else Trap(json.dumps(found), found["entered_at_impact"] is not None)

    @property
    def entropy(self) -> float | None:
        """A lower bound of the topological entropy of the impact map [nats per impact]; None if no horseshoe is proved."""
        return self._down("per_impact")

    @property
    def entropy_per_cycle(self) -> float | None:
        """A lower bound of the topological entropy [nats per forcing period]; None if no horseshoe is proved."""
        return self._down("per_cycle")

    def _down(self, key: str) -> float | None:
        found = self.document["entropy"]
        return None if found is None else float(outward([(found[key], found[key])])[0, 0])

    @property
    def undecided(self) -> list[dict[str, str]]:
        """The questions that are undecided, each with a ``command`` that goes on."""
        return list(self.document["undecided"])

    @property
    def not_examined(self) -> list[dict[str, str]]:
        """The questions that were not examined, each with the ``reason``."""
        return list(self.document.get("not_examined", []))

    @property
    def lines(self) -> list[tuple[str, str]]:
        """The description in words: lines, each with its label."""
        return _core.description_lines(self.json())

    def _repr_html_(self) -> str:
        rows = "".join(
            f'<tr><th style="text-align: left">{html.escape(label)}</th><td style="text-align: left">{html.escape(text)}</td></tr>'
            for label, text in self.lines
        )
        return f"<table>{rows}</table>" + (self.svg or "")

    def __repr__(self) -> str:
        return "\n".join(f"{label:12}  {text}" for label, text in self.lines)


class Trade(Document):
    """The cost of accuracy, for each arithmetic."""

    @property
    def certified(self) -> bool:
        """Always false: it is a measurement."""
        return False

    @property
    def rungs(self) -> list[dict[str, Any]]:
        """The arithmetics, in the order of measurement."""
        return list(self.document["rungs"])

    def to_pandas(self) -> Any:
        """Return a DataFrame with one row per arithmetic."""
        import pandas as pd

        return pd.json_normalize(self.rungs)

    def _repr_svg_(self) -> str | None:
        return self.svg

    def __repr__(self) -> str:
        return f"<trade of {len(self.rungs)} arithmetics>"


class Audit(Document):
    """An audit: another simulator's list, compared with the certified orbit."""

    @property
    def certified(self) -> bool:
        """Always true: the list is compared with a certified orbit."""
        return True

    @property
    def agreed(self) -> bool:
        """True if all rows are inside or in a chatter, and no impact is missed."""
        return bool(self.document["agreed"])

    @property
    def message(self) -> str:
        """The result in words."""
        return str(self.document["message"])

    @property
    def unused_columns(self) -> list[str]:
        """The columns of the list that were not read."""
        return list(self.document["unused_columns"])

    @property
    def counts(self) -> dict[str, int]:
        """Number of rows or certified impacts with each verdict."""
        return dict(self.document["counts"])

    @property
    def first_disagreement(self) -> dict[str, Any] | None:
        """Impact, verdict and row of the first one, if any."""
        found: dict[str, Any] | None = self.document.get("first_disagreement")
        return found

    @property
    def events(self) -> list[dict[str, Any]]:
        """Verdict, row, listed values, certified values and errors, for each row and each missed impact."""
        return list(self.document["events"])

    def to_pandas(self) -> Any:
        """Return a DataFrame with one row per event."""
        import pandas as pd

        return pd.json_normalize(self.events)

    def __repr__(self) -> str:
        return self.message


class Picture(Document):
    """A picture as SVG, and whether it is certified."""

    def __init__(self, svg: str, complete: bool | None = None, interrupted: bool = False, verdict: str | None = None) -> None:
        super().__init__("", complete, interrupted, svg)
        self.verdict = verdict or ""

    @property
    def certified(self) -> bool:
        """True if the picture is proved."""
        return not self.verdict.startswith("computed")

    def json(self) -> str:
        """Return the verdict: a picture has no document."""
        return json.dumps({"verdict": self.verdict})

    def _repr_svg_(self) -> str | None:
        return self.svg

    def __repr__(self) -> str:
        return f"<picture: {self.verdict}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Picture, (self.svg, self.complete, self.interrupted, self.verdict)


def listing(events: str | os.PathLike[str] | Mapping[str, Any] | Any) -> str:
    """Return another simulator's impacts as text: a file's, or arrays by name as CSV, each number as its exact decimal.

    Raises
    ------
    ListError
        When it is none of these, some values are masked, or the columns are of several lengths.

    """
    if isinstance(events, (str, os.PathLike)):
        return read(events, ListError)
    if not isinstance(events, Mapping) and not hasattr(events, "columns"):
        raise ListError(f"events is {events!r}, but must be a path, arrays by name or a DataFrame", "events", repr(events))
    named = dict(events) if isinstance(events, Mapping) else {name: events[name] for name in events.columns}
    masked = [name for name, column in named.items() if np.ma.is_masked(column)]
    if masked:
        raise ListError(f"{masked[0]} has masked values, but must be numbers or names of walls", "events", str(masked[0]))
    columns = [np.asarray(column) for column in named.values()]
    lengths = [len(column) for column in columns]
    if len(set(lengths)) > 1:
        said = f"the columns have {', '.join(map(str, lengths))} values, but must have one number of them"
        raise ListError(said, "events", repr(lengths))
    out = io.StringIO()
    rows = csv.writer(out)
    rows.writerow([heading(name, place + 1) for place, name in enumerate(named)])
    rows.writerows([[decimal(cell) for cell in row] for row in zip(*columns, strict=True)])
    return out.getvalue()


def heading(name: Any, place: int) -> str:
    """Return the name of a column: where it is a number, as a DataFrame without names has, one that cannot be taken for a value."""
    try:
        float(name)
    except (TypeError, ValueError):
        return str(name)
    return f"column {place}"


def decimal(cell: Any) -> str:
    """Return a value of a list as text: of a double or a long double its exact decimal."""
    if isinstance(cell, (float, np.floating)):
        value = plain(cell)
        if not isinstance(value, Fraction):
            return str(Decimal(float(value)))
        # A long double: over a power of two, so that it is a whole number over that power of ten.
        power = value.denominator.bit_length() - 1
        return f"{value.numerator * 5**power}e-{power}"
    return str(cell)
