"""Flights from a quadrilateral of states of the reduced impact map, all at once, in Arb balls; who judges a tube uses them.

A state is a phase in turns and a speed over A W just before an impact on the left wall; lengths are in A. With x the angle since
the impact, the ball's distance from that wall is z = (e w + cos th) x - sin(th + x) + sin th, until z = 0 or z = D = d/A.
"""
from collections import namedtuple

from flint import arb

# D and e, exact or as balls.
Law = namedtuple("Law", "gap restitution")
# The two ends of a segment across a tube, each a state in balls that are exact.
Chord = namedtuple("Chord", "bottom top")
TURN = 2 * arb.pi()
# A piece is given up when parts of its flights' way are this short, in forcing periods.
SHORTEST = arb(2) ** -20


def around(middle, radius):
    """All within the radius, a bound of which is taken, of the middle."""
    return middle + arb(0, 1) * radius.abs_upper()


def minus(p, q):
    return p[0] - q[0], p[1] - q[1]


def cross(p, q):
    return p[0] * q[1] - p[1] * q[0]


def corners(start, end, from_a, to_a, from_b, to_b):
    """The corners of the part of a cell with a from `from_a` to `to_a` of the way to the chord `end`, b from bottom to top."""

    def at(a, b):
        sides = [(1 - a) * (1 - b), (1 - a) * b, a * (1 - b), a * b]
        ends = [start.bottom, start.top, end.bottom, end.top]
        return tuple(sum(share * point[i] for share, point in zip(sides, ends)) for i in (0, 1))

    return [at(a, b) for a in (from_a, to_a) for b in (from_b, to_b)]


class Flights:
    """The flights from c + a s + b t + ..., |a|, |b|, ... <= 1: from a middle and half sides, all of them balls."""

    @classmethod
    def of_corners(cls, law, of):
        """Those from c + a s + b t + a b k, a quadrilateral given by its corners."""
        signs = [(1, 1, 1, 1), (-1, -1, 1, 1), (-1, 1, -1, 1), (1, -1, -1, 1)]
        centre, *sides = (tuple(sum(sign * point[i] for sign, point in zip(of_signs, of)) / 4 for i in (0, 1)) for of_signs in signs)
        return cls(law, centre, sides)

    def __init__(self, law, centre, sides):
        self.law, self.centre, self.sides = law, centre, sides
        hull = [around(self.centre[i], sum(abs(side[i]) for side in self.sides)) for i in (0, 1)]
        self.start, self.after = hull[0], law.restitution * hull[1]
        self.sin, self.cos = (TURN * hull[0]).sin(), (TURN * hull[0]).cos()
        angle = TURN * self.centre[0]
        self.centre_sin, self.drift = angle.sin(), law.restitution * self.centre[1] + angle.cos()
        # By side: what changes the drift, and what the height besides.
        self.slopes = [
            (law.restitution * w - TURN * self.sin * u, TURN * self.after * u) for u, w in self.sides
        ]
        self.spread = sum(abs(drift) for drift, _ in self.slopes)

    def centre_height(self, phase):
        return TURN * (phase - self.centre[0]) * self.drift - (TURN * phase).sin() + self.centre_sin

    def height(self, phase):
        """z of all of them at a phase, by the mean value theorem from the centre's."""
        x = TURN * (phase - self.start)
        return around(self.centre_height(phase), sum(abs(x * drift - shift) for drift, shift in self.slopes))

    def rate(self, phase):
        """z' of all of them at a phase, or at all phases of a ball."""
        return around(self.drift - (TURN * phase).cos(), self.spread)

    def is_between(self, height):
        return height > 0 and height < self.law.gap

    def depart(self):
        """A phase until which all are on their way, and after all starts: z/x and z by Taylor's formula in x, or None."""
        x = arb(1)
        for _ in range(24):
            way = arb(x / 2, x / 2)
            # z = e w x + sin th x^2/2 + cos(th + y) x^3/6, 0 <= y <= x
            bend = (TURN * self.start + way).cos()
            by_x = self.after + way * self.sin / 2 + way**2 * bend / 6
            if by_x > 0 and way * by_x < self.law.gap:
                end = (self.start.lower() + x / TURN).lower()
                return end if end > self.start else None
            x /= 2
        return None

    def is_clear(self, end):
        """True if no wall is touched until this phase, where all are between the walls."""
        begin, step = self.depart(), arb(1) / 16
        if begin is None:
            return False
        while begin < end:
            to = begin + step
            to = end if not to < end else to.mid()
            part = begin.union(to)
            middle = part.mid()
            rate = self.rate(part)
            over = around(self.height(middle), rate * TURN * (part - middle))
            if self.is_between(over) or (rate > 0 or rate < 0) and (to is end or self.is_between(self.height(to))):
                begin, step = to, 2 * step
            else:
                step /= 2
                if step < SHORTEST:
                    return False
        return True

    def land(self, far, guess):
        """The image, if all have their first contact near the guessed phase on the wall `far` says, transversally: or None."""
        wall, sign = (self.law.gap, 1) if far else (arb(0), -1)
        guess = arb(guess)
        for _ in range(4):
            guess = (guess - (self.centre_height(guess) - wall) / (TURN * (self.drift - (TURN * guess).cos()))).mid()
        there, rate = self.height(guess) - wall, self.rate(guess)
        reach = (abs(there) / abs(TURN * rate.mid())).upper() * 5 / 4
        if not reach.is_finite():
            return None
        for _ in range(3):
            low, high = (guess - reach).mid(), (guess + reach).mid()
            bracket = low.union(high)
            rate = sign * self.rate(bracket)
            if not rate > 0:
                return None
            if sign * (self.height(high) - wall) > 0 and self.is_between(self.height(low)):
                return Image(self, far, guess, bracket, rate) if self.is_clear(low) else None
            reach = reach * 3 / 2
        return None


class Image:
    """The image of a quadrilateral: linear functions over it, by the mean value theorem in a and b."""

    def __init__(self, flights, far, guess, bracket, rate):
        sign = 1 if far else -1
        wall = flights.law.gap if far else 0
        time = guess - sign * (flights.centre_height(guess) - wall) / (TURN * rate)
        self.centre = time + (arb(1) / 2 if far else 0), sign * (flights.drift - (TURN * time).cos())
        x = TURN * (bracket - flights.start)
        self.by_time = sign * TURN * (TURN * bracket).sin()
        # By side: what changes the phase, and the speed if the phase did not change.
        self.along = [(-sign * (x * drift - shift) / (TURN * rate), sign * drift) for drift, shift in flights.slopes]

    def beside(self, origin, edge):
        """The cross product of the edge with what leads from the origin to each image: positive to the left."""
        by_phase = edge[0] * self.by_time - edge[1]
        centre = cross(edge, minus(self.centre, origin))
        return around(centre, sum(abs(by_phase * delay + edge[0] * speed) for delay, speed in self.along))

    def images(self):
        """The images of the half sides under the derivative at any of the states."""
        return [(delay, speed + self.by_time * delay) for delay, speed in self.along]
