"""Trapping regions, components of the chain recurrent set, and symbolic dynamics."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from .._document import Document, counted
from ..bounds import Bounds, outward
from .orbits import PeriodicOrbit


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
            return str(self.document["message"])
        return f"<region of {counted(self.boxes, 'box', 'boxes')}, entered at impact {self.entered_at_impact}>"


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
        return f"{said}: topological entropy at least {bounds}; {counted(len(self.words), 'word')}"


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
        return f"<{self.document['over']['key']} in {counted(len(self.stretches), 'stretch', 'stretches')}: {parts}>"
