"""Periodic orbits of a word, of a region, and beside a bifurcation."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from .._document import Document, counted
from ..bounds import Bounds, outward, pair

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..bounds import Doubles


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
    def times(self) -> int | None:
        """Number of times that its impacts run through a shorter orbit: 1 if they do not; None if undecided."""
        found: int | None = self.fields.get("times", 1)
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
            | {"stability": orbit.stability, "physical": orbit.physical, "symmetric": orbit.symmetric, "times": orbit.times}
            for i, orbit in enumerate(self)
            for wall, phase, v in zip(orbit.walls, orbit.phase_bounds, orbit.v_bounds, strict=True)
        ]
        return pd.DataFrame(rows)

    def __repr__(self) -> str:
        rest = "proved to be all without sticking" if self.exhaustive else "others are not excluded"
        cycles, orbits = counted(self.cycles, "cycle"), counted(len(self), "orbit")
        lines = [f"{self.word} in {cycles}: {orbits}, {rest}", *map(repr, self)]
        return "\n".join(lines)


class TwoImpact(Document):
    """The motions with two impacts in each of one or several N."""

    @property
    def each(self) -> list[Periodic]:
        """An answer for each N."""
        found = json.loads(self.json())
        documents = found if isinstance(found, list) else [found]
        about = (self.complete, self.interrupted, None, self.status)
        return [Periodic(json.dumps(document, ensure_ascii=False), *about) for document in documents]


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
        return f"<{counted(len(self), 'cycle')}, {rest}; fixed points by impacts: {counts}>"


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
        lines = [f"over {over['key']} from {over['low']} to {over['high']}: {counted(len(self), 'bifurcation')}"]
        return "\n".join(lines + [f"{point.kind:16} {point.parameter}" for point in self.points])


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
        return f"<{said}: {counted(len(self), 'window')}, others are not excluded>"
