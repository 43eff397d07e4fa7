"""A reference's claims about one flight, beside the certified ones: its class, and the trial of an earlier contact."""
from enum import StrEnum

from mpmath import mp, mpf

from flight import extrema, fly
from legs import DIGITS, SLACK, Leg
from simulator import Contact, Listing

NEAR = mpf("1e-6")  # periods


class Verdict(StrEnum):
    """Of a reference's first contact; the classes and the order of the report's tables."""
    RIGHT = "right"
    INEXACT = "inexact"
    MISSED = "missed"
    INVENTED = "invented"
    UNKNOWN = "unknown"


def distance(time: float, low: mpf, high: mpf) -> mpf:
    """Distance of a time from a bracket; negative before it, 0 in it."""
    exact = mpf(time)
    return exact - low if exact < low else exact - high if exact > high else mpf(0)


def is_it(leg: Leg, contact: Contact, within: mpf) -> bool:
    """True if a contact is the certified one: the same wall, off by at most `within` and by less than half the flight.

    What is off by more than half the flight is the departure, seen again, or another contact.
    """
    off = abs(distance(contact.time, leg.low, leg.high))
    return contact.wall == leg.wall and off <= within and off < (leg.low - leg.start.time) / 2


def classify(leg: Leg, listing: Listing) -> Verdict:
    """The class of the first contact of a list; inexact: off by a quarter period at most, no other peak is as near."""
    if not listing.contacts:
        if listing.ended not in ("time", "outside"):
            return Verdict.UNKNOWN
        return Verdict.MISSED if leg.wall else Verdict.RIGHT
    claim = listing.contacts[0]
    if leg.wall is None:
        return Verdict.INVENTED
    period = leg.motion.period
    if is_it(leg, claim, NEAR * period):
        return Verdict.RIGHT
    if is_it(leg, claim, period / 4):
        return Verdict.INEXACT
    return Verdict.INVENTED if claim.time <= leg.high else Verdict.MISSED


def is_earlier(leg: Leg, listing: Listing) -> bool:
    """True if a list claims a contact before the certified bracket, or one where none is certified."""
    return bool(listing.contacts) and mpf(listing.contacts[0].time) < leg.low


def proves_us_wrong(leg: Leg, claim: Contact) -> bool:
    """The trial of an earlier contact, to 50 digits: y is outside the gap at the claimed time, or later before `low`.

    A true contact, claimed a little too early, is outside at the next extremum, or at `low` if there is none before it.
    """
    with mp.workdps(DIGITS):
        time = mpf(claim.time)
        later = (extremum for extremum in extrema(leg.motion, leg.start, leg.low) if extremum > time)
        points = [point for point in (time, next(later, leg.low)) if point > leg.start.time]
        height = fly(leg.motion, leg.start).height
        return any(abs(height(point)) > leg.motion.gap / 2 + SLACK for point in points)


def denied(leg: Leg) -> Leg:
    """The claim that nothing happens until a hundredth of a period after the contact."""
    low = leg.high + leg.motion.period / 100
    return Leg(leg.motion, leg.start, None, low, low)
