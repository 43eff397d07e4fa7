"""All that is measured: certified answers, the references' answers, and the verdicts."""
from dataclasses import dataclass
from itertools import chain
from typing import NamedTuple

from legs import Leg
from questions import FIGURES, Flown, Orbit
from runs import Answer
from verdicts import Tally


class Answers(NamedTuple):
    """The answers of one reference: whole orbits, their flights one by one, hard flights, chatter."""
    orbits: list[Answer]
    flights: list[Answer]
    hard: list[Answer]
    chatter: Answer


def parted(answers: list[Answer], flights: int, hard: int) -> Answers:
    """The answers in the order of the questions: orbits, `flights` single flights, `hard` adversarial flights, chatter."""
    rest = iter(answers)
    orbits, singles, adversarial = ([next(rest) for _ in range(count)] for count in (len(FIGURES), flights, hard))
    return Answers(orbits, singles, adversarial, next(rest))


@dataclass(frozen=True)
class Results:
    """Everything the report needs; lists over the references are in the order of SIMULATORS."""
    orbits: list[Orbit]
    chatter: Orbit
    flown: list[Flown]
    answers: list[Answers]
    flights: list[Tally]
    hard: list[Tally]
    denied: tuple[int, int]
    disagreements: list[str]

    @property
    def asked(self) -> int:
        """Certified flights that the references were asked for."""
        return sum(len(orbit.legs) for orbit in (*self.orbits, self.chatter)) + len(decided(self.flown))

    @property
    def tallies(self) -> list[Tally]:
        """Those of all single flights."""
        return [*self.flights, *self.hard]


def single(orbits: list[Orbit]) -> list[Leg]:
    """All flights of the orbits, one after the other."""
    return list(chain.from_iterable(orbit.legs for orbit in orbits))


def decided(flown: list[Flown]) -> list[Flown]:
    """The hard flights that the program answers."""
    return [one for one in flown if one.leg is not None]
