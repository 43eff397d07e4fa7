"""Chatter that accumulates in a rest, and the release after it, proved. One harmonic.

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

Lemma R3 (release). A ball at rest stays as long as a >= 0 and leaves where a turns negative. With th = W t + tau, a is
A W^2 times -sin th on the left and sin th on the right, so that happens where th/pi passes an even integer (left) or
an odd one (right). Then u = 0, z'' = 0 and z''' is inward: the flight begins as in `Flight.departure`.
"""
from collections import namedtuple

from flint import arb, ctx

from flight import Undecided, between
from scene import LEFT, Motion

# `release` counts half turns: the ball leaves at th = W t + tau = release * pi.
Rest = namedtuple("Rest", "wall time release")
# Windows that are tried, relative to what a constant acceleration would need.
WINDOWS = ("1.1", "1.5", "3")


def pressure(motion, wall, time):
    """a at a time, or over a ball of times."""
    e2 = motion.excitation(time)[2]
    return e2 if wall == LEFT else -e2


def pressure_grows(motion, wall, time):
    """a' > 0 at a time."""
    third = motion.third(time)
    return third > 0 if wall == LEFT else third < 0


def accumulation(motion, wall, time, u):
    """A ball around S of Lemma R2, for all bounces that leave in a ball of times with u in a ball; None: not proved."""
    now, e = pressure(motion, wall, time), motion.restitution
    if u == 0 and (now > 0 or now == 0 and pressure_grows(motion, wall, time)):
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


def half_turns_at(motion, time):
    """th/pi at a time, for the one harmonic there must be; a negative amplitude is half a turn."""
    if len(motion.terms) != 1:
        raise Undecided("a rest under several harmonics")
    ((amplitude, frequency, phase),) = motion.terms
    turned = 1 if amplitude < 0 else 0
    return (frequency * time + phase) / arb.pi() + turned


def release_after(motion, wall, time):
    """The half turns at the release of a ball that rests at a time: Lemma R3."""
    parity = 0 if wall == LEFT else 1
    turns = (half_turns_at(motion, time) - parity) / 2
    whole = turns.floor().unique_fmpz()
    if whole is None or not turns - int(whole) >= arb("0.5"):
        raise Undecided("the ball may not be pressed where it comes to rest")
    return 2 * (int(whole) + 1) + parity


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


class Released:
    """The scene after a release from a wall: it leaves at time 0, exactly, at the phase 0 (left) or pi (right)."""

    def __init__(self, scene, wall):
        self.scene, self.wall = scene, wall

    def motion(self):
        motion = self.scene.motion()
        ((amplitude, frequency, _),) = motion.terms
        sign = 1 if self.wall == LEFT else -1
        return Motion([(sign * abs(amplitude), frequency, arb(0))], motion.gap, motion.restitution)

    def start(self):
        return self.wall, arb(0), arb(0) if self.wall == LEFT else self.scene.motion().gap, arb(0)
