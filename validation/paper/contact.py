"""The first contact of a flight, proved for all states in two balls at once.

With s = th - th0, z the height above the left wall and u = -e v0: z = z(0) + c s - sin(th0 + s) + sin th0, z' = c -
cos(th0 + s), z'' = sin(th0 + s), from (10)-(12) in the units of pair.py. A flight is cut into parts from left to right.
"""
from collections import namedtuple

from flint import arb

LONGEST, SHORTEST, FIRST = 400, arb(2) ** -60, arb("0.25")
# wall: touched first; isolating: holds no other contact; th: a narrower ball of the phase of contact.
Contact = namedtuple("Contact", "wall isolating th")


class Undecided(Exception):
    """Nothing was proved: a graze, or balls that are too wide."""


class Flight:
    """All flights from `wall` with phase and velocity before the impact in the balls th0, v0."""

    def __init__(self, pair, wall, th0, v0):
        self.gap, self.th0, self.u = pair.gap, th0, -pair.e * v0
        self.z0, self.c, self.inward = pair.level(wall), pair.drift(th0, v0), 1 if wall == "left" else -1

    def height(self, s):
        """z(s)."""
        return self.z0 + self.c * s - (self.th0 + s).sin() + self.th0.sin()

    def departs(self, b):
        """No contact in (0, b]: (z(s) - z(0))/s = u + z''/2 s keeps its sign, and the other wall is not reached."""
        part = arb(0).union(b)
        slope = self.inward * (self.u + (self.th0 + part).sin() * part / 2)
        return slope > 0 and slope * b < self.gap

    def clear(self, a, b):
        """No contact in [a, b]: Taylor's form around the middle, with z'' over the part."""
        part = a.union(b)
        m = part.mid()
        x = part - m
        z = self.height(m) + (self.c - (self.th0 + m).cos()) * x + (self.th0 + part).sin() * x * x / 2
        return 0 < z < self.gap

    def crosses(self, a, b):
        """The wall of the one contact in (a, b], if z' has one sign there and z(b) is beyond a wall; else None."""
        slope, z = self.c - (self.th0 + a.union(b)).cos(), self.height(b)
        return "right" if slope > 0 and z > self.gap else "left" if slope < 0 and z < 0 else None

    def newton(self, level, bracket):
        """The bracket of one contact, narrowed by interval Newton as long as that helps."""
        while True:
            m = bracket.mid()
            narrower = bracket.intersection(m - (self.height(m) - level) / (self.c - (self.th0 + bracket).cos()))
            if not 3 * narrower.rad() < 2 * bracket.rad():
                return narrower
            bracket = narrower


def first_contact(pair, wall, th0, v0):
    """The first contact of every flight of the set, once and on the same wall, or Undecided."""
    flight, a, width = Flight(pair, wall, th0, v0), arb(0), FIRST
    while a < LONGEST:
        b = (a + width).mid()
        if flight.departs(b) if a == 0 else flight.clear(a, b):
            a, width = b, 2 * width
            continue
        touched = None if a == 0 else flight.crosses(a, b)
        if touched:
            bracket = a.union(b)
            return Contact(touched, th0 + bracket, th0 + flight.newton(pair.level(touched), bracket))
        width = width / 2
        if width < SHORTEST:
            raise Undecided(f"a graze, or too wide a set, {a.str(8)} after the impact")
    raise Undecided(f"no contact within {LONGEST} radians")
