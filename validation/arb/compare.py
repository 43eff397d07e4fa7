"""Judges `impact-pair run SCENE` impact by impact against the balls of this simulator.

Same wall and same mapping; both enclosures of a time and of a velocity hold the same true value, so they overlap; and
where the ball is a thousand times narrower, the printed bounds hold all of it.
"""
import csv
import re
import subprocess
from collections import namedtuple
from fractions import Fraction
from itertools import zip_longest

from flint import arb

from controls import check_controls
from orbit import orbit
from scene import Scene
from simulate import HEADER, ends, exact

NARROW = 1000
DECIMAL = re.compile(r"-?\d+(\.\d*)?(e[-+]?\d+)?\Z", re.IGNORECASE)


# The counts of a comparison: `held` of the two enclosures per impact hold the whole ball; the widest time and velocity printed.
Found = namedtuple("Found", "impacts held bits time velocity spoiled")


class Disagreement(Exception):
    """The rows contradict the proved orbit, or are not the requested ones."""


def read_rows(lines):
    """The rows of the CSV, which has the header of the interface."""
    table = csv.reader(lines)
    header = next(table, [])
    if header != HEADER:
        raise Disagreement(f"the header is {','.join(header)!r}, expected {','.join(HEADER)!r}")
    rows = list(table)
    for number, fields in enumerate(rows, 1):
        if len(fields) != len(HEADER):
            raise Disagreement(f"row {number} has {len(fields)} fields, expected {len(HEADER)}")
    return [dict(zip(HEADER, fields)) for fields in rows]


def bounds(row, name):
    """The two printed bounds of a quantity, as fractions."""
    texts = [row[f"{name}_{side}"] for side in ("lower", "upper")]
    for text in texts:
        if not DECIMAL.match(text):
            raise Disagreement(f"{text!r} is not a decimal")
    lower, upper = (Fraction(text) for text in texts)
    if lower > upper:
        raise Disagreement(f"the bounds of the {name} are the wrong way round")
    return lower, upper


def short(fraction):
    """About the value, whatever its size."""
    return (arb(fraction.numerator) / fraction.denominator).str(17, radius=False)


def judge_quantity(name, printed, ball):
    """True if the printed bounds hold the whole ball, which they must if they are much wider."""
    (lower, upper), (low, high) = printed, ends(ball)
    shown = lambda: f"the {name} is in {ball.str(25)}, the printed bounds are {short(lower)}, {short(upper)}"
    if high < lower or upper < low:
        raise Disagreement(f"{shown()}: proved to be outside")
    holds = lower <= low and high <= upper
    if not holds and (upper - lower) > NARROW * (high - low):
        raise Disagreement(f"{shown()}: the ball sticks out")
    return holds


def judge_row(row, impact):
    """Number of the two enclosures that hold the whole ball; raises if anything contradicts the impact."""
    found = tuple(row[key] for key in HEADER[:4])
    expected = ("impact", str(impact.index), impact.mapping or "", impact.wall)
    if found != expected:
        raise Disagreement(f"found {','.join(found)!r}, proved {','.join(expected)!r}")
    return sum(judge_quantity(name, bounds(row, name), getattr(impact, name)) for name in ("time", "velocity"))


def compare(rows, impacts):
    """Number of enclosures, two per impact, that hold the whole ball; raises Disagreement at the first contradiction."""
    held = 0
    for number, (row, impact) in enumerate(zip_longest(rows, impacts), 1):
        if row is None:
            raise Disagreement(f"impact {number} is missing: there are only {number - 1} rows")
        if impact is None:
            raise Disagreement(f"row {number} is one more than asked for")
        try:
            held += judge_row(row, impact)
        except Disagreement as error:
            raise Disagreement(f"impact {number}: {error}") from None
    return held


def widest(rows, scene):
    """The widest printed enclosures of a time and of a velocity, in units of 2 pi/W and A W, about."""
    motion = scene.motion()
    units = {"time": motion.period(), "velocity": motion.speed()}
    return [
        max(float((upper - lower) / exact(unit.mid())) for lower, upper in (bounds(row, name) for row in rows))
        for name, unit in units.items()
    ]


def run_binary(binary, scene, impacts, digits, arithmetic):
    """The CSV that the program under test prints; it may call some of it too wide only if it was not `auto`."""
    command = [binary, "run", scene, "--impacts", str(impacts), "--digits", str(digits)]
    command += ["--arithmetic", arithmetic, "--format", "csv"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in ((0,) if arithmetic == "auto" else (0, 1)):
        raise Disagreement(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.strip()}")
    return done.stdout.splitlines()


def judge(path, lines, impacts, digits):
    """`Found` in the lines of a CSV with the first `impacts` impacts of a scene."""
    scene = Scene.read(path)
    rows = read_rows(lines)
    proved, bits = orbit(scene, impacts, max(30, digits + 20))
    held = compare(rows, proved)
    spoiled = check_controls(rows, proved, compare, Disagreement)
    return Found(len(rows), held, bits, *widest(rows, scene), spoiled)


def describe(found):
    """The line that says what was compared."""
    return (
        f"{found.impacts} impacts agree in wall, mapping, time and velocity; {found.held} of {2 * found.impacts} "
        f"enclosures hold the whole Arb ball ({found.bits} bits), widest {found.time:.1e} periods, "
        f"{found.velocity:.1e} A W; {found.spoiled} spoiled copies were refused"
    )
