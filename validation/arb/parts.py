"""The comparisons in ten parts, each a list of jobs; each job runs in a process of its own."""
import re
from collections import Counter, namedtuple

from chaos import judge_chaos
from compare import Disagreement, describe, judge, run_binary
from corner_check import judge_corner
from corners import corners
from intervals import interval_scenes, judge_interval_scene
from judging import judge_scene
from recorded import is_calm, random_scenes, straddling_scenes, toml
from several_check import judge_untold
from several_corners import several_corners, untold_corners
from shadow import chaotic_scenes, judge_shadow
from tangency import judge_document

FIGURES = [f"scenes/figure-{number}.toml" for number in (12, 13, 14, 15, 16, 17)]
DIGITS = 9
# Number of impacts that doubles must reach for every figure.
IN_DOUBLES = 60

# `judge(*arguments, binary)` gives a Counter and a remark; `scene` is printed if it fails.
Job = namedtuple("Job", "part name judge arguments scene")
# Amounts of everything that is compared; 200 impacts of a scene unless it says otherwise.
Amount = namedtuple(
    "Amount", "figures long resting resting_impacts extremes extreme_impacts several several_impacts straddling "
    "intervals shadowed depths",
)
FULL = Amount(200, 2000, 60, 200, 200, 60, 200, 60, 200, 40, 1000, None)
# Eight scenes are judged in all ways, ten straddle all branches; near grazes of the least and the greatest depth.
QUICK = Amount(20, 0, 8, 60, 8, 20, 8, 20, 10, 4, 60, (3, 30))
INTERVAL_IMPACTS = 20
# Bits that distinguish 10^-60 from 0, and end soon where it is undecided.
STRADDLING_BITS = 1024
STRADDLING_WAYS = ["auto", "interval", "64", "128", "256"]
SEVERAL, STRADDLING, SHADOWED = "several harmonics", "straddling scenes", "shadowed orbits"
HORSESHOES, TANGENCIES = "horseshoes", "homoclinic tangencies"
PARTS = ["figures", "resting scenes", "extreme scenes", "corner cases", SEVERAL, STRADDLING, "interval scenes", SHADOWED, HORSESHOES, TANGENCIES]
# Impacts, and how many of them are proved by precision.
SPLICED = 300, 200


def way(number):
    """(digits, arithmetic) for a scene: mostly nine digits, now and then more, fewer, or doubles."""
    return {3: (25, "auto"), 5: (2, "auto"), 7: (DIGITS, "interval")}.get(number % 10, (DIGITS, "auto"))


def figure_jobs(amount):
    """Each figure in doubles as far as they go and in nine digits; figure 14 once more, far."""
    asked = [(path, arithmetic, amount.figures) for path in FIGURES for arithmetic in ("interval", "auto")]
    asked += [(FIGURES[2], "auto", amount.long)] if amount.long else []
    for path, arithmetic, impacts in asked:
        name = f"{path.removeprefix('scenes/').removesuffix('.toml')}, {impacts} impacts, {arithmetic}"
        yield Job("figures", name, judge_figure, (path, impacts, arithmetic), "")


def judge_figure(path, impacts, arithmetic, binary):
    """All that is listed agrees; `auto` lists all, doubles at least IN_DOUBLES."""
    lines = run_binary(binary, path, impacts, DIGITS, arithmetic)
    listed = len(lines) - 1 if arithmetic == "interval" else impacts
    if listed < min(impacts, IN_DOUBLES):
        raise Disagreement(f"only {listed} impacts in doubles")
    found = judge(path, lines, listed, DIGITS)
    tally = Counter(scenes=1, impacts=found.impacts, enclosures=2 * found.impacts, held=found.held)
    tally.update({"spoiled": found.spoiled, "impacts-reached" if listed == impacts else "undecided": 1})
    return tally, describe(found)


def scene_jobs(part, all_tables, impacts):
    """Random scenes."""
    for number, tables in enumerate(all_tables):
        name = f"{part} {number}, digits and arithmetic {way(number)}"
        yield Job(part, name, judge_random, (tables, impacts, *way(number), part != SEVERAL), toml(tables))


def judge_random(tables, impacts, digits, arithmetic, may_be_calm, binary):
    """The tally, with a count of the scenes of which most must come to rest."""
    _, tally = judge_scene(tables, binary, impacts, digits, arithmetic)
    if arithmetic == "auto":
        tally["undecided by auto"] = tally["undecided"]
    if may_be_calm and is_calm(tables):
        tally.update(calm=1, calm_resting=tally["resting"])
    return tally, ""


