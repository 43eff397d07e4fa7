"""Chatter that accumulates in a rest, proved. The release after it: `release.py`.

a(t) is the acceleration towards the wall: -z'' on the left, z'' on the right. Everything below is about a bounce that
leaves the wall at time t with the velocity u >= 0 away from it, and about a window [t, t + h] on which a lies between
two positive numbers, lo <= a <= hi; rho = sqrt(hi/lo).

Lemma R1 (one bounce). With lo s^2/2 <= u s - z(s) <= hi s^2/2 the ball is back after T, 2u/hi <= T <= 2u/lo, if
2u/lo <= h; it rises by u^2/(2 lo) at most, so that it does not reach the other wall if that is less than d. With H
the rise, lo H <= u^2/2 <= hi H on the way up and lo H <= w^2/2 <= hi H on the way down (a dz = d(z'^2)/2 in size): the
landing speed w lies between u/rho and u rho.

Lemma R2 (accumulation). The next bounce leaves with e w. If e rho < 1 and 2u/(lo (1 - e rho)) <= h then by induction
every bounce ends inside the window, the n-th leaves with between u (e/rho)^n and u (e rho)^n, and the times sum up to
a number S between 2u/(hi (1 - e/rho)) and 2u/(lo (1 - e rho)). If u > 0 and e > 0 these are infinitely many impacts on
this wall and none elsewhere. At t + S the ball lies on the wall without velocity, pressed: it rests. With u = 0 it
does so at once, be it pressed or a = 0 and a' > 0, exactly.
"""
from collections import namedtuple

from flint import arb, ctx

from flight import between
from release import pressure, pressure_slope, release_after
from scene import LEFT

# `release`: with one harmonic the ball leaves at th = W t + tau = release * pi, with several at this `Root`.
Rest = namedtuple("Rest", "wall time release")
# Windows that are tried, relative to what a constant acceleration would need.
WINDOWS = ("1.1", "1.5", "3")


def accumulation(motion, wall, time, u):
    """A ball around S of Lemma R2, for all bounces that leave in a ball of times with u in a ball; None: not proved."""
    now, e = pressure(motion, wall, time), motion.restitution
    if u == 0 and (now > 0 or now == 0 and pressure_slope(motion, wall, time) > 0):
        return arb(0)
    if not (now > 0 and u > 0 and e < 1):
        return None
    for factor in WINDOWS:
        window = (arb(factor) * 2 * u / (now * (1 - e))).abs_upper()
        a = pressure(motion, wall, between(time, time + window))
        total = sum_of_bounces(a.lower(), a.upper(), u, e, motion.gap) if a > 0 else None
        if total is not None and total <= window:
            return total
    return None


def sum_of_bounces(lo, hi, u, e, gap):
    """A ball that holds all sums of Lemma R2; None if one of its conditions, but for the window, is not met."""
    rho = (hi / lo).sqrt()
    if not (e * rho < 1 and u * u < 2 * lo * gap):
        return None
    return between(2 * u / (hi * (1 - e / rho)), 2 * u / (lo * (1 - e * rho)))


def settle_within(digits):
    """A rule for `prove`: the rest, once it is so near that no listing to these digits goes on any further.

    That is when S is an eighth of 10^-digits periods at most, and known to a millionth of these.
    """

    def settle(walk, states):
        with ctx.workprec(walk.coarse_bits):
            time, velocity = states.coarse()
            motion, unit = walk.rough, arb(10) ** -digits * walk.rough.period()
            u = motion.restitution * (-velocity if states.wall == LEFT else velocity)
            span = accumulation(motion, states.wall, time, u)
            if span is None or not (8 * span <= unit and 2 * span.rad() <= unit / 10**6):
                return None
        time = states.balls()[0] + span
        return Rest(states.wall, time, release_after(walk.fine, states.wall, time))

    return settle
