"""Chatter that others are measured by: A = 1, W = tau = pi, d = 9.42497, from the left wall with v = -0.5."""
from fractions import Fraction

from flint import arb, ctx

from compare import Disagreement, bounds
from scene import LEFT, RIGHT
from simulate import ends

ANCHOR_DIGITS = 30
# Times at which the ball comes to rest, to the precision of another simulator's double-precision sums.
RESTS = {"0.3": "0.2180134007005836", "0.5": "0.3571367598910375"}
SUMS_ERROR = Fraction(1, 10**15)
GAP = "9.42497"


def anchor(restitution):
    """The scene."""
    return {
        "excitation": {"amplitude": "1", "frequency": "pi", "phase": "pi"},
        "pair": {"gap": GAP, "restitution": restitution},
        "start": {"time": "0", "wall": LEFT, "velocity": "-0.5"},
    }


ANCHORS = {f"chatter with e = {restitution}": anchor(restitution) for restitution in RESTS}


def edge(velocity):
    """A = 2, W = d = 1, e = 0.5, from the left wall, which releases the ball 0.3 later."""
    return {
        "excitation": {"amplitude": "2", "frequency": "1", "phase": "-0.3"},
        "pair": {"gap": "1", "restitution": "0.5"},
        "start": {"time": "0", "wall": LEFT, "velocity": velocity},
    }


# Found by bisection: at rest less than 10^-10 before the release, and not at rest before it.
EDGES = {
    "chatter that just ends": edge("-0.0536887739492693936982359"),
    "chatter that just does not": edge("-0.05368877394926939402"),
}


def crossing():
    """A ball around the first impact after the release at t = 1: there z = pi s - sin(pi s) = d, s = t - 1.

    z grows, z' = pi (1 - cos(pi s)) >= 0, from 3 pi = 9.4247... at s = 3 to more than 9.7 at s = 3.5.
    """
    with ctx.workprec(256):
        low, high = arb(3), arb("3.5")
        for _ in range(200):
            s = (low + high) / 2
            below = arb.pi() * s - arb.sin_pi(s) < arb(GAP)
            low, high = (s, high) if below else (low, s)
        return 1 + low.union(high)


def check_anchor(rows, tables):
    """The rest is where it was found to be, the release exactly at 1, the next impact on the right at crossing()."""
    at = next(number for number, row in enumerate(rows) if row["event"] == "rest")
    rest, release, impact = rows[at : at + 3]
    known = Fraction(RESTS[tables["pair"]["restitution"]])
    lower, upper = bounds(rest, "time")
    if not lower - SUMS_ERROR <= known <= upper + SUMS_ERROR:
        raise Disagreement(f"a rest at about {float(lower)}, found elsewhere at {float(known)}")
    if bounds(release, "time") != (1, 1):
        raise Disagreement("the release is not shown to be at 1, exactly")
    lower, upper = bounds(impact, "time")
    low, high = ends(crossing())
    if impact["wall"] != RIGHT or not (lower <= low and high <= upper):
        raise Disagreement(f"the impact after the release is not at {crossing().str(30)}")
