"""A judge of its own for the part of an audit that needs no alignment: row k beside impact k, in exact fractions."""
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from mpmath import mp, mpf

from lists import Row
from scene import Motion


class Bounds(NamedTuple):
    """A certified impact."""
    wall: str
    time: tuple[Fraction, Fraction]
    velocity: tuple[Fraction, Fraction]


class Beginning(NamedTuple):
    """Of a list that follows the orbit for a while: the first impact outside or on another wall, and the first on another."""
    wrong: int | None
    word: int | None


def bounds(document: dict) -> list[Bounds]:
    """The impacts of an orbit JSON."""
    impacts = (event for event in document["events"] if event["event"] == "impact")
    pair = lambda texts: (Fraction(texts[0]), Fraction(texts[1]))
    return [Bounds(event["wall"], pair(event["time"]), pair(event["velocity"])) for event in impacts]


def exceeds(listed: str, certified: tuple[Fraction, Fraction], allowed: Fraction) -> bool:
    """True if a number is farther from the bounds than allowed."""
    value, (low, high) = Fraction(listed), certified
    return value < low - allowed or value > high + allowed


def beginning(rows: Sequence[Row], truth: Sequence[Bounds], motion: Motion[mpf], tolerance: Fraction) -> Beginning:
    """Compares row k with impact k as long as the walls agree."""
    with mp.workdps(60):
        period, speed = (Fraction(mp.nstr(value, 50)) for value in (motion.period, motion.amplitude * motion.omega))
    wrong = None
    for number, (row, impact) in enumerate(zip(rows, truth), 1):
        is_other = row.wall != impact.wall
        if wrong is None and (is_other or exceeds(row.time, impact.time, tolerance * period)
                              or exceeds(row.velocity, impact.velocity, tolerance * speed)):
            wrong = number
        if is_other:
            return Beginning(wrong, number)
    return Beginning(wrong, None)
