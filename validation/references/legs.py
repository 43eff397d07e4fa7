"""The flights of a certified listing: from each impact, at the middle of its bounds, to the next.

That the listing is right is shown elsewhere: figures by `validation/arb`, hard flights and chatters, which `data` has, by `validation/truth`.
"""
from typing import NamedTuple

from mpmath import mp, mpf

from program import Certified
from scene import Motion, Scene, Start

DIGITS = 50            # of a flight
SLACK = mpf(10) ** -15  # above what states of 20 digits leave uncertain, in the units of a scene


class Leg(NamedTuple):
    """A flight and what the program claims of it: contact with `wall` in [low, high]; no wall: none before `low`."""
    motion: Motion[mpf]
    start: Start[mpf]
    wall: str | None
    low: mpf
    high: mpf


def legs_of(scene: Scene, certified: Certified, until: str | None = None) -> list[Leg]:
    """All flights; `until`: no further event comes before that time."""
    with mp.workdps(DIGITS):
        motion, start = scene.motion(), scene.start()
        found: list[Leg] = []
        for event in certified.events:
            low, high = map(mpf, event.time)
            if event.kind == "impact":
                found.append(Leg(motion, start, event.wall, low, high))
                before = sum(map(mpf, event.velocity)) / 2
                start = Start((low + high) / 2, event.wall, -motion.restitution * before)
            elif event.kind == "release":
                start = Start((low + high) / 2, event.wall, mpf(0))
        if until:
            found.append(Leg(motion, start, None, mpf(until), mpf(until)))
        return found
