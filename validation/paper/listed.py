"""The stable orbits that answer claims: parameters and a rounded first state, from which each one is proved.

Units of pair.py; a/d is A/d. Nothing rests on the rounded states: they are seeds of Krawczyk's operator.
"""
from collections import namedtuple

from finding import PROVED, Finding, expect
from pair import LEFT, RIGHT, Pair, ball
from periodic import find

Seed = namedtuple("Seed", "ratio e wall th v impacts cycles word")

ORBITS = {
    "equispaced, A = 0.51 d": Seed("0.51", "0.15", LEFT, "-0.6971", "-1.8036", 2, 1, "P1 P2"),
    "five impacts on each side, A = 7.5 d": Seed("7.5", "0.8", RIGHT, "0.7866", "0.3438", 10, 1,
                                                 "P2 P4 P4 P4 P4 P1 P3 P3 P3 P3"),
    "N = 2": Seed("1/10.82", "0.5", LEFT, "-0.2558", "-2.2665", 2, 2, "P1 P2"),
    "N = 4": Seed("1/14.21", "0.5", LEFT, "-0.1272", "-1.8834", 2, 4, "P1 P2"),
    "model III, RRLL": Seed("1/0.619", "0.8", RIGHT, "1.0077", "0.7399", 4, 1, "P2 P4 P1 P3"),
    "LLR": Seed("0.498", "0.8", LEFT, "4.0430", "-1.0915", 3, 1, "P1 P2 P4"),
    "period three": Seed("1/2.236", "0.8", LEFT, "5.3149", "-1.6035", 6, 3, "P1 P2 P1 P2 P1 P2"),
    "unequispaced, A = 0.36 d": Seed("0.36", "0.8", LEFT, "5.1393", "-1.7003", 2, 1, "P1 P2"),
    "unequispaced, A = 0.46 d": Seed("0.46", "0.8", LEFT, "4.2651", "-1.5927", 2, 1, "P1 P2"),
    "doubled, A = 0.468 d": Seed("0.468", "0.8", LEFT, "5.4898", "-1.5509", 4, 2, "P1 P2 P1 P2"),
}


def listed(name):
    """The orbit of that name, proved and stable."""
    seed = ORBITS[name]
    orbit = find(Pair(1 / ball(seed.ratio), seed.e), seed.wall, seed.th, seed.v, seed.impacts, seed.cycles)
    expect(orbit.word() == seed.word, f"{name}: the word {orbit.word()}")
    expect(orbit.stable(), f"{name}: stability")
    return orbit


def finding(name, statement, verdict=PROVED):
    """The finding that a listed orbit answers a statement with."""
    orbit, seed = listed(name), ORBITS[name]
    _, th, v = orbit.states[0]
    cycles = f"{orbit.cycles} cycle{'s' if orbit.cycles > 1 else ''}"
    return Finding(statement, verdict, f"stable orbit {orbit.word()} in {cycles}, A/d = {seed.ratio}, "
                   f"e = {seed.e}: eigenvalues {orbit.shown()}; "
                   f"th = {th.str(10)}, v/(A W) = {v.str(10)}")
