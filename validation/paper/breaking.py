"""Section 4: what follows the symmetry-breaking pitchfork at e = 0.8: unequispaced orbits, and they double."""
from flint import arb

from closed import Equispaced
from finding import PROVED, Finding, excludes, expect
from listed import ORBITS, finding, listed
from pair import Pair
from periodic import find, prove


def unequispaced():
    """At A = 0.36 d the equispaced orbit is unstable, an unequispaced one is stable; its mirror image is another."""
    family, gap = Equispaced("0.8"), 1 / arb("0.36")
    expect(not prove(Pair(gap, "0.8"), family.seed(gap), 1).stable(), "the equispaced orbit at A = 0.36 d")
    (_, th0, _), (_, th1, _) = listed("unequispaced, A = 0.36 d").states
    excludes(th1 - th0 - arb.pi(), "its spacing")
    return finding("unequispaced, A = 0.36 d", "beyond the pitchfork two impacts per cycle become unequispaced")


def branch(ratio, radius):
    """The unequispaced orbit at A/d = ratio; if that is a wide ball, one for each A/d in it."""
    seed = ORBITS["unequispaced, A = 0.46 d"]
    start = find(Pair(1 / ratio.mid(), seed.e), seed.wall, seed.th, seed.v, seed.impacts, seed.cycles)
    return prove(Pair(1 / ratio, seed.e), start.states, seed.cycles, radius)


def doubling():
    """An eigenvalue passes -1 between two amplitudes on one branch: (39) holds between them."""
    low, high = arb("0.4627"), arb("0.4628")
    whole = branch(low.union(high), arb("0.002"))
    first, last = (branch(ratio, arb(2) ** -50) for ratio in (low, high))
    for end in (first, last):
        for (_, th, v), (_, end_th, end_v) in zip(whole.states, end.states):
            expect(th.contains(end_th) and v.contains(end_v), "the ends are on the branch")
    expect(first.stable() and last.eigenvalues()[0] < -1, "an eigenvalue passes -1")
    return Finding("the unequispaced orbit doubles, (39)", PROVED, "between A/d = 0.4627 and 0.4628, e = 0.8: "
                   f"eigenvalues {first.shown()}, then {last.shown()}, on one branch")


def doubled():
    """The double at A = 0.468 d."""
    (_, _, v0), _, (_, _, v2), _ = listed("doubled, A = 0.468 d").states
    excludes(v2 - v0, "the difference of its halves")
    return finding("doubled, A = 0.468 d", "after the doubling: four impacts in two cycles")


CLAIMS = {"beyond-pitchfork": lambda quick: [unequispaced(), doubling(), doubled()]}
