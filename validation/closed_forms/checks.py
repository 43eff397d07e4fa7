"""The checks of one orbit of each family, each giving a Counter; jobs for several processes."""
from collections import Counter, namedtuple

from mpmath import cos, mpf, pi, sin

import equispaced
import manifold
import misprints
import stability
import verb
from elastic import elastic_orbits
from jacobian import product, radius
from judge import check_earlier, check_half_map, check_impacts, check_mirrored_runs, must_refuse, IMPACTS
from program import Disagreement, run, scene
from two_impact import TINY, evaluate
from unequispaced import unequispaced_orbits

Job = namedtuple("Job", "part check orbit number")
# Digits requested of the program, starting walls and times, by turns.
DIGITS, WALLS, TIMES = (9, 35), ("left", "right"), ("0", "1/3", "-7")
SLIP = "1 + 1e-9"
EQUISPACED, UNEQUISPACED = "equispaced, e < 1, N odd (66)-(69), (72)", "not equispaced, e < 1 (62), (63)"


def judge_orbit(orbit, binary, wall, time, digits):
    """The orbit satisfies its equations; the program encloses it, or finds the earlier contact; counts."""
    rest = max(abs(value) for value in orbit.residuals())
    if rest > TINY * (1 + orbit.d / orbit.A):
        raise Disagreement(f"(57)-(60) leave {rest}")
    earlier, found = orbit.earlier(), run(binary, scene(orbit, wall, time), IMPACTS, digits)
    tally = Counter(orbits=1, physical=earlier is None, earlier=earlier is not None)
    if earlier is None:
        tally["enclosures"] = check_impacts(found, orbit, wall, time)
    else:
        tally["enclosures"] = check_earlier(found, orbit, earlier, wall, time)
        tally["refused"] = must_refuse("an orbit with an earlier contact", check_impacts, found, orbit, wall, time)
    return tally, found


def refuse_slips(orbit, binary):
    """A start with v wrong by 10^-9, or the wrong sign of sin th0, is not the orbit.

    But with e = 0 the start's velocity is forgotten, and with N even and cos th0 = 0 both signs are orbits.
    """
    count = 0
    if orbit.e > 0:
        found = run(binary, scene(orbit, factor=SLIP), IMPACTS, 20)
        count += must_refuse("v changed by 1e-9", check_impacts, found, orbit)
    both_signs = orbit.N % 2 == 0 and abs(cos(orbit.theta0)) < TINY
    if abs(sin(orbit.theta0)) > TINY and not both_signs:
        found = run(binary, scene(orbit, theta_sign="-"), IMPACTS, 20)
        count += must_refuse("the wrong sign of sin th0", check_impacts, found, orbit)
    return count


def check_equispaced(orbit, binary, number):
    """(66), (67): physical as the angle of grazing says, stable as tan th0 says, symmetric."""
    tally, found = judge_orbit(orbit, binary, WALLS[number % 2], TIMES[number % 3], DIGITS[number // 2 % 2])
    is_physical = orbit.earlier() is None
    if is_physical != equispaced.is_physical(orbit):
        raise Disagreement(f"physical: the extrema say {is_physical}, the angle of grazing says {not is_physical}")
    tally["half maps"] = check_half_map(found, orbit) if is_physical else 0
    tally["mirrored runs"] = check_mirrored_runs(binary, orbit, "1 + 1e-2", IMPACTS) > 0
    stable = stability.check_criterion(orbit)
    tally.update(stable=stable, unstable=not stable, identities=stability.check_identities(orbit))
    if orbit.e > 0 and number % 5 == 0:
        tally["derivatives"] = stability.check_derivative(orbit)
    if is_physical:
        tally["refused"] += refuse_slips(orbit, binary) if number % 3 == 0 else 0
        followed = stability.check_perturbed(orbit, binary)
        tally[followed or "not followed"] += 1
    return tally


def check_elastic(orbit, binary, number):
    """(70), (71), N even: e = 1."""
    tally, _ = judge_orbit(orbit, binary, WALLS[number % 2], TIMES[number % 3], DIGITS[number // 2 % 2])
    if not tally["earlier"]:
        tally["refused"] += refuse_slips(orbit, binary)
    return tally


def check_unequispaced(orbit, binary, number):
    """(62), (63)."""
    tally, found = judge_orbit(orbit, binary, "left", "0", DIGITS[1])
    stable = radius(product(orbit)) < 1
    tally.update(stable=stable, unstable=not stable)
    tally["even and stable"] = stable and not tally["earlier"] and orbit.N % 2 == 0
    if not tally["earlier"]:
        orbit.speed *= evaluate(SLIP)
        tally["refused"] += must_refuse("v changed by 1e-9", check_impacts, found, orbit)
    return tally


def check_manifold(orbit, binary, number):
    """(68), (72), (73): a point of figures 10 and 11."""
    if not manifold.forms_agree(orbit):
        raise Disagreement("(68), (72) and (73) give different A")
    tally, _ = judge_orbit(orbit, binary, "left", "0", 30)
    dashed = sin(orbit.theta0) < 0
    tally.update(solid=not dashed, dashed=dashed)
    return tally


def check_even_impossible(case, binary, number):
    """(65): N even and e < 1 with v = 0, d = A N pi cos th0 by (58): the program does not find the second crossing."""
    restitution, angle, cycles = case
    theta0 = evaluate(angle)
    if abs(cos(theta0) * cycles * pi + cos(theta0 + cycles * pi) * cycles * pi) < mpf("1e-3"):
        raise Disagreement("(60) is met by an equispaced orbit with N even")
    orbit = equispaced.equispaced("1", "2", restitution, angle, cycles)
    orbit.texts["speed"], orbit.texts["gap"] = "0", f"{cycles}*pi*cos({angle})"
    orbit.speed = mpf(0)
    found = run(binary, scene(orbit), IMPACTS)
    return Counter(orbits=1, refused=must_refuse("an equispaced orbit with N even", check_impacts, found, orbit))


def jobs(thin):
    """All jobs; `thin` takes every `thin`-th orbit of the large families."""
    odd, even, other = elastic_orbits()
    families = {
        EQUISPACED: (check_equispaced, list(equispaced.grid(thin))),
        "equispaced, e = 1, N odd (71)": (check_elastic, odd[::thin]),
        "equispaced, e = 1, N even": (check_elastic, even[::thin]),
        "not equispaced, e = 1 (70)": (check_elastic, other[::thin]),
        UNEQUISPACED: (check_unequispaced, list(unequispaced_orbits(thin))),
        "figures 10 and 11 (68), (73)": (check_manifold, manifold.points()[::thin]),
        "equispaced, e < 1, N even: impossible (65)": (check_even_impossible, [
            (e, angle, cycles) for e in ("0", "0.3", "0.8") for angle in ("0.1", "pi/4", "1.3") for cycles in (2, 4)
        ]),
        **verb.families(thin),
    }
    return [Job(part, check, orbit, n) for part, (check, orbits) in families.items() for n, orbit in enumerate(orbits)]


def check_formulas(binary, scenes):
    """The checks that need no orbit of their own: the ends of stability, the misprints; (number of ends, claims)."""
    ends = sum(
        stability.check_ends(evaluate(e), cycles) for e in equispaced.RESTITUTIONS for cycles in equispaced.CYCLES
    )
    text = (scenes / "figure-15.toml").read_text(encoding="utf-8")
    misprints.check_figure_15(run(binary, text, misprints.SETTLED + misprints.COUNTED + 1).events)
    return ends, misprints.claims()
