"""First flights made to be hard, with data that are decimals of 17 digits at most; A = 1, W = 2 pi, period 1.

Each is aimed with 50 digits so that a peak passes the wall, or falls short of it, by a depth in gaps. Each also comes
mirrored: walls changed, tau + pi.
"""
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from mpmath import mp, mpf

from flight import extrema, fly
from legs import DIGITS
from scene import LEFT, RIGHT, Scene

DEPTHS = ("1e-2", "1e-4", "1e-6", "1e-8", "1e-10", "1e-12")
FAR = (  # time, tau, e, v, number of the peak that is aimed at, periods to go on after it
    ("0", "1.2", "0.5", "-3", 1, "0.25"),
    ("0", "2.0", "0.5", "-6", 2, "2"),
    ("0", "2.5", "0.8", "-5", 1, "2"),
    ("1000.25", "1.2", "0.5", "-3", 1, "0.25"),
)
OWN = ("1.8", "2.0", "2.6")  # tau
HOPS = ("-1.2", "-0.4")      # tau, where the wall presses
LONG = (  # forcing periods, depths
    (10, ("1e-3", "1e-6", "1e-9")), (30, ("1e-3", "1e-6", "1e-9")), (100, ("1e-3", "1e-6", "1e-9")),
    (300, ("1e-6",)), (1000, ("1e-6",)), (2000, ("1e-6",)),
)


class Hard(NamedTuple):
    """A flight and the requested end."""
    family: str
    scene: Scene
    until: str


def text(value: mpf) -> str:
    """17 significant digits."""
    return mp.nstr(value, 17, min_fixed=-99, max_fixed=99)


def scene(time: str, tau: str, e: str, before: str, gap: str) -> Scene:
    """A scene that leaves the left wall."""
    return Scene("1", "2*pi", tau, gap, e, time, LEFT, before)


def rises(hard: Scene, until: int) -> list[tuple[mpf, mpf]]:
    """(time, height above the left wall) of the extrema within `until` periods, which take 1; the gap does not matter."""
    motion, start = hard.motion(), hard.start()
    height = fly(motion, start).height
    return [(time, height(time) + motion.gap / 2) for time in extrema(motion, start, start.time + until)]


def aimed(unaimed: Scene, peak: int, depth: mpf) -> tuple[Scene, mpf]:
    """The scene whose gap the peak of that number passes by `depth` (falls short, if negative), and the peak's time.

    The peaks before it are lower and the troughs above the left wall, or this is no flight to be aimed.
    """
    found = rises(unaimed, peak + 1)
    tops = [point for point in found if point[1] > 1e-9 and point[1] >= found[0][1]]
    time, top = tops[peak - 1]
    before = [rise for when, rise in found if when < time]
    assert all(0 < rise < top for rise in before), unaimed
    return replace(unaimed, gap=text(top / (1 + depth))), time


def far_wall(depths: tuple[str, ...]) -> Iterator[Hard]:
    """Grazes of the opposite wall, P1 and P2, and near misses."""
    for time, tau, e, before, peak, more in FAR:
        for depth in depths:
            for sign, family in ((1, "graze, far wall"), (-1, "miss, far wall")):
                hard, at = aimed(scene(time, tau, e, before, "1"), peak, sign * mpf(depth))
                yield Hard(family, hard, text(at + mpf(more)))


def own_wall(depths: tuple[str, ...]) -> Iterator[Hard]:
    """Grazes of the wall it left, P3 and P4, by the first trough, aimed by the velocity; and near misses."""
    gap = mpf(3)
    for tau in OWN:
        for depth in depths:
            for sign, family in ((1, "graze, own wall"), (-1, "miss, own wall")):
                def trough(after: mpf) -> tuple[mpf, mpf]:
                    return rises(scene("0", tau, "0.5", text_all(-2 * after), "3"), 2)[1]
                after = mp.findroot(lambda u: trough(u)[1] + sign * mpf(depth) * gap, (guess(tau), guess(tau) + 0.01))
                yield Hard(family, scene("0", tau, "0.5", text(-2 * after), "3"),
                           text(trough(after)[0] + mpf("0.25")))


def text_all(value: mpf) -> str:
    """All digits of the current precision."""
    return mp.nstr(value, mp.dps, min_fixed=-99, max_fixed=99)


def guess(tau: str) -> mpf:
    """A velocity after the impact whose drift takes the trough near th = 5 pi/2 back to the wall, about."""
    theta = mpf(tau)
    hop = (5 * mp.pi / 2 - theta) / (2 * mp.pi)
    return (1 - mp.sin(theta)) / hop - 2 * mp.pi * mp.cos(theta)


def hops(count: int) -> Iterator[Hard]:
    """Chatter: velocities 2e-1, 2e-2, ... where the wall presses; the first is back after about 1e-2 periods."""
    for tau in HOPS:
        for digits in range(1, count + 1):
            yield Hard("short hop", scene("0", tau, "0.5", f"-2e-{digits}", "3"), "0.25")


def long_flights(most: int) -> Iterator[Hard]:
    """Drifts of A/10 over n forcing periods, from th = pi/2; the n-th peak barely reaches the wall or falls short of it."""
    for turns, depths in LONG:
        for depth in depths if turns <= most else ():
            for sign, family in ((1, "long flight, reaches"), (-1, "long flight, falls short")):
                before = text(mpf(-2) / (10 * turns))
                hard, at = aimed(scene("0", "pi/2", "0.5", before, "1"), turns, sign * mpf(depth))
                yield Hard(family, hard, text(at + mpf("0.25")))


def mirrored(hard: Hard) -> Hard:
    """The same flight from the right wall."""
    image = replace(hard.scene, phase=f"{hard.scene.phase} + pi", wall=RIGHT, before=hard.scene.before.lstrip("-"))
    return hard._replace(scene=image)


def flights(quick: bool) -> list[Hard]:
    """The whole set, or a part of it; of flights of 300 forcing periods and more only one side."""
    with mp.workdps(DIGITS):
        # The shallowest and the deepest.
        depths = DEPTHS[::5] if quick else DEPTHS
        short = [*far_wall(depths), *own_wall(depths), *hops(4 if quick else 8), *long_flights(10 if quick else 100)]
        longer = [] if quick else [hard for hard in long_flights(2000) if hard not in short]
        return [side for hard in short for side in (hard, mirrored(hard))] + longer
