"""Copies of a right list with one thing wrong, and the findings that must be made of each, no more and no less."""
from collections.abc import Iterator, Sequence
from decimal import Decimal
from typing import NamedTuple

from lists import Row
from scene import LEFT, RIGHT

OTHER = {LEFT: RIGHT, RIGHT: LEFT}
SHIFT = Decimal("1e-6")


class Found(NamedTuple):
    """A finding that disagrees: its verdict, and the impact or, of a false one, the row, both from 1."""
    verdict: str
    number: int


class Spoiled(NamedTuple):
    """A list and what must be found of it."""
    name: str
    rows: list[Row]
    expected: list[Found]


def spoil(rows: Sequence[Row], number: int) -> Iterator[Spoiled]:
    """The list with impact `number` (from 1, neither the first nor the last) spoiled in each way."""
    at = number - 1
    before, row, after = list(rows[:at]), rows[at], list(rows[at + 1:])
    yield Spoiled("removed", [*before, *after], [Found("missed", number)])
    yield Spoiled("doubled", [*before, row, row, *after], [Found("false", number + 1)])
    late = row._replace(time=str(Decimal(row.time) + SHIFT))
    yield Spoiled("shifted by 1e-6", [*before, late, *after], [Found("outside", number)])
    fast = row._replace(velocity=str(Decimal(row.velocity) * (1 + SHIFT)))
    yield Spoiled("faster by 1e-6", [*before, fast, *after], [Found("outside", number)])
    wall = row._replace(wall=OTHER[row.wall])
    yield Spoiled("on the other wall", [*before, wall, *after], [Found("false", number), Found("missed", number)])
    middle = row._replace(time=str((Decimal(row.time) + Decimal(rows[at + 1].time)) / 2 + SHIFT))
    yield Spoiled("invented", [*before, row, middle, *after], [Found("false", number + 1)])
    far = row._replace(time=rows[-2].time, wall=rows[-2].wall)
    yield Spoiled("out of place", [*before, far, *after], [Found("false", number), Found("missed", number)])
