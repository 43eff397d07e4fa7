"""The results of each reference: drift along orbits, classes of single flights, trials of its earlier contacts, chatter."""
from dataclasses import dataclass
from typing import NamedTuple

from mpmath import mpf

from claims import NEAR, Verdict, classify, distance, is_earlier, is_it, proves_us_wrong
from legs import Leg
from runs import Answer
from scene import RIGHT
from simulator import Contact, Listing, Simulator


class Drift(NamedTuple):
    """The first impact of an orbit that is off by more than each limit, or on another wall; None: none is."""
    own: int | None    # more than the simulator's tolerance, in periods
    near: int | None   # more than NEAR periods
    other: int | None  # more than a quarter period: an impact was missed or invented, or the wall is wrong
    agree: int         # impacts before `near`


def first_off(legs: list[Leg], contacts: list[Contact], within: mpf) -> int | None:
    """The number, from 1, of the first contact that is missing, on another wall, or off by more than `within` periods."""
    for number, leg in enumerate(legs, 1):
        if number > len(contacts):
            return number
        contact = contacts[number - 1]
        if contact.wall != leg.wall or abs(distance(contact.time, leg.low, leg.high)) > within * leg.motion.period:
            return number
    return None


def drift(legs: list[Leg], contacts: list[Contact], tolerance: float) -> Drift:
    """The impact up to which a list follows the certified one, by each tolerance."""
    own, near, other = (first_off(legs, contacts, mpf(within)) for within in (tolerance, NEAR, 0.25))
    return Drift(own, near, other, near - 1 if near else len(legs))


def errors(legs: list[Leg], contacts: list[Contact]) -> list[float]:
    """Distances to the certified brackets in periods, up to the first other impact."""
    end = (first_off(legs, contacts, mpf(0.25)) or len(legs) + 1) - 1
    return [float(abs(distance(contact.time, leg.low, leg.high)) / leg.motion.period)
            for leg, contact in zip(legs[:end], contacts)]


@dataclass(frozen=True)
class Tally:
    """One reference's single flights."""
    verdicts: list[Verdict]
    earlier: int        # contacts before the certified bracket
    much_earlier: int   # by more than its tolerance
    proofs: list[str]   # those that prove us wrong

    def count(self, verdict: Verdict) -> int:
        """Flights of a class."""
        return self.verdicts.count(verdict)


def tally(simulator: Simulator, legs: list[Leg], answers: list[Answer]) -> Tally:
    """Classes of all flights; every contact earlier than certified is tried."""
    pairs = [(leg, reply.listing) for leg, reply in zip(legs, answers, strict=True)]
    claims = [(leg, listing.contacts[0]) for leg, listing in pairs if is_earlier(leg, listing)]
    much = [leg for leg, claim in claims
            if distance(claim.time, leg.low, leg.high) < -simulator.tolerance * leg.motion.period]
    proofs = [f"{simulator.name}: contact at {claim.time!r}, before {leg.low}: {leg.start}"
              for leg, claim in claims if proves_us_wrong(leg, claim)]
    return Tally([classify(leg, listing) for leg, listing in pairs], len(claims), len(much), proofs)


class Ending(NamedTuple):
    """A reference's listing of a chatter: impacts listed, how many of the first are right, its last time, why it
    ends, and whether it has the contact after the release."""
    listed: int
    right: int
    last: float
    ended: str
    after_release: bool


def ending(legs: list[Leg], listing: Listing) -> Ending:
    """Compares with the impacts before the rest, and with the first on the right wall after the release."""
    before = [leg for leg in legs if leg.wall == legs[0].wall]
    period = legs[0].motion.period
    right = 0
    for leg, contact in zip(before, listing.contacts):
        if not is_it(leg, contact, NEAR * period):
            break
        right += 1
    after = next(leg for leg in legs if leg.wall == RIGHT)
    found = any(is_it(after, contact, NEAR * period) for contact in listing.contacts)
    last = listing.contacts[-1].time if listing.contacts else float("nan")
    return Ending(len(listing.contacts), right, last, listing.ended, found)
