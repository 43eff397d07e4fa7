"""One flight between two impacts, for all states in a ball at once: the first contact, proved.

Everything is a function of s, the time since the departure, and of the height z = y + d/2 above the left wall, so
the walls are z = 0 and z = d. From (11), (12): z(s) = z(0) + c s - E(t0 + s) + E(t0), z'(s) = c - E'(t0 + s),
z''(s) = -E''(t0 + s), where c = u + E'(t0) and u is the velocity after the last impact.
"""
from flint import arb, ctx

from scene import LEFT, RIGHT

CLEAR = "clear"
# Longest flight that is followed, in periods, and the greatest number of its parts.
LONGEST, MOST_PARTS = 10**12, 40_000


class Undecided(Exception):
    """Nothing could be proved at this precision."""


class TooLong(Undecided):
    """No contact as far as the flight was followed: more bits are no help."""


def shortest(period):
    """A part of a flight shorter than this is not cut again: at 128 bits, 2^-80 of a period."""
    return period * arb(2) ** -(5 * ctx.prec // 8)


def between(a, b):
    """A ball that holds [a, b]."""
    return a.union(b)


def narrow(value, slope, bracket, enough=0):
    """The bracket of a root, narrowed by interval Newton for as long as that helps and it is wider than enough.

    By the mean value theorem m - f(m)/f'(S) holds every root that S holds. As f' has one sign on S, it lies on one
    side of m, so each round halves the bracket at least, until f(m) is lost in its own radius.
    """
    while True:
        middle = bracket.mid()
        narrower = bracket.intersection(middle - value(middle) / slope(bracket))
        if not 3 * narrower.rad() < 2 * bracket.rad() or narrower.rad() <= enough:
            return narrower
        bracket = narrower


class Flight:
    """All flights that leave `wall` (None: the inside of the gap) from states in the balls t0, z0, u.

    `released`: only the one is meant that leaves at the release in the ball t0, where u = 0 and z'' = 0.
    """

    def __init__(self, motion, wall, t0, z0, u, released=False):
        self.motion, self.wall, self.t0, self.z0, self.u, self.released = motion, wall, t0, z0, u, released
        self.e0, e1, self.e2 = motion.excitation(t0)
        self.c = u + e1

    def height(self, s):
        """z(s), from (12)."""
        return self.z0 + self.c * s - (self.motion.excitation(self.t0 + s)[0] - self.e0)

    def velocity(self, s):
        """z'(s), from (11)."""
        return self.c - self.motion.excitation(self.t0 + s)[1]

    def derivatives(self, s):
        """z(s), z'(s), z''(s), from (12), (11), (10)."""
        e0, e1, e2 = self.motion.excitation(self.t0 + s)
        return self.z0 + self.c * s - (e0 - self.e0), self.c - e1, -e2

    def level(self, wall):
        """The height of a wall."""
        return arb(0) if wall == LEFT else self.motion.gap

    def first_contact(self, periods=LONGEST):
        """(wall, S): each flight of the set touches this wall first, once in the bracket S, and z' != 0 on S.

        The flight is cut into parts from left to right; a part is discarded, holds the contact, or is halved.
        """
        period = self.motion.period()
        a, width = self.departure(period.mid() / 8)
        for _ in range(MOST_PARTS):
            if not a < periods * period:
                raise TooLong(f"no contact in {periods} periods")
            b = (a + width).mid()
            verdict = self.judge(a, b)
            if verdict == CLEAR:
                a, width = b, 2 * width
            elif verdict is not None:
                return verdict, self.contract(verdict, a, b)
            elif width < shortest(period):
                raise Undecided(f"near s = {a.str(10)}: a graze, or too little precision")
            else:
                width = width / 2
        raise TooLong(f"no contact in {MOST_PARTS} parts, {(a / period).str(5)} periods")

    def departure(self, width):
        """(b, w): no contact is in (0, b], since (z(s) - z(0))/s = u + z''/2 s keeps its sign there; w to go on with.

        The root s = 0 is divided out: this is the Taylor form of z at the wall, with z'' over [0, b]. At a release it
        is divided out three times: u = 0 and z''(0) = 0, so z(s) - z(0) = z'''/6 s^3 with z''' somewhere on (0, s).
        That is so for one of the flights from a ball of release times, so that for the others the end decides.
        """
        if self.wall is None:
            return arb(0), width
        inward = 1 if self.wall == LEFT else -1
        u = inward * self.u
        if not u >= 0:
            raise Undecided("the velocity after the impact may be outward")
        while width > shortest(self.motion.period()):
            part = between(arb(0), width)
            z2 = inward * self.derivatives(part)[2]
            slope = u + z2 * part / 2
            leaves = slope > 0 or z2 > 0 or self.is_release() and inward * self.third(part) > 0
            inside = not self.released or 0 < self.height(width) < self.motion.gap
            if leaves and inside and slope * part < self.motion.gap:
                return width, width
            width = width / 2
        raise Undecided("the ball does not leave the wall")

    def is_release(self):
        """True if u and z''(0) are 0, exactly: by the balls, or known of one flight of the set."""
        return self.released or self.wall is not None and self.u == 0 and self.e2 == 0

    def third(self, s):
        """z'''(s)."""
        return -self.motion.third(self.t0 + s)

    def judge(self, a, b):
        """CLEAR, the wall of the only contact in (a, b], or None, given that z(a) is inside the gap.

        Mean value and Taylor form on the part, or, where z' has a proved sign, the height at its end. On parts of more
        than a period, where E takes all its values, (12) as it stands; with several harmonics that of the fastest may
        take all of them, and the sum of the others not.
        """
        part, gap = between(a, b), self.motion.gap
        if b - a > self.motion.period() and 0 < self.height(part) < gap:
            return CLEAR
        if b - a > self.motion.longest():
            return None
        _, z1, z2 = self.derivatives(part)
        if z1 > 0 or z1 < 0:
            end = self.height(b)
            if 0 < end < gap:
                return CLEAR
            return RIGHT if z1 > 0 and end > gap else LEFT if z1 < 0 and end < 0 else None
        middle = part.mid()
        height, velocity, _ = self.derivatives(middle)
        x = part - middle
        mean, taylor = height + z1 * x, height + velocity * x + z2 * x * x / 2
        inside = (mean > 0 or taylor > 0) and (mean < gap or taylor < gap)
        return CLEAR if inside else None

    def contract(self, wall, a, b):
        """The bracket [a, b] of one contact, narrowed."""
        level = self.level(wall)
        return narrow(lambda s: self.height(s) - level, self.velocity, between(a, b))

    def land(self, wall, bracket):
        """(t1, v1), balls around the contact of these flights, which is the only one in the bracket.

        m - z(m)/z'(S) holds s for every m in S (mean value theorem); m is found by Newton's plain iteration.
        """
        level, m = self.level(wall), bracket.mid()
        for _ in range(60):
            z, z1, _ = self.derivatives(m)
            step = ((z - level) / z1).mid()
            m = (m - step).mid()
            if abs(step) <= 4 * (z.rad() / abs(z1)).abs_upper():
                break
        if not bracket.contains(m):
            raise Undecided("Newton's iteration left the bracket")
        s = m - (self.height(m) - level) / self.velocity(bracket)
        return self.t0 + s, self.velocity(s)

    def jacobian(self, s):
        """d(t1, v1)/d(t0, v0), eq. (A.7), over all states of the set and all contacts s; v0 is the velocity before."""
        _, v1, e2 = self.derivatives(s)
        restitution = self.motion.restitution
        dt_dt, dt_dv = (self.u - self.e2 * s) / v1, restitution * s / v1
        return [[dt_dt, dt_dv], [e2 * dt_dt + self.e2, e2 * dt_dv - restitution]]
