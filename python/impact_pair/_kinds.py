"""Kinds of outcomes of a sweep as pictures show them: their names and colours, mirror images distinguished."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .bounds import middles, outward

if TYPE_CHECKING:
    from .sweep import SweepResult

#: Distinguishable with colour-vision deficiency.
BLUE, ORANGE, GREEN, PURPLE, SKY = "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9"
VERMILION, YELLOW, GREY, BLACK = "#d55e00", "#f0e442", "#999999", "#000000"
#: Colours of points in a diagram, by what is known of them; later ones are drawn on top.
CLASSES = {
    "undecided convergence": BLACK,
    "proved to converge to a periodic orbit": BLUE,
    "periodic through rest, or at an end": GREEN,
    "undecided, impacts before": VERMILION,
}
#: Letters of a word that a legend shows.
LETTERS = 10
#: Phases and velocities of one attractor differ by less: they are enclosed to 6 digits and more.
NEAR = 1e-4


def class_of(outcome: str) -> str:
    """Return the class of an outcome."""
    unproved, attracted, settled, undecided = CLASSES
    return {"attracted": attracted, "undecided-limit": unproved, "undecided": undecided}.get(outcome, settled)


@dataclass
class Kind:
    """A kind of outcome: an attractor, or another one."""

    name: str
    outcome: str
    #: Phase [rad] and velocity of the attractor where it hits the left wall first.
    first: tuple[float, float] | None
    points: int = 0


def first_of(period: dict[str, Any] | None) -> tuple[float, float] | None:
    """Return the first state of an attractor, if it is known."""
    found = None if period is None else period.get("first")
    if found is None:
        return None
    phase, velocity = middles(outward([found["phase"], found["velocity"]]))
    return float(phase), float(velocity)


def named(record: dict[str, Any], first: tuple[float, float] | None) -> str:
    """Return the name of the kind of a point."""
    period = record["period"]
    if period is None or not period.get("word"):
        outcome = str(record["outcome"])
        named_so = {"periodic": "exactly periodic through rest", "undecided-limit": "undecided convergence"}
        return named_so.get(outcome, outcome.replace("-", " "))
    # Of the right-most mapping first in time, the wall that it starts on.
    walls = "".join({"P1": "R", "P2": "L", "P3": "R", "P4": "L"}[mapping] for mapping in reversed(period["word"].split()))
    said = walls if len(walls) <= LETTERS else f"{walls[:LETTERS]}… ({len(walls)} impacts)"
    cycles = period.get("cycles")
    lasting = "no whole cycles" if cycles is None else f"{cycles} cycle{'' if cycles == 1 else 's'}"
    return f"{said} in {lasting}" + ("" if first is None else f", L at {first[0]:.2f} rad")


def is_near(a: tuple[float, float], b: tuple[float, float]) -> bool:
    """Return whether two states are of one attractor, phases modulo 2 pi."""
    return abs(math.remainder(a[0] - b[0], 2 * math.pi)) < NEAR and abs(a[1] - b[1]) < NEAR * (1 + abs(a[1]))


def kinds_of(found: SweepResult, *, by_place: bool) -> tuple[list[Kind], list[int]]:
    """Return the kinds of outcomes, and the number of that of each point; of one pair by where attractors are, else by their words."""
    kinds: list[Kind] = []
    numbers = []
    for record in found:
        first = first_of(record["period"]) if by_place else None
        kind = Kind(named(record, first), record["outcome"], first)
        number = next((number for number, other in enumerate(kinds) if is_alike(kind, other)), len(kinds))
        if number == len(kinds):
            kinds.append(kind)
        kinds[number].points += 1
        numbers.append(number)
    return kinds, numbers


def is_alike(a: Kind, b: Kind) -> bool:
    """Return whether two kinds are one: attractors that are near each other, or others of one name."""
    if a.first is None or b.first is None:
        return a.first is b.first and (a.name, a.outcome) == (b.name, b.outcome)
    return is_near(a.first, b.first)


def colours_of(kinds: list[Kind]) -> list[str]:
    """Return a colour for each kind: the attractors with the most points have their own."""
    attractors = sorted((i for i, kind in enumerate(kinds) if kind.outcome == "attracted"), key=lambda i: -kinds[i].points)
    ranked = dict(zip(attractors, (BLUE, ORANGE, GREEN, PURPLE, SKY), strict=False))
    other = {"attracted": GREY, "undecided": VERMILION, "undecided-limit": BLACK}
    return [ranked.get(i, other.get(kind.outcome, YELLOW)) for i, kind in enumerate(kinds)]
