"""Section 4 on even N: no equispaced orbit for e < 1, but unequispaced ones, and equispaced ones for e = 1."""
from flint import arb

from finding import FALSE, PROVED, Finding, excludes, tiny
from listed import finding, listed
from pair import LEFT, RIGHT, Pair
from periodic import Orbit


def equispaced():
    """e < 1: (62) gives v = 0, and then (58) says d and (60) says -d for the same number, so d = 0."""
    for e, cycles, th0 in ((arb("0.3"), 2, arb("-0.4")), (arb("0.8"), 4, arb("1.1"))):
        turn = cycles * arb.pi()
        v = ((th0 + turn).cos() - th0.cos()) / (1 - e)
        tiny(v, "(65)")
        flights = [-(th + turn).sin() + (th.cos() - e * v) * turn + th.sin() for th in (th0, th0 + turn)]
        tiny(flights[0] - flights[1], "the displacements (58) and (60)")
        excludes(flights[0], "either of them")
    return Finding("(64), (65): equispaced, even N, e < 1, is impossible", PROVED,
                   "v = 0, and (58), (60) have equal right sides but d and -d on the left")


def satisfies(name):
    """The listed orbit solves (61), (62) and (63), and is not equispaced."""
    orbit = listed(name)
    e, turn = orbit.pair.e, orbit.cycles * arb.pi()
    (_, th0, v0), (_, th1, v1) = orbit.states
    tiny(v0 + v1, "(61)")
    tiny(v0 - (th1.cos() - th0.cos()) / (1 - e), "(62)")
    tiny(orbit.pair.drift(th0, v0) * (th1 - th0) + orbit.pair.drift(th1, v1) * (2 * turn + th0 - th1), "(63)")
    excludes(th1 - th0 - turn, "the spacing")
    return finding(name, f"even {name} is physically impossible", FALSE)


def elastic():
    """e = 1, N = 2 and 4, d = 20 A: equispaced orbits with th0 = +-pi/2 and |v| = d W/(N pi)."""
    pair, shown = Pair(20, 1), []
    for cycles in (2, 4):
        speed = pair.gap / (cycles * arb.pi())
        states = [(LEFT, arb.pi() / 2, -speed), (RIGHT, arb.pi() / 2 + cycles * arb.pi(), speed)]
        orbit = Orbit(pair, cycles, states)
        for miss in orbit.misses():
            tiny(miss, f"the orbit of N = {cycles}")
        orbit.require_first_contacts()
        shown.append(f"N = {cycles}: |v|/(A W) = {speed.str(8)}")
    return Finding("e = 1: equispaced orbits exist for even N", PROVED, "d = 20 A; " + ", ".join(shown))


CLAIMS = {"even-cycles": lambda quick: [equispaced(), satisfies("N = 2"), satisfies("N = 4"), elastic()]}
