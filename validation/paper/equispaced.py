"""Section 4's equispaced orbits: fold and pitchfork, never a doubling, and where the near wall is grazed first."""
import random

from flint import arb, arb_mat

from closed import Equispaced
from finding import FALSE, PROVED, Finding, excludes, expect, tiny
from periodic import Orbit, Refused, prove


def half_map(family, th0):
    """DP of one flight and the mirror image y -> -y, th -> th - N pi (R2 of docs/proofs/reduction.md), which fix the orbit."""
    (_, th0, v0), (_, th1, v1) = family.states(th0)
    return arb_mat([[1, 0], [0, -1]]) * family.pair(th0).jacobian(th0, v0, th1, v1)


def random_families():
    """60 families and phases, seeded."""
    chance = random.Random(1995)
    for _ in range(60):
        yield Equispaced(arb(chance.uniform(0, 0.99)), chance.choice((1, 3, 5))), arb(chance.uniform(-1.5, 1.5))


def half_traces():
    """The half map's trace is 2e + (1 - e^2)(N pi/2) tan th0 and its determinant e^2, by (A.7) at random orbits."""
    for family, th0 in random_families():
        jacobian = half_map(family, th0)
        tiny(jacobian.trace() - family.half_trace(th0), "half map's trace")
        tiny(jacobian.det() - family.e ** 2, "half map's determinant")
    return Finding("half map: trace 2e + (1 - e^2)(N pi/2) tan th0, determinant e^2", PROVED,
                   "60 random orbits, (A.7) in balls: equal to 20 digits")


def edges():
    """Fold and pitchfork for e = 0.8, N = 1: (40) holds there, and stability ends there."""
    family, near = Equispaced("0.8"), arb(2) ** -40
    rows = []
    ends = (("fold", family.fold_phase(), family.fold(), -1),
            ("symmetry-breaking pitchfork", family.pitchfork_phase(), family.pitchfork(), 1))
    for name, phase, amplitude, inside in ends:
        tiny(1 / family.gap(phase) - amplitude, f"A/d of the {name}")
        whole = Orbit(family.pair(phase), 1, family.states(phase)).jacobian()
        tiny(whole.trace() - 1 - whole.det(), f"(40) at the {name}")
        for side, stable in ((inside * near, True), (-inside * near, False)):
            th0 = phase + side
            orbit = prove(family.pair(th0), family.states(th0), 1, near / 1024)
            expect(orbit.stable() == stable, f"stability at the {name}")
        rows.append(Finding(f"{name} of the equispaced orbit, e = 0.8, N = 1", PROVED,
                            f"A/d = {amplitude.str(12)}; (40) holds; stable on one side, unstable on the other"))
    return rows


def least_height(a):
    """The height above the near wall of the minimum at phase a, over cos a, at the pitchfork, N = 1; it falls in a.

    There sin th = (2/pi) cos a, th = |th0|, and kappa = cos a/cos th falls in a too (docs/paper.md).
    """
    return a + (2 / arb.pi() * a.cos()).asin() - 2 / arb.pi() - a.tan()


def is_physical(family, th0):
    """True if its flights are proved to have no earlier contact."""
    try:
        Orbit(family.pair(th0), family.cycles, family.states(th0)).require_first_contacts()
    except Refused:
        return False
    return True


def graze_sign(family, th0):
    """G of docs/paper.md for th0 < 0, N = 1: positive where the near wall is missed; None where there is no minimum."""
    cosine = family.kappa * th0.cos()
    if cosine > 1:
        return None
    a = cosine.acos()
    return cosine * (a - th0) - a.sin() + th0.sin()


def physical():
    """sin th0 >= 0: no earlier contact ever; sin th0 < 0, N = 1: none exactly while G > 0."""
    above = below = 0
    for family, th0 in random_families():
        if th0 > 0:
            above += 1
            expect(is_physical(family, th0), "sin th0 > 0")
        elif family.cycles == 1 and family.gap(th0) > 0:
            below += 1
            sign = graze_sign(family, th0)
            expect(is_physical(family, th0) == (sign is None or sign > 0), "sin th0 < 0")
    return Finding("equispaced orbits have no earlier contact: always for sin th0 >= 0, else while |th0| < th_g(e)",
                   PROVED, f"agrees with the first contacts proved at {above} and {below} random orbits")


def near_wall():
    """e* = 0.0867: for e < e* the near wall is grazed before the pitchfork is reached (N = 1)."""
    low, high = arb(0), (2 / arb.pi()).atan().lower()
    expect(least_height(low) > 0 > least_height(high), "the sign changes")
    for _ in range(60):
        middle = ((low + high) / 2).mid()
        low, high = (middle, high) if least_height(middle) > 0 else (low, middle)
    expect(least_height(low) > 0 > least_height(high), "the sign changes in the bracket")
    a = low.union(high)
    kappa = a.cos() / (1 - (2 / arb.pi() * a.cos()) ** 2).sqrt()
    e = (kappa - 1) / (kappa + 1)
    expect(abs(e - arb("0.0867")) < 5e-5, f"e* = {e.str(10)}")
    for value, expected in (("0.05", False), ("0.0866", False), ("0.0868", True), ("0.3", True)):
        family = Equispaced(value)
        th0 = family.pitchfork_phase() + arb(2) ** -30
        expect(is_physical(family, th0) == expected, f"at the pitchfork, e = {value}")
    return Finding("a graze of the near wall comes before the pitchfork for e < e*", PROVED, f"e* = {e.str(12)}")


def doubling():
    """(39) never holds: tr + det + 1 = (half trace)^2 + (1 - e^2)^2."""
    for family, th0 in random_families():
        whole = Orbit(family.pair(th0), family.cycles, family.states(th0)).jacobian()
        value = whole.trace() + whole.det() + 1
        tiny(value - family.half_trace(th0) ** 2 - (1 - family.e ** 2) ** 2, "tr + det + 1")
        excludes(value, "(39)")
    return Finding("section 4: equispaced solutions experience a period-doubling", FALSE,
                   "tr + det + 1 = (half trace)^2 + (1 - e^2)^2 > 0, checked at 60 random orbits")


CLAIMS = {"equispaced": lambda quick: [half_traces(), *edges(), doubling()],
          "near-wall": lambda quick: [physical(), near_wall()]}
