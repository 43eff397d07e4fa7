"""Two impacts per N cycles, (56)-(63), in normal form: from the left wall at phase th0, on the right one at th1.

Lengths and times are in the units of the scene, phases th = W t + tau in radians, all in mpmath with DIGITS digits.
An orbit is given by theory here, and as the exact expressions of a scene file for the program.
"""
import re
from collections import namedtuple

from mpmath import acos, cos, mp, mpf, pi, sin

DIGITS = 50
mp.dps = DIGITS
# Relative uncertainty of numbers of 50 digits.
TINY = mpf(10) ** (6 - DIGITS)

# A contact before the impact that the closed form says: on the `near` or `far` wall, or "rest" at once; at the phase s
# after the departure.
Earlier = namedtuple("Earlier", "flight wall phase")
Impact = namedtuple("Impact", "is_far time velocity")


class TwoImpact:
    """A, W, e, d; th0, th1 - th0 = first, N; speed |v| before each impact (61). `texts`: tau, gap and velocity."""

    def __init__(self, amplitude, frequency, restitution, theta0, first, cycles, gap, speed, texts):
        self.texts = {"amplitude": amplitude, "frequency": frequency, "restitution": restitution, **texts}
        self.A, self.W, self.e = (evaluate(text) for text in (amplitude, frequency, restitution))
        self.theta0, self.first, self.N, self.d, self.speed = theta0, first, cycles, gap, speed

    def impacts(self, count):
        """So many impacts after the start, which is at time 0."""
        period, crossing = 2 * self.N * pi / self.W, self.first / self.W
        for index in range(1, count + 1):
            if index % 2 == 1:
                yield Impact(True, (index // 2) * period + crossing, self.speed)
            else:
                yield Impact(False, (index // 2) * period, -self.speed)

    def flights(self):
        """(phase at the departure, length in phase) of both flights, each given as one from the left wall."""
        return [(self.theta0, self.first), (self.theta0 + self.first + pi, 2 * self.N * pi - self.first)]

    def residuals(self):
        """Residuals of (A.1)-(A.4) on both flights, in units of A W and A: zero for an orbit."""
        for theta, length in self.flights():
            k = self.drift(theta)
            yield k - cos(theta + length) - self.speed / (self.A * self.W)
            yield self.height(theta, length) - self.d / self.A

    def drift(self, theta):
        """c/(A W), c = -e v + A W cos th0, of the flight that leaves at this phase."""
        return self.e * self.speed / (self.A * self.W) + cos(theta)

    def height(self, theta, s):
        """(y + d/2)/A at the phase s after the departure, (12)."""
        return self.drift(theta) * s - sin(theta + s) + sin(theta)

    def earlier(self):
        """The first contact before the impacts of the closed form, or None: the orbit is then physical.

        Between them y is monotone from one extremum to the next, cos th = c/(A W); so the extrema decide.
        """
        for flight, (theta, length) in enumerate(self.flights()):
            if self.e * self.speed == 0 and sin(theta) < 0:
                return Earlier(flight, "rest", mpf(0))
            last = mpf(0)
            for s in self.extrema(theta, length):
                z = self.height(theta, s)
                if z < 0 or z > self.d / self.A:
                    level = 0 if z < 0 else self.d / self.A
                    return Earlier(flight, "near" if z < 0 else "far", self.crossing(theta, last, s, level))
                last = s
        return None

    def extrema(self, theta, length):
        """Phases s in (0, length) after the departure where y' = 0, in order."""
        k = self.drift(theta)
        if abs(k) >= 1:
            return []
        around = [sign * acos(k) + 2 * pi * turn - theta for sign in (-1, 1) for turn in range(-2, 2 * self.N + 3)]
        return sorted(s for s in around if TINY < s < length - TINY)

    def crossing(self, theta, low, high, level):
        """The place at which the height passes a level, by bisection; it is monotone between the two phases."""
        is_above = self.height(theta, high) > level
        for _ in range(4 * DIGITS):
            middle = (low + high) / 2
            if (self.height(theta, middle) > level) == is_above:
                high = middle
            else:
                low = middle
        return (low + high) / 2

    def margin(self):
        """Least distance of the extrema from the walls, in units of the gap; negative if one is beyond."""
        share = self.A / self.d
        heights = [self.height(theta, s) * share for theta, n in self.flights() for s in self.extrema(theta, n)]
        return min([mpf(1), *heights, *(1 - height for height in heights)])


def evaluate(text):
    """The value of an expression of a scene file: decimals, + - * / ^ ( ), pi, sqrt, sin, cos."""
    names = {"pi": pi, "sqrt": mp.sqrt, "sin": sin, "cos": cos, "mpf": mpf, "__builtins__": {}}
    return +mpf(eval(quoted(text), names))  # Only our own expressions come here.


def quoted(text):
    """The expression with its decimals as exact as mpmath can have them."""
    return re.sub(r"(?<![\w.])(\d+\.?\d*(?:e[-+]?\d+)?)", r"mpf('\1')", text).replace("^", "**")
