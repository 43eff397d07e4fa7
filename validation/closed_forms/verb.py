"""The JSON of `impact-pair two-impact` on the orbits of the closed forms, against 50 digits.

Each orbit must be listed, alone in its bounds, which hold its phases, velocities, trace, determinant and eigenvalues; physical,
symmetric and stable as the formulas here say. By --solve-for amplitude and gap the program must find A and d again.
"""
import json
import subprocess
from collections import Counter

from mpmath import cos, mpf, nstr, pi, sin

import equispaced
import manifold
from elastic import elastic_orbits
from jacobian import eigenvalues, product, trace_determinant
from program import OTHER, Disagreement, pair, scene
from two_impact import TINY, evaluate
from unequispaced import unequispaced_orbits

DIGITS = 30
WORDS = {"left": "P1 P2", "right": "P2 P1"}
# An eigenvalue that a double root or nearly so leaves uncertain, and how near to 1 its size is too near to be decided.
NEAR = mpf(10) ** -18


def ask(binary, orbit, *options):
    """The document of an orbit's scene."""
    command = [binary, "two-impact", "-", "--format", "json", "--cycles", str(orbit.N), "--digits", str(DIGITS), *options]
    done = subprocess.run(command, input=scene(orbit), capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise Disagreement(f"exit code {done.returncode}: {done.stderr.strip()}\n{scene(orbit)}")
    return json.loads(done.stdout)


def holds(bounds, value, slack=TINY):
    low, high = pair(bounds)
    return low - slack * (1 + abs(value)) <= value <= high + slack * (1 + abs(value))


def holds_phase(bounds, value):
    return any(holds(bounds, value % (2 * pi) + turn * 2 * pi) for turn in (-1, 0, 1))


def is_listed(entry, orbit, wall):
    """True if the bounds of an entry hold the impacts of the orbit, listed from this wall."""
    expected = {"left": (orbit.theta0, -orbit.speed), "right": (orbit.theta0 + orbit.first, orbit.speed)}
    walls = [impact["wall"] for impact in entry["impacts"]]
    if walls != [wall, OTHER[wall]]:
        raise Disagreement(f"impacts on {walls}, asked for from the {wall}")
    return all(
        holds_phase(impact["phase"], expected[impact["wall"]][0]) and holds(impact["velocity"], expected[impact["wall"]][1])
        for impact in entry["impacts"]
    )


def expect(claim, text, entry):
    if not claim:
        raise Disagreement(f"two-impact: {text}: {entry}")


def check_entry(entry, orbit):
    """Compares the claims about an orbit; counts those that are decided."""
    matrix = product(orbit)
    trace, determinant = trace_determinant(matrix)
    roots = eigenvalues(matrix)
    expect(entry["unique"] is True, "not alone in its bounds", entry)
    # The determinant of numbers as large as the trace.
    is_right = holds(entry["trace"], trace) and holds(entry["determinant"], determinant, TINY * (1 + trace**2))
    expect(is_right, f"trace {nstr(trace)}", entry)
    parts = [(part["re"], part["im"]) for part in entry["eigenvalues"]]
    for values in (roots, roots[::-1]):
        if all(holds(re, root.real, NEAR) and holds(im, root.imag, NEAR) for (re, im), root in zip(parts, values)):
            break
    else:
        raise Disagreement(f"two-impact: eigenvalues {roots}: {entry}")
    is_physical = orbit.earlier() is None
    expect(entry["physical"] in (is_physical, None), f"physical is {is_physical}", entry)
    size = max(abs(root) for root in roots)
    expected = "undecided" if orbit.e == 1 and size < 1 + NEAR else "stable" if size < 1 else "unstable"
    expect(entry["stability"] == expected or abs(size - 1) < NEAR, f"it is {expected}", entry)
    is_symmetric = orbit.N % 2 == 1 and abs(orbit.first - orbit.N * pi) < TINY
    expect(entry["symmetric"] is is_symmetric, f"symmetric is {is_symmetric}", entry)
    undecided = entry["physical"] is None
    return Counter({"listed": 1, expected: 1, "physical": entry["physical"] is True, "undecided": undecided})


def check_verb(orbit, binary, number):
    """An orbit is in the list of all orbits for its A and d, exactly once, and so is its mirror image."""
    wall = ("left", "right")[number % 2]
    document = ask(binary, orbit, "--wall", wall)
    expect(document["word"] == WORDS[wall] and document["cycles"] == orbit.N, "word or cycles", document)
    expect(document["exhaustive"] is True, "not all orbits are proved to be found", document["undecided"])
    entries = [entry for entry in document["orbits"] if is_listed(entry, orbit, wall)]
    expect(len(entries) == 1, f"listed {len(entries)} times: th0 = {orbit.theta0}", document["orbits"])
    tally = check_entry(entries[0], orbit)
    satisfied = sum(satisfies(entry, orbit) for entry in document["orbits"])
    expect(satisfied == len(document["orbits"]), "an entry does not satisfy (57)-(60)", document["orbits"])
    return tally + Counter(orbits=1, entries=satisfied)


def satisfies(entry, orbit):
    """True if the middle of an entry satisfies (57)-(60) as well as its digits let it."""
    middle = {impact["wall"]: [sum(pair(impact[key])) / 2 for key in ("phase", "velocity")] for impact in entry["impacts"]}
    (theta0, v0), (_, v1), p = middle["left"], middle["right"], sum(pair(entry["spacing"])) / 2
    A, W, e, d = orbit.A, orbit.W, orbit.e, orbit.d
    for (theta, before, length, after, way) in [(theta0, v0, p, v1, d), (theta0 + p, v1, 2 * orbit.N * pi - p, v0, -d)]:
        c = -e * before + A * W * cos(theta)
        velocity = c - A * W * cos(theta + length) - after
        place = c * length / W - A * sin(theta + length) + A * sin(theta) - way
        scale = mpf(10) ** (3 - DIGITS) * (1 + orbit.N) * (1 + abs(v1) / (A * W))
        if abs(velocity) > scale * A * W or abs(place) > scale * (A + d):
            return False
    return True


def check_solved(orbit, binary, number):
    """(68) and (67): A from d and v, d from A and v."""
    tally = Counter(orbits=1)
    for key, value in (("amplitude", orbit.A), ("gap", orbit.d)):
        document = ask(binary, orbit, "--solve-for", key)
        if key == "gap" and orbit.theta0 == 0 and document["undecided"]:
            tally["undecided"] += 1  # cos th0 = 1 is a double solution, known only where expressions are monomials.
            continue
        entries = [entry for entry in document["orbits"] if holds(entry[key], value) and is_listed(entry, orbit, "left")]
        expect(len(entries) == 1, f"{key} {nstr(value)} is given {len(entries)} times", document["orbits"])
        if entries[0]["unique"]:
            tally += check_entry(entries[0], orbit)
    return tally


def families(thin):
    """(name, check, orbits) of the suite."""
    odd, even, other = elastic_orbits()
    spread = list(equispaced.grid(3 * thin))
    # Data whose v is an expression, so that A and d are known exactly.
    solved = [orbit for orbit in spread if "[" not in orbit.texts["theta0"]] + manifold.points()[:: 2 * thin]
    return {
        "two-impact: equispaced, e < 1": (check_verb, spread),
        "two-impact: not equispaced, e < 1": (check_verb, list(unequispaced_orbits(2 * thin))),
        "two-impact: e = 1": (check_verb, (odd + even)[:: 2 * thin] + decided(other)[:: 2 * thin]),
        "two-impact: solved for A and d": (check_solved, solved),
    }


def decided(orbits):
    """Those with e = 1 that are not on both branches of (70): th0 = 0 or pi are met twice."""
    return [orbit for orbit in orbits if abs(sin(orbit.theta0)) > evaluate("1e-9")]
