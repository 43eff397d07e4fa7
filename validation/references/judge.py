"""The judge: retraces a certified listing with mpmath, flight by flight, and says where it is wrong.

A flight is right if its contact lies in the bracket (at its lower end the ball is inside, at its upper end outside),
if the velocity there lies in its bounds, and if y is inside the gap at every extremum before the bracket: between
extrema y is monotone, so there is no earlier contact.
"""
from typing import NamedTuple

from mpmath import mp, mpf

from flight import extrema, fly
from program import Certified, Event
from scene import SIGN, Motion, Scene, Start

DIGITS = 120           # of an orbit; 200 impacts of chaos eat 0.6 bits each, 36 digits in all
FLIGHT_DIGITS = 50     # of a single flight
SLACK = mpf(10) ** -40  # above the rounding errors of both, in the units of a scene


class Leg(NamedTuple):
    """A flight and what the program claims of it: contact with `wall` in [low, high]; no wall: none before `low`."""
    motion: Motion[mpf]
    start: Start[mpf]
    wall: str | None
    low: mpf
    high: mpf


class Judged(NamedTuple):
    """The errors of a listing, and its flights up to the first wrong one."""
    problems: list[str]
    legs: list[Leg]


def departs(motion: Motion[mpf], start: Start[mpf]) -> bool:
    """True if the ball leaves its wall inward: by v+, or by y'' if v+ = 0, or by y''' if that is 0 too."""
    theta, inward = motion.omega * start.time + motion.tau, -SIGN[start.wall]
    for derivative in (start.after, mp.sin(theta), mp.cos(theta)):
        if abs(derivative) > SLACK:
            return derivative * inward > 0
    return False


def earlier(motion: Motion[mpf], start: Start[mpf], until: mpf) -> list[str]:
    """Contacts in (t_i, until): the extrema there at which y is not inside the gap, and `until` if it is outside."""
    height = fly(motion, start).height
    found = [] if departs(motion, start) else [f"does not leave the {start.wall} wall at {mp.nstr(start.time, 20)}"]
    for time in (*extrema(motion, start, until), until):
        if time - start.time > SLACK and abs(height(time)) > motion.gap / 2 + (SLACK if time == until else -SLACK):
            found.append(f"a wall is touched at or before {mp.nstr(time, 20)}")
    return found


def root(leg: Leg) -> mpf:
    """The contact in the bracket, by Newton's iteration from its middle."""
    height, velocity, _ = fly(leg.motion, leg.start)
    time = (leg.low + leg.high) / 2
    for _ in range(10):
        time -= (height(time) - SIGN[leg.wall] * leg.motion.gap / 2) / velocity(time)
    return time


def judge_impact(leg: Leg, velocity: tuple[str, str]) -> tuple[list[str], Start[mpf]]:
    """The errors of an impact, and the departure after it, by (15)."""
    motion = leg.motion
    flight = fly(motion, leg.start)
    name = f"{leg.wall} wall in [{mp.nstr(leg.low, 25)}, {mp.nstr(leg.high, 25)}]"
    problems = [f"{name}: {proof}" for proof in earlier(motion, leg.start, leg.low)]
    if SIGN[leg.wall] * flight.height(leg.high) < motion.gap / 2 - SLACK:
        problems.append(f"{name}: inside the gap at the upper end")
    if problems:
        return problems, leg.start
    time = root(leg)
    before = flight.velocity(time)
    if not leg.low - SLACK <= time <= leg.high + SLACK:
        problems.append(f"{name}: the contact is at {mp.nstr(time, 25)}")
    if not mpf(velocity[0]) - SLACK <= before <= mpf(velocity[1]) + SLACK:
        problems.append(f"{name}: the velocity is {mp.nstr(before, 25)}")
    return problems, Start(time, leg.wall, -motion.restitution * before)


def judge_rest(motion: Motion[mpf], start: Start[mpf], low: mpf, high: mpf) -> list[str]:
    """The errors of the time of a rest: the chatter is followed until its velocity is below 1e-35."""
    while abs(start.after) > mpf(10) ** -35:
        height, velocity, _ = fly(motion, start)
        since, wall = start.time, SIGN[start.wall] * motion.gap / 2
        push = motion.amplitude * motion.omega**2 * mp.sin(motion.omega * since + motion.tau)
        guess = -2 * start.after / push
        hop = mp.findroot(lambda h: (height(since + h) - wall) / h, (guess, guess * mpf("1.001")))
        start = Start(since + hop, start.wall, -motion.restitution * velocity(since + hop))
    margin = mpf(10) ** -30
    return [] if low - margin <= start.time <= high + margin else [f"the chatter ends at {mp.nstr(start.time, 25)}"]


def judge_release(motion: Motion[mpf], wall: str, low: mpf, high: mpf) -> tuple[list[str], Start[mpf]]:
    """The errors of a release: W t + tau is a multiple of pi there, and the ball leaves."""
    multiple = mp.nint((motion.omega * low + motion.tau) / mp.pi)
    start = Start((multiple * mp.pi - motion.tau) / motion.omega, wall, mpf(0))
    right = low - SLACK <= start.time <= high + SLACK and departs(motion, start)
    return ([] if right else [f"no release from the {wall} wall in [{low}, {high}]"]), start


def judge(scene: Scene, certified: Certified, digits: int, until: str | None = None) -> Judged:
    """Retraces a listing with `digits` digits, up to its first problem; `until`: no further event comes before that time."""
    with mp.workdps(digits):
        motion, start = scene.motion(), scene.start()
        legs: list[Leg] = []
        for event in certified.events:
            problems, start = judge_event(motion, start, event, legs)
            if problems:
                return Judged(problems, legs)
        problems = []
        if until:
            end = mpf(until)
            legs.append(Leg(motion, start, None, end, end))
            problems = earlier(motion, start, end)
        return Judged(problems, legs)


def judge_event(motion: Motion[mpf], start: Start[mpf], event: Event, legs: list[Leg]) -> tuple[list[str], Start[mpf]]:
    """The errors of an event, and the departure after it; adds the flight of an impact to `legs`."""
    low, high = map(mpf, event.time)
    match event.kind:
        case "impact":
            legs.append(Leg(motion, start, event.wall, low, high))
            return judge_impact(legs[-1], event.velocity)
        case "rest":
            return judge_rest(motion, start, low, high), start
        case "release":
            return judge_release(motion, event.wall, low, high)
    return [f"an event that this judge does not know: {event.kind}"], start
