"""Figures 10 and 11: the curves A_N of (68)-(73), and what is read from them."""
from flint import arb

from closed import Equispaced
from finding import FALSE, PROVED, Finding, expect, tiny
from periodic import prove
from equispaced import random_families


def amplitude(d, e, v, frequency, cycles=1):
    """A_N of (73)."""
    turn = cycles * arb.pi() / frequency
    return (((1 - e) * v / frequency) ** 2 + (d - (1 + e) * turn * abs(v) / 2) ** 2).sqrt() / 2


def formula():
    """(73) in the units A = W = 1 gives 1 at random equispaced orbits."""
    for family, th0 in random_families():
        v = family.states(th0)[0][2]
        tiny(amplitude(family.gap(th0), family.e, v, arb(1), family.cycles) - 1, "(73)")
    return Finding("(68), (72), (73)", PROVED, "A_N/A - 1 is 0 to 20 digits at 60 random equispaced orbits")


def asymptotes():
    """A_N tends to d/2 for W -> infinity at a fixed v, e = 0.8, d = 20, v = -20."""
    d, e, v = arb(20), arb("0.8"), arb(-20)
    shown = []
    for cycles in (1, 2, 3):
        value = amplitude(d, e, v, arb(10) ** 30, cycles)
        expect(abs(value - d / 2) < 1e-25, "A_N at W = 1e30")
        shown.append(f"N = {cycles}: |A_N - d/2| = {abs(value - d / 2).str(3, radius=False)}")
    return Finding("A_N tends to d/2 for W to infinity, v fixed", PROVED, "W = 1e30: " + ", ".join(shown))


def two_impacts():
    """e = 0.8, d = 20, W = 4: A_1 of v = -20 lies between amplitudes that all have two stable impacts per cycle."""
    special, family = amplitude(arb(20), arb("0.8"), arb(-20), arb(4)), Equispaced("0.8")
    shown = []
    for a in ("1.5", "2.5", "3.5", "5.5"):
        gap = 20 / arb(a)
        th0 = family.phase(gap)
        orbit = prove(family.pair(th0), family.states(th0), 1)
        expect(orbit.stable(), f"A = {a}")
        shown.append(f"A = {a}: v = {(orbit.states[0][2] * arb(a) * 4).str(5, radius=False)}")
    expect(2.5 < special < 3.5, "A_1")
    return Finding("exactly two impacts per cycle only if A = A_1", FALSE,
                   f"e = 0.8, d = 20, W = 4, A_1(v = -20) = {special.str(6)}; stable, two impacts per cycle: "
                   + "; ".join(shown))


def stable_part():
    """The stable parts of the curves, e = 0.8, d = 20: figure 10, v = -20, in W; figure 11, W = 30, N = 1, in |v|.

    With (66), (67): tan th0 = (d W - (1 + e) N pi |v|/2)/((1 - e)|v|).
    """
    d, e, near = arb(20), arb("0.8"), arb(2) ** -20
    shown = []
    for cycles in (1, 3, 5):
        family = Equispaced("0.8", cycles)
        ends = family.pitchfork_phase(), family.fold_phase()
        frequencies = [(1 + e) * family.turn / 2 + (1 - e) * th0.tan() for th0 in ends]
        for end, inward in zip(ends, (near, -near)):
            for th0, stable in ((end + inward, True), (end - inward, False)):
                orbit = prove(family.pair(th0), family.states(th0), cycles, near ** 3)
                expect(orbit.stable() == stable, f"N = {cycles} at th0 = {th0.str(5)}")
        solid = (1 + e) * family.turn / 2
        shown.append(f"figure 10, N = {cycles}: W from {frequencies[0].str(6, radius=False)} to "
                     f"{frequencies[1].str(6, radius=False)}, solid from {solid.str(6, radius=False)} on")
    family = Equispaced("0.8")
    speeds = [30 * d / ((1 + e) * family.turn / 2 + (1 - e) * th0.tan())
              for th0 in (family.fold_phase(), family.pitchfork_phase())]
    shown.append(f"figure 11, N = 1: |v| from {speeds[0].str(6, radius=False)} to {speeds[1].str(6, radius=False)}")
    return Finding("most of the curves of figures 10 and 11 are unstable orbits", PROVED,
                   "stable are " + "; ".join(shown))


CLAIMS = {"figure-10": lambda quick: [formula(), asymptotes(), two_impacts(), stable_part()]}
