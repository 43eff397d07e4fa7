"""Stability of the equispaced orbits: the criterion on tan th0 against eigenvalues, and against the program itself."""
from mpmath import atan, log, mpf, pi, tan

import equispaced
from jacobian import derivative, eigenvalues, product, radius, states, steps, trace_determinant
from program import Disagreement, run, scene
from two_impact import TINY

# The change of v that is followed, relative; how much it must shrink or grow, and how much the theory requires.
CHANGE = "1e-6"
SHRUNK, GROWN = mpf("1e-2"), mpf(10)
SHRINKS, GROWS = mpf("1e-4"), mpf("1e3")
MOST_IMPACTS = 120
# Orbits whose extrema come nearer to a wall, in gaps, are not changed: they might graze.
CLEAR = mpf("0.01")
# Central differences in 50 digits.
DIFFERENCES = mpf(10) ** -22


def half_trace(e, cycles, tan_theta):
    """The trace of the half map."""
    return 2 * e + (1 - e**2) * cycles * pi / 2 * tan_theta


def check_identities(orbit):
    """(38)-(40), det DP = e^4, and the trace of the half map; 1 if they hold."""
    m, (first, second) = product(orbit), steps(orbit)
    trace, determinant = trace_determinant(m)
    scale = 1 + abs(trace)
    # The half map is an impact and the mirror image: the Jacobian with its second row negated.
    half, other = (step[0, 0] - step[1, 1] for step in (first, second))
    e, tan_theta = orbit.e, tan(orbit.theta0)
    claims = {
        "det DP = e^4": determinant - e**4,
        "half trace": half - half_trace(e, orbit.N, tan_theta),
        "trace from the half map": trace - (half**2 - 2 * e**2),
        "both halves are alike": other - half,
        "half determinant": -trace_determinant(first)[1] - e**2,
    }
    for value in eigenvalues(m):
        claims["characteristic polynomial"] = value**2 - trace * value + determinant
    for name, rest in claims.items():
        if abs(rest) > TINY * scale**2:
            raise Disagreement(f"{name}: off by {rest}")
    if not trace + determinant + 1 > 0:
        raise Disagreement(f"(39): tr + det + 1 = {trace + determinant + 1} on an equispaced orbit")
    return 1


def check_derivative(orbit):
    """(A.7) against central differences of the mapping; 1 if they agree."""
    before, after = states(orbit)[:2]
    found = derivative(orbit.A, orbit.W, orbit.theta0, orbit.e, before, after)
    expected = steps(orbit)[0]
    units = [[mpf(1), 1 / orbit.speed / orbit.W], [orbit.speed * orbit.W, mpf(1)]]
    for i in (0, 1):
        for j in (0, 1):
            size = units[i][j] + abs(expected[i, j])
            if abs(found[i, j] - expected[i, j]) > DIFFERENCES * size:
                raise Disagreement(f"(A.7) entry {i}, {j}: {expected[i, j]}, by differences {found[i, j]}")
    return 1


def check_criterion(orbit):
    """Inside the unit circle exactly when tan th0 is between its bounds; whether it is."""
    is_stable = radius(product(orbit)) < 1
    if is_stable != equispaced.is_stable(orbit):
        raise Disagreement(f"stability: eigenvalues say {is_stable}, tan th0 says {not is_stable}")
    return is_stable


def check_ends(e, cycles):
    """At both ends of the stable range tr = 1 + det (40), and A/d is A_pf/d and A_sn/d; how many of 4 claims hold."""
    bounds = equispaced.bounds_of_stability(e, cycles)
    for bound, expected in zip(bounds, equispaced.critical_amplitudes(e, cycles)):
        theta0 = atan(bound)
        half = half_trace(e, cycles, bound)
        trace, determinant = half**2 - 2 * e**2, e**4
        for name, rest in {
            "(40) at the end of the stable range": trace - 1 - determinant,
            "critical A/d": equispaced.amplitude_over_gap(theta0, e, cycles) / expected - 1,
        }.items():
            if abs(rest) > TINY * (1 + abs(trace)):
                raise Disagreement(f"{name}, e = {e}, N = {cycles}: off by {rest}")
    return 4


def check_perturbed(orbit, binary):
    """A start changed by CHANGE comes nearer to the orbit, or leaves it, as the criterion says, in certified bounds.

    Returns "shrinks" or "grows", or None where this would take too many impacts, or the orbit nearly grazes.
    """
    rate = radius(product(orbit))
    pairs = int(log(SHRINKS if rate < 1 else GROWS) / log(rate)) + 1 if orbit.e > 0 else MOST_IMPACTS
    if 2 * pairs > MOST_IMPACTS or orbit.margin() < CLEAR or orbit.earlier():
        return None
    found = run(binary, scene(orbit, factor=f"1 + {CHANGE}"), 2 * pairs, 15)
    if not found.certified or len(found.events) != 2 * pairs:
        raise Disagreement(f"changed start: outcome {found.outcome} after {len(found.events)} events")
    first = mpf(CHANGE) * orbit.speed / (orbit.A * orbit.W)
    nearest, farthest = distance(found.events[-1], list(orbit.impacts(2 * pairs))[-1], orbit)
    if rate < 1 and not farthest < SHRUNK * first or rate > 1 and not nearest > GROWN * first:
        raise Disagreement(f"changed start: {first} becomes {nearest} to {farthest}, with eigenvalues of size {rate}")
    return "shrinks" if rate < 1 else "grows"


def distance(event, impact, orbit):
    """Bounds on the distance of an event to an impact, times in 1/W, velocities in A W; the larger of the two."""
    unit = orbit.A * orbit.W
    bounds = [between(event.time, impact.time, orbit.W), between(event.velocity, impact.velocity, 1 / unit)]
    return max(low for low, _ in bounds), max(high for _, high in bounds)


def between(interval, value, scale):
    low, high = ((bound - value) * scale for bound in interval)
    return (0 if low <= 0 <= high else min(abs(low), abs(high))), max(abs(low), abs(high))
