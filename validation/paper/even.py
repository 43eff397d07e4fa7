"""Section 4 on even N: no equispaced orbit for e < 1, but unequispaced ones, and equispaced ones for e = 1."""
from flint import arb

from contact import first_contact
from finding import FALSE, PROVED, Finding, excludes, expect, tiny
from listed import finding, listed
from pair import LEFT, RIGHT, Pair


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
        for this, following in ((states[0], states[1]), (states[1], (LEFT, states[0][1] + 2 * cycles * arb.pi(), -speed))):
            for miss in pair.misses(this, following):
                tiny(miss, f"the orbit of N = {cycles}")
            contact = first_contact(pair, *this)
            expect(contact.wall == following[0] and contact.isolating.contains(following[1]), "first contact")
        shown.append(f"N = {cycles}: |v|/(A W) = {speed.str(8)}")
    return Finding("e = 1: equispaced orbits exist for even N", PROVED, "d = 20 A; " + ", ".join(shown))


CLAIMS = {"even-cycles": lambda quick: [satisfies("N = 2"), satisfies("N = 4"), elastic()]}