def straddling_jobs(amount):
    """Starts next to where a simulator has to choose, in all arithmetics in turn."""
    for number, (family, tables, impacts) in enumerate(straddling_scenes(amount)):
        arithmetic = STRADDLING_WAYS[number % len(STRADDLING_WAYS)]
        name = f"{STRADDLING} {number}, {family}, {arithmetic}"
        yield Job(STRADDLING, name, judge_straddling, (tables, impacts, arithmetic), toml(tables))


def judge_straddling(tables, impacts, arithmetic, binary):
    """The tally, with a count of the grazes that the arithmetic does not tell from impacts or misses."""
    rows, tally = judge_scene(tables, binary, impacts, DIGITS, arithmetic, STRADDLING_BITS)
    tally["untold grazes"] = sum(row["event"] == "graze" for row in rows)
    if arithmetic == "auto":
        tally["by auto"], tally["undecided by auto"] = 1, tally["undecided"]
    return tally, ""


def in_words(outcome, tally):
    """The counts in words."""
    found = ", ".join(f"{tally[kind]} {kind}" for kind in ("impacts", "rests", "grazes") if tally[kind])
    return f"{outcome}: {found or 'as it must be'}; {tally['spoiled']} spoiled copies were refused"


def judge_one_corner(corner, binary):
    """The tally, and what was found in words."""
    tally = judge_corner(corner, binary)
    return tally, in_words(corner.outcome, tally)


def deep_enough(corners, depths):
    """Corner cases; of those that are near something by 10^-k the ones with these k, or all."""
    near = lambda corner: re.search(r" by 1e-(\d+)", corner.name)
    return [corner for corner in corners if depths is None or not (found := near(corner)) or int(found[1]) in depths]


def several_jobs(amount):
    """Random scenes with several harmonics, and corner cases."""
    yield from scene_jobs(SEVERAL, random_scenes("several", amount.several), amount.several_impacts)
    for corner in deep_enough(several_corners(), amount.depths):
        yield Job(SEVERAL, corner.name, judge_one_corner, (corner,), toml(corner.tables))
    for corner in untold_corners():
        yield Job(SEVERAL, corner.name, judge_one_untold, (corner,), toml(corner.tables))


def judge_one_untold(corner, binary):
    """The tally, and what was found in words."""
    tally = judge_untold(corner, binary)
    return tally, in_words("undecided" if tally["undecided"] else corner.outcome, tally)


def judge_one_interval(scene, binary):
    """The tally; nothing more to say."""
    return judge_interval_scene(scene, binary, INTERVAL_IMPACTS), ""


def shadowed_jobs(impacts):
    """Chaotic scenes from their start on, and after impacts that are proved by precision."""
    for name, text, near in chaotic_scenes():
        for count, splice, within in ((impacts, 0, "1e-9"), (*SPLICED, near)):
            yield Job(SHADOWED, f"{name}, {count} impacts, splice {splice}", judge_shadow, (text, count, splice, within), text)


def horseshoe_jobs(few):
    """The shortest horseshoe of figure 14."""
    with open(FIGURES[2], encoding="utf-8") as file:
        text = file.read()
    yield Job(HORSESHOES, "figure-14, depth 3", judge_chaos, (text, "docs/bases-figure-14.json", 3, few), text)


def tangency_jobs(few):
    """That beside figure 14."""
    with open(FIGURES[2], encoding="utf-8") as file:
        text = file.read()
    yield Job(TANGENCIES, "beside figure 14", judge_document, ("docs/tangency-figure-14.json", few), text)


def jobs(amount, seed, parts):
    """All jobs of the requested parts."""
    found = list(figure_jobs(amount))
    found += scene_jobs("resting scenes", random_scenes("resting", amount.resting), amount.resting_impacts)
    found += scene_jobs("extreme scenes", random_scenes("extreme", amount.extremes), amount.extreme_impacts)
    found += [
        Job("corner cases", corner.name, judge_one_corner, (corner,), toml(corner.tables))
        for corner in deep_enough(corners(), amount.depths)
    ]
    found += several_jobs(amount)
    found += straddling_jobs(amount.straddling)
    found += [
        Job("interval scenes", scene.name, judge_one_interval, (scene,), toml(scene.tables))
        for scene in interval_scenes(amount.intervals, seed)
    ]
    found += shadowed_jobs(amount.shadowed)
    found += horseshoe_jobs(amount.depths is not None)
    found += tangency_jobs(amount.depths is not None)
    return [job for job in found if not parts or job.part in parts]
