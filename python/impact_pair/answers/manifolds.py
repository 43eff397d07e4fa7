"""Invariant manifolds, and their tangencies."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from .._document import Document, counted
from ..bounds import Bounds, outward

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..bounds import Doubles


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
        said = ", ".join(f"N = {curve.cycles}: {counted(len(curve.marks), 'point')}" for curve in self.curves)
        return f"<parameter manifolds over {self.document['over']}: {said}>"


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
        return f"<{said}: {counted(len(self), 'homoclinic tangency', 'homoclinic tangencies')}, others are not excluded>"
