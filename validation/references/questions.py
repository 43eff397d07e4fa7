"""The certified answers, and the questions that the references get: orbits, flights, rest."""
from dataclasses import dataclass
from pathlib import Path

from adversarial import Hard, flights
from legs import Leg, legs_of
from program import Certified, certify
from runs import Question
from scene import Scene, doubles, rounded

FIGURES = (12, 13, 14, 15, 16, 17)
ASKED_DIGITS = 20
CHATTER_UNTIL = "5"
CHATTER_IMPACTS = 1000  # a reference that lists this many impacts is stuck


@dataclass(frozen=True)
class Orbit:
    """A scene, what is certified of it, and its flights."""
    name: str
    scene: Scene
    certified: Certified
    legs: list[Leg]

    def question(self, until: float, limit: int, timed: bool) -> Question:
        """The whole orbit, from the scene's own data."""
        first = self.legs[0]
        return Question(doubles(first.motion), rounded(first.start), until, limit, timed)


@dataclass(frozen=True)
class Flown:
    """A hard flight; `leg` is None where the program is undecided."""
    hard: Hard
    leg: Leg | None


def figure(program: str, scenes: Path, number: int, impacts: int) -> Orbit:
    """A figure of the paper."""
    scene = Scene.read(scenes / f"figure-{number}.toml")
    certified = certify(program, scene, impacts, ASKED_DIGITS)
    return Orbit(f"figure {number}", scene, certified, legs_of(scene, certified))


def whole(orbit: Orbit) -> Question:
    """The orbit from its start, without an end in time that a reference could meet before it has all the impacts."""
    last, period = orbit.legs[-1].high, orbit.legs[-1].motion.period
    return orbit.question(float(2 * last + 100 * period), len(orbit.legs), timed=True)


def restarted(leg: Leg) -> Question:
    """One flight of an orbit, from the certified state rounded to doubles, so that chaos has no part in it."""
    return Question(doubles(leg.motion), rounded(leg.start), float(leg.high + 2 * leg.motion.period), 1)


def hard_flights(program: str, quick: bool) -> list[Flown]:
    """The adversarial set, certified."""
    return [fly_hard(program, hard) for hard in flights(quick)]


def fly_hard(program: str, hard: Hard) -> Flown:
    """A hard flight, certified."""
    certified = certify(program, hard.scene, 1, ASKED_DIGITS, hard.until)
    if certified.outcome == "undecided":
        return Flown(hard, None)
    return Flown(hard, legs_of(hard.scene, certified, None if certified.events else hard.until)[-1])


def hard_question(flown: Flown) -> Question:
    """The hard flight from its data rounded to doubles."""
    return Question(doubles(flown.leg.motion), rounded(flown.leg.start), float(flown.hard.until), 1)


def chatter(program: str, scenes: Path) -> Orbit:
    """The scene that chatters, rests and is released."""
    scene = Scene.read(scenes / "chatter.toml")
    certified = certify(program, scene, CHATTER_IMPACTS, ASKED_DIGITS, CHATTER_UNTIL)
    return Orbit("chatter", scene, certified, legs_of(scene, certified, CHATTER_UNTIL))
