"""The closed form of one flight: (11), (12) and its extrema, in doubles or in mpmath's numbers."""
import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from mpmath import mp, mpf

from scene import SIGN, Motion, Real, Start


class Flight(NamedTuple):
    """y [length] and y' [length/time] as functions of the time; c [length/time] is the drift of (11)."""
    height: Callable[[Real], Real]
    velocity: Callable[[Real], Real]
    drift: Real


def fly(motion: Motion[Real], start: Start[Real]) -> Flight:
    """(11), (12): y' = -A W cos(W t + tau) + c, y = -A sin(W t + tau) + c (t - t_i) + A sin(W t_i + tau) + y_i."""
    library = mp if isinstance(motion.omega, mpf) else math
    sin, cos = library.sin, library.cos
    a, w, tau, since = motion.amplitude, motion.omega, motion.tau, start.time
    theta0 = w * since + tau
    drift = start.after + a * w * cos(theta0)
    constant = a * sin(theta0) + SIGN[start.wall] * motion.gap / 2

    def height(time: Real) -> Real:
        return -a * sin(w * time + tau) + drift * (time - since) + constant

    def velocity(time: Real) -> Real:
        return -a * w * cos(w * time + tau) + drift

    return Flight(height, velocity, drift)


def extrema(motion: Motion[mpf], start: Start[mpf], until: mpf) -> Iterator[mpf]:
    """The times in (t_i, until) with y' = 0, in order: cos(W t + tau) = c/(A W), at most two per forcing period."""
    ratio = fly(motion, start).drift / (motion.amplitude * motion.omega)
    if abs(ratio) > 1:
        return
    angle, turn = mp.acos(ratio), 2 * mp.pi
    first = mp.floor((motion.omega * start.time + motion.tau) / turn)
    while True:
        for theta in (first * turn + angle, (first + 1) * turn - angle):
            time = (theta - motion.tau) / motion.omega
            if time >= until:
                return
            if time > start.time:
                yield time
        first += 1
