"""Unequispaced orbits, e < 1, N odd and even: t_{i+1} from (63) with (62), by mpmath; then d from (58).

In units of A W and A, p = th1 - th0: |v| = (cos th0 - cos th1)/(1 - e), and (63) says c p + c' (2 N pi - p) = 0 with
c = e |v| + cos th0, c' = -e |v| + cos th1. The roots p = N pi are the equispaced ones and are left out.
"""
import math

from mpmath import cos, findroot, mpf, nstr, pi, sin

from two_impact import DIGITS, TINY, TwoImpact, evaluate

RESTITUTIONS = ["0.1", "0.3", "0.5", "0.7", "0.9"]
ANGLES = ["-1.9", "-1.3", "-0.9", "-0.5", "-0.2", "0.3", "0.8", "1.4", "2.1"]
CYCLES = [1, 2, 3, 4]
# Points of a cycle at which a sign change of (63) is looked for.
POINTS = 60


def speed(e, theta0, p):
    """|v|/(A W) from (62)."""
    return (cos(theta0) - cos(theta0 + p)) / (1 - e)


def rest_of_63(e, theta0, p, cycles, cosine=cos):
    """The left side of (63)."""
    here, there = cosine(theta0), cosine(theta0 + p)
    v = e * (here - there) / (1 - e)
    return (v + here) * p + (there - v) * (2 * cycles * pi - p)


def lengths(e, theta0, cycles):
    """All p in (0, 2 N pi) with a change of sign, but for p = N pi; seen in doubles, found in 50 digits."""
    count = POINTS * cycles
    places = [2 * cycles * math.pi * (k + 0.37) / (count + 1) for k in range(count + 1)]
    seen = [rest_of_63(float(e), float(theta0), p, cycles, math.cos) > 0 for p in places]
    for k in range(count):
        if seen[k] != seen[k + 1]:
            p = findroot(
                lambda p: rest_of_63(e, theta0, p, cycles), places[k : k + 2],
                solver="anderson", tol=mpf(10) ** (-2 * DIGITS + 8), maxsteps=200,
            )
            if abs(p - cycles * pi) > mpf("1e-9"):
                yield p


def decimal_interval(value):
    """An interval of 45 digits with the value inside."""
    low, high = (nstr(value + sign * abs(value) * mpf(10) ** -44, 46) for sign in (-1, 1))
    return f"[{low}, {high}]"


def unequispaced(restitution, angle, cycles):
    """The orbits with th0 = angle, A = 1 and W = 2; |v| and d are given to the program as intervals."""
    e, theta0, W = evaluate(restitution), evaluate(angle), mpf(2)
    for p in lengths(e, theta0, cycles):
        v = speed(e, theta0, p)
        gap = (e * v + cos(theta0)) * p - sin(theta0 + p) + sin(theta0)
        if v > TINY and gap > TINY:
            texts = {"theta0": angle, "speed": decimal_interval(v * W), "gap": decimal_interval(gap)}
            yield TwoImpact("1", "2", restitution, theta0, p, cycles, gap, v * W, texts)


def unequispaced_orbits(thin=1):
    """Orbits over e, th0 and N."""
    number = 0
    for restitution in RESTITUTIONS:
        for angle in ANGLES:
            for cycles in CYCLES:
                number += 1
                if number % thin == 0:
                    yield from unequispaced(restitution, angle, cycles)
