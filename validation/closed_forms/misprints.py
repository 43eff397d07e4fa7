"""The paper's misprints that numbers can decide: the printed form fails, the right one holds."""
from collections import Counter, namedtuple

from mpmath import cos, mpf, norm, pi, sin

from elastic import elastic_orbits
from equispaced import equispaced
from jacobian import derivative, jacobian, printed_a7, product, states
from program import Disagreement
from unequispaced import unequispaced

# Residuals of the right and the printed form on orbits or mappings they should describe, relative; above DECIDED a form fails.
Claim = namedtuple("Claim", "name right printed")
HOLDS, DECIDED = mpf(10) ** -25, mpf("1e-4")
# Figure 15: impacts after which the motion has settled, and those that are then counted.
SETTLED, COUNTED = 600, 100


def claim_62():
    orbit = next(unequispaced("0.5", "-0.5", 2))
    side = orbit.A * orbit.W / (1 - orbit.e) * (cos(orbit.theta0 + orbit.first) - cos(orbit.theta0))
    return Claim("(62): the left side is v_i, not v_{i+1}", abs(-orbit.speed - side), abs(orbit.speed - side))


def claims_a7():
    """(A.7) with a start that is not at time 0, so that t and tau differ."""
    orbit = equispaced("1", "2", "0.6", "-0.7", 1)
    shift = mpf("0.3")
    before, after = ((t + shift, v) for t, v in states(orbit)[:2])
    data = orbit.A, orbit.W, orbit.theta0 - orbit.W * shift, orbit.e, before, after
    truth = derivative(*data)
    right = norm(jacobian(*data) - truth)
    for mistake, name in (("tau", "sin(W t_{i+1} + tau), not + t"), ("velocity", "e h/v_{i+1}, not e v_{i+1} h")):
        yield Claim(f"(A.7): {name}", right, norm(printed_a7(*data, mistake) - truth))


def claim_fixed_point():
    """(30), (32): P x = x on the orbit, but DP, of determinant e^4, is not the identity."""
    orbit = equispaced("1", "2", "0.6", "-0.7", 1)
    m = product(orbit)
    return Claim("(30), (32): a fixed point, not P = I", max(abs(x) for x in orbit.residuals()),
                 max(abs(m[0, 0] - 1), abs(m[1, 1] - 1), abs(m[0, 1]), abs(m[1, 0])))


def claim_65():
    """N even, equispaced, e < 1: v = 0 by (62); (58) + (60) then leave 2 d = 0; right: cos th0 = 0 and d = 0."""
    def rest(theta0, N):
        d = N * pi * cos(theta0)  # (58) in units of A
        return abs(d + N * pi * cos(theta0 + N * pi))  # (60), with c' = A W cos th1

    return Claim("(65): also forces d = 0", rest(pi / 2, 2), min(rest(mpf(x) / 5, 2) for x in range(-7, 8)))


def claims_70():
    """e = 1, not equispaced: cos th1 = cos th0; neither cos th1 = -cos th0 nor d = 2 A sin th0 - N pi v/W holds."""
    orbits = elastic_orbits()[2]
    cosines = [(cos(orbit.theta0), cos(orbit.theta0 + orbit.first)) for orbit in orbits]
    right = max(abs(here - there) for here, there in cosines)
    yield Claim("(70): cos th1 = -cos th0 presupposes (64)", right, min(abs(here + there) for here, there in cosines))
    rests = [abs(2 * o.A * sin(o.theta0) + o.N * pi * o.speed / o.W - o.d) / o.d for o in orbits]
    right = max(max(abs(x) for x in orbit.residuals()) for orbit in orbits)
    yield Claim("(70): so does d = 2 A sin th0 - N pi v/W", right, min(rests))


def claims():
    """All claims; raises Disagreement where one is not decided as stated."""
    found = [claim_62(), *claims_a7(), claim_fixed_point(), claim_65(), *claims_70()]
    for claim in found:
        if not claim.right < HOLDS:
            raise Disagreement(f"{claim.name}: the right form leaves {claim.right}")
        if not claim.printed > DECIDED:
            raise Disagreement(f"{claim.name}: the printed form leaves only {claim.printed}")
    return found


def check_figure_15(events):
    """The settled motion has 2 impacts on the right and 3 on the left a cycle: m and n of the text after (53).

    So (52) with P3^m and P4^n means m + n + 2 impacts a period, and m and n count impacts with exponents m - 1, n - 1.
    """
    walls = [event.wall for event in events[SETTLED : SETTLED + COUNTED]]
    runs, last = [], None
    for wall in walls:
        if wall == last:
            runs[-1][1] += 1
        else:
            runs.append([wall, 1])
        last = wall
    found = Counter((wall, length) for wall, length in runs[1:-1])
    if set(found) != {("right", 2), ("left", 3)}:
        raise Disagreement(f"figure 15: runs of impacts {dict(found)}, expected 2 on the right and 3 on the left")
    cycles = (events[SETTLED + COUNTED].time[0] - events[SETTLED].time[0]) / mpf("0.2")
    if abs(cycles - COUNTED / 5) > mpf("1e-3"):
        raise Disagreement(f"figure 15: {COUNTED} impacts in {cycles} cycles")
    return COUNTED
