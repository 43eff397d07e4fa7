"""Equispaced orbits, N odd, e < 1: (64), (66)-(69), on S- or, mirrored, on S+ (72), (73).

kappa = (1 + e)/(1 - e), K = N pi kappa. A and W are free; th0 with cos th0 > 0 gives |v| and d.
"""
from mpmath import acos, atan, cos, mpf, pi, sin, sqrt, tan

from two_impact import TwoImpact, evaluate

UNITS = [("1", "pi"), ("7/3", "200*pi"), ("0.037", "1"), ("12.5", "0.3"), ("sqrt(2)", "2*pi/3")]
RESTITUTIONS = ["0", "0.05", "0.2", "0.5", "0.8", "0.95", "1/3"]
CYCLES = [1, 3, 5, 7]
ANGLES = ["0", "pi/6", "pi/3", "2*pi/5", "1.5", "0.02", "-0.02", "-pi/6", "-pi/4", "-pi/3", "-1.2", "-1.4", "-1.5"]
# Distances from the angle of grazing at which orbits are tried, on both sides.
NEAR_GRAZE = ["1e-3", "1e-8"]


def equispaced(amplitude, frequency, restitution, angle, cycles):
    """The orbit with th0 = angle, by (66) and (67); None if d <= 0."""
    A, W, e, theta0 = (evaluate(text) for text in (amplitude, frequency, restitution, angle))
    speed = 2 * A * W / (1 - e) * cos(theta0)
    gap = 2 * A * sin(theta0) + (1 + e) * cycles * pi / (2 * W) * speed
    if gap <= 0:
        return None
    texts = {
        "theta0": angle,
        "speed": f"2*({amplitude})*({frequency})/(1 - {restitution})*cos({angle})",
        "gap": f"2*({amplitude})*sin({angle})"
        f" + (1 + {restitution})/(1 - {restitution})*{cycles}*pi*({amplitude})*cos({angle})",
    }
    return TwoImpact(amplitude, frequency, restitution, theta0, cycles * pi, cycles, gap, speed, texts)


def amplitude_68(e, d, W, N, v):
    """A_N of (68), v <= 0; (69) is N = 1."""
    return sqrt(((1 - e) * v / W) ** 2 + (d + (1 + e) * N * pi * v / (2 * W)) ** 2) / 2


def kappa(e):
    return (1 + e) / (1 - e)


def grazing_angle(e):
    """th_g: for sin th0 < 0 the orbit is physical while |th0| < th_g; cos a = kappa cos th_g."""
    k = kappa(e)

    def height(theta):
        a = acos(min(mpf(1), k * cos(theta)))
        return cos(a) * (a + theta) - sin(a) - sin(theta)

    low, high = acos(1 / k), pi / 2
    if e == 0:
        return low
    for _ in range(180):
        middle = (low + high) / 2
        low, high = (middle, high) if height(middle) > 0 else (low, middle)
    return low


def is_physical(orbit):
    """By the angle of grazing alone."""
    return sin(orbit.theta0) >= 0 or -orbit.theta0 < grazing_angle(orbit.e)


def bounds_of_stability(e, N):
    """tan th0 at the pitchfork and at the fold: stable between them."""
    return -2 / (N * pi) * kappa(e), 2 / (N * pi) / kappa(e)


def is_stable(orbit):
    """By tan th0 alone."""
    lower, upper = bounds_of_stability(orbit.e, orbit.N)
    return lower < tan(orbit.theta0) < upper


def critical_amplitudes(e, N):
    """(A_pf/d, A_sn/d): the pitchfork and the fold; the first only if N pi > 2."""
    K = N * pi * kappa(e)
    pitchfork = sqrt(1 + 4 * kappa(e) ** 2 / (N * pi) ** 2) / (K * (1 - 4 / (N * pi) ** 2))
    return pitchfork, 1 / sqrt(4 + K**2)


def amplitude_over_gap(theta0, e, N):
    """A/d = 1/(2 sin th0 + K cos th0)."""
    return 1 / (2 * sin(theta0) + N * pi * kappa(e) * cos(theta0))


def grid(thin=1):
    """Orbits over (A, W, e, N, th0), both signs of sin th0, and on both sides of the angle of grazing."""
    number = 0
    for restitution in RESTITUTIONS:
        e = evaluate(restitution)
        edge = grazing_angle(e)
        angles = list(ANGLES)
        if e > 0:
            angles += [decimal(-edge - sign * mpf(step)) for step in NEAR_GRAZE for sign in (-1, 1)]
        for cycles in CYCLES:
            for angle in angles + [decimal(atan(bound) + step) for bound in bounds_of_stability(e, cycles)
                                   for step in (mpf("-0.01"), mpf("0.01"))]:
                number += 1
                if number % thin == 0 and not (e == 0 and angle == "0"):
                    orbit = equispaced(*UNITS[number % len(UNITS)], restitution, angle, cycles)
                    if orbit is not None:
                        yield orbit


def decimal(value):
    """A value as an exact decimal of 20 places."""
    units = int(mpf(value) * 10**20)
    return f"{'-' if units < 0 else ''}{abs(units)}e-20"
