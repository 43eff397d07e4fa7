"""Figures 10 and 11: A_N from (68) for given v, each point an orbit with (66), (67); (72), (73) for the right wall."""
from mpmath import atan2, mpf, pi

from equispaced import amplitude_68
from two_impact import TINY, TwoImpact, evaluate
from unequispaced import decimal_interval

RESTITUTION, GAP, SPEED = "0.8", "20", "20"
# Figure 10: A over W with v = -20; figure 11: A over v with W = 30.
FREQUENCIES = ["0.5", "1", "2", "4", "8", "12", "16", "24", "30", "40"]
SPEEDS = ["0.5", "2", "5", "10", "20", "40", "80", "160", "250"]
CYCLES = [1, 3, 5, 7, 9]


def point(frequency, speed, cycles):
    """The orbit of one point; A is an exact root, th0 an interval of 45 digits, on both sides of sin th0 = 0."""
    e, d, W, v = (evaluate(text) for text in (RESTITUTION, GAP, frequency, speed))
    # cos th0 and sin th0 times 2 A, from (66) and (67).
    cosine, sine = (1 - e) * v / W, d - (1 + e) * cycles * pi * v / (2 * W)
    theta0 = atan2(sine, cosine)
    root = f"sqrt((0.2*{speed}/{frequency})^2 + ({GAP} - 0.9*{cycles}*pi*{speed}/{frequency})^2)/2"
    texts = {"theta0": decimal_interval(theta0), "speed": speed, "gap": GAP}
    return TwoImpact(root, frequency, RESTITUTION, theta0, cycles * pi, cycles, d, v, texts)


def points():
    """All points; the solid curves have sin th0 >= 0, the dashed ones sin th0 < 0."""
    tens = [(frequency, SPEED, cycles) for frequency in FREQUENCIES for cycles in CYCLES]
    elevens = [("30", speed, cycles) for speed in SPEEDS for cycles in CYCLES]
    return [point(*values) for values in tens + elevens]


def forms_agree(orbit):
    """(68), (72) with v > 0 and (73) give the A of the orbit."""
    e, d, W, N, v = orbit.e, orbit.d, orbit.W, orbit.N, orbit.speed
    on_right = (((1 - e) * v / W) ** 2 + (-d + (1 + e) * N * pi * v / (2 * W)) ** 2) ** mpf("0.5") / 2
    both = (((1 - e) * v / W) ** 2 + (d - (1 + e) * N * pi * abs(v) / (2 * W)) ** 2) ** mpf("0.5") / 2
    return all(abs(form - orbit.A) < TINY * orbit.A for form in (amplitude_68(e, d, W, N, -v), on_right, both))
