"""Orbits with e = 1: (70), (71), and equispaced ones with N even.

On S-, from (57)-(60): cos th1 = cos th0, c = |v| + A W cos th0, d = -A (sin th1 - sin th0) + c (t1 - t0), and (63) is
W (t1 - t0) = N pi (1 - A W cos th0/|v|). Equispaced means cos th0 = 0; then any |v| is good: d = +-2 A + N pi |v|/W for
N odd, d = N pi |v|/W for N even.
"""
from mpmath import cos, pi, sin

from two_impact import TwoImpact, evaluate

SPEEDS = ["0.1", "0.6", "1", "2.5", "7", "40"]
UNITS = [("1", "pi"), ("0.25", "3"), ("6", "50*pi")]


def elastic_equispaced(amplitude, frequency, share, sign, cycles):
    """th0 = +-pi/2, |v| = share A W: (71) for N odd; None if d <= 0."""
    A, W, speed = (evaluate(text) for text in (amplitude, frequency, f"{share}*({amplitude})*({frequency})"))
    jump = f"{sign}2*({amplitude})" if cycles % 2 else "0"
    gap = evaluate(jump) + cycles * pi * speed / W
    if gap <= 0:
        return None
    texts = {
        "theta0": f"{sign}pi/2",
        "speed": f"{share}*({amplitude})*({frequency})",
        "gap": f"{jump} + {cycles}*pi*{share}*({amplitude})",
    }
    return TwoImpact(amplitude, frequency, "1", evaluate(f"{sign}pi/2"), cycles * pi, cycles, gap, speed, texts)


def elastic(amplitude, frequency, angle, turns, cycles):
    """th1 = -th0 + 2 pi turns, not equispaced; None if |v| or d would not be positive."""
    A, W, theta0 = (evaluate(text) for text in (amplitude, frequency, angle))
    first, scale = f"(2*pi*{turns} - 2*({angle}))", f"({amplitude})*({frequency})"
    length = evaluate(first)
    if not 0 < length < 2 * cycles * pi or length == cycles * pi or cos(theta0) == 0:
        return None
    speed = f"{scale}*cos({angle})*{cycles}*pi/({cycles}*pi - {first})"
    v = evaluate(speed)
    gap = 2 * A * sin(theta0) + (v + A * W * cos(theta0)) * length / W
    if not (v > 0 and gap > 0):
        return None
    texts = {
        "theta0": angle,
        "speed": speed,
        "gap": f"2*({amplitude})*sin({angle}) + ({speed} + {scale}*cos({angle}))*{first}/({frequency})",
    }
    return TwoImpact(amplitude, frequency, "1", theta0, length, cycles, gap, v, texts)


def elastic_orbits():
    """(equispaced with N odd, equispaced with N even, not equispaced)."""
    odd, even, other = [], [], []
    for amplitude, frequency in UNITS:
        for cycles in (1, 2, 3, 4, 5):
            for sign in ("", "-"):
                for share in SPEEDS:
                    (odd if cycles % 2 else even).append(elastic_equispaced(amplitude, frequency, share, sign, cycles))
            for angle in ("pi/5", "-pi/5", "1.2", "-1.2", "2*pi/3", "-0.1", "3"):
                for turns in range(0, 2 * cycles + 1):
                    other.append(elastic(amplitude, frequency, angle, turns, cycles))
    return tuple([orbit for orbit in orbits if orbit is not None] for orbits in (odd, even, other))
