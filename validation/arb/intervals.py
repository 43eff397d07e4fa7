"""Scenes with intervals among the data: what is listed must hold the orbit of every member that is tried."""
import random
from collections import Counter, namedtuple
from fractions import Fraction

from compare import Disagreement, bounds
from listing import judge
from program import listing
from recorded import toml
from scene import LEFT, RIGHT, Scene
from simulate import decimal_below
from timeline import Timeline

# A scene with [low, high] in place of some of its values, and some members of it.
IntervalScene = namedtuple("IntervalScene", "name tables members")
PLACES = 40
MEMBERS = 6
DIGITS = 9
KEYS = [("excitation", "amplitude"), ("excitation", "frequency"), ("excitation", "phase"), ("pair", "gap"),
        ("pair", "restitution"), ("start", "time"), ("start", "velocity")]


def middle(draw):
    """Plain decimals for everything: A/d from 0.03 to 3, e from 0.1 to 0.9, of order 1 otherwise."""
    wall = draw.choice((LEFT, RIGHT))
    velocity = draw.uniform(0.5, 20) * (-1 if wall == LEFT else 1)
    return {
        "excitation": {
            "amplitude": f"{10 ** draw.uniform(-1.5, 0.5):.6f}",
            "frequency": f"{draw.uniform(1, 7):.6f}",
            "phase": f"{draw.uniform(-3, 3):.6f}",
        },
        "pair": {"gap": "1", "restitution": f"{draw.uniform(0.1, 0.9):.6f}"},
        "start": {"time": f"{draw.uniform(-1, 1):.6f}", "wall": wall, "velocity": f"{velocity:.6f}"},
    }


def with_values(tables, values):
    """The tables with other values under some keys."""
    changed = {table: dict(entries) for table, entries in tables.items()}
    for (table, key), value in values.items():
        changed[table][key] = value
    return changed


def interval_scene(draw, number):
    """One to three values become intervals, 10^-9 to 10^-3 wide to each side; members are both ends and between."""
    tables = middle(draw)
    ranges = {}
    for table, key in draw.sample(KEYS, draw.randint(1, 3)):
        value, reach = Fraction(tables[table][key]), Fraction(f"{10 ** -draw.uniform(3, 9):.12f}")
        ranges[table, key] = value - reach, value + reach
    written = {key: f"[{decimal_below(low, 12)}, {decimal_below(high, 12)}]" for key, (low, high) in ranges.items()}
    members = []
    for index in range(MEMBERS):
        share = {key: Fraction(min(index, 1)) if index < 2 else Fraction(draw.randint(0, 1000), 1000) for key in ranges}
        members.append(with_values(tables, {
            key: decimal_below(low + share[key] * (high - low), PLACES) for key, (low, high) in ranges.items()
        }))
    return IntervalScene(f"interval scene {number}", with_values(tables, written), members)


def interval_scenes(count, seed):
    """So many scenes, the same ones for the same seed."""
    draw = random.Random(seed)
    return [interval_scene(draw, number) for number in range(count)]


def judge_interval_scene(scene, binary, impacts):
    """A Counter of what was found to hold; the members prove it."""
    rows, outcome = listing(binary, toml(scene.tables), ["--impacts", str(impacts), "--digits", str(DIGITS)])
    listed = sum(row["event"] == "impact" for row in rows)
    tally = Counter(scenes=1, listed=listed)
    tally[outcome["kind"]] += 1
    for number, member in enumerate(scene.members):
        try:
            tally += judge_member(rows, member, listed)
        except Disagreement as error:
            raise Disagreement(f"member {number}: {error}\n{toml(member)}") from None
    tally["spoiled"] += check_spoiled(rows, scene.members, listed)
    return tally


def judge_member(rows, member, listed):
    """The member's balls, which are much narrower, lie inside all the bounds, as far as the orbit is proved."""
    verdict = judge(rows, Timeline(Scene(member), DIGITS), False)
    if verdict.held != 2 * verdict.impacts + verdict.rests:
        raise Disagreement("a ball of the member sticks out")
    if verdict.proved_end is None and verdict.impacts != listed:
        raise Disagreement(f"{listed} impacts, proved {verdict.impacts}")
    return Counter(members=1, impacts=verdict.impacts, rests=verdict.rests, held=verdict.held,
                   enclosures=2 * verdict.impacts + verdict.rests, beyond=verdict.proved_end is not None)


def check_spoiled(rows, members, listed):
    """1 if bounds cut at the middle of the last impact's times are refused by a member; all are on one side else."""
    numbers = [number for number, row in enumerate(rows) if row["event"] == "impact"]
    if not numbers:
        return 0
    at = numbers[-1]
    lower, upper = (Fraction(value) for value in bounds(rows[at], "time"))
    past = decimal_below(2 * upper - lower + Fraction(1, 10**PLACES), PLACES + 10)
    copy = rows[:at] + [rows[at] | {"time_lower": past, "time_upper": past}] + rows[at + 1 :]
    for member in members:
        try:
            judge_member(copy, member, listed)
        except Disagreement:
            continue
        raise Disagreement("negative control: a time past the listed bounds was not refused")
    return len(members)
