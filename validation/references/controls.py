"""Negative controls: certified listings spoiled on purpose, each of which the judge must refuse."""
from collections.abc import Callable
from dataclasses import replace

from mpmath import mp, mpf

from claims import proves_us_wrong
from judge import DIGITS, FLIGHT_DIGITS, Leg, judge
from program import Certified, Event
from questions import Flown, Orbit
from scene import LEFT, RIGHT
from simulator import Contact

AT = 4  # the event that is spoiled, counted from 0


def shifted(event: Event, periods: str, period: mpf) -> Event:
    """The event with its bracket of time moved by `periods` periods."""
    with mp.workdps(FLIGHT_DIGITS):
        ends = tuple(mp.nstr(mpf(end) + mpf(periods) * period, 40) for end in event.time)
    return event._replace(time=ends)


def swapped(event: Event) -> Event:
    """The same on the other wall."""
    return event._replace(wall=LEFT if event.wall == RIGHT else RIGHT)


def spoiled(orbit: Orbit) -> dict[str, Certified]:
    """Copies of an orbit's listing with one thing wrong in each."""
    events, period = orbit.certified.events, orbit.legs[0].motion.period

    def changed(change: Callable[[Event], list[Event]]) -> Certified:
        return replace(orbit.certified, events=[*events[:AT], *change(events[AT]), *events[AT + 1:]])

    return {
        "an impact removed": changed(lambda event: []),
        "an impact listed twice": changed(lambda event: [event, event]),
        "a bracket 1e-6 periods early": changed(lambda event: [shifted(event, "-1e-6", period)]),
        "a bracket 1e-6 periods late": changed(lambda event: [shifted(event, "1e-6", period)]),
        "a wall swapped": changed(lambda event: [swapped(event)]),
        "a velocity with the wrong sign": changed(lambda event: [event._replace(velocity=tuple(
            end[1:] if end.startswith("-") else "-" + end for end in reversed(event.velocity)))]),
    }


def denied(leg: Leg) -> Leg:
    """The claim that nothing happens until a hundredth of a period after the contact."""
    low = leg.high + leg.motion.period / 100
    return Leg(leg.motion, leg.start, None, low, low)


def control(orbit: Orbit, flown: list[Flown], contacts: list[tuple[Leg, Contact]]) -> dict[str, tuple[int, int]]:
    """For each kind of spoiled listing: how many were refused, of how many.

    `contacts`: contacts of references that are right; each must prove wrong who denies it.
    """
    found = {name: (int(bool(judge(orbit.scene, listing, DIGITS).problems)), 1)
             for name, listing in spoiled(orbit).items()}
    decided = [one for one in flown if one.leg is not None]
    touching = [one for one in decided if one.leg.wall is not None]
    nothing = Certified([], "time-reached")
    refused = [bool(judge(one.hard.scene, nothing, FLIGHT_DIGITS, one.hard.until).problems) for one in touching]
    found["the contact of a hard flight denied"] = (sum(refused), len(refused))
    invented = [bool(judge(one.hard.scene, invention(one), FLIGHT_DIGITS).problems)
                for one in decided if one.leg.wall is None]
    found["a contact at the end of a near miss"] = (sum(invented), len(invented))
    proofs = [proves_us_wrong(denied(leg), contact) for leg, contact in contacts]
    found["an impact denied, tried by a reference's contact"] = (sum(proofs), len(proofs))
    return found


def invention(flown: Flown) -> Certified:
    """A contact in the quarter period before the end of a flight that has none, with any velocity."""
    with mp.workdps(FLIGHT_DIGITS):
        early = mp.nstr(flown.leg.low - flown.leg.motion.period / 4, 30)
    wall = LEFT if flown.leg.start.wall == RIGHT else RIGHT
    return Certified([Event("impact", wall, (early, flown.hard.until), ("-1e9", "1e9"))], "impacts-reached")
