#!/usr/bin/env python3
"""Judges listings of `impact-pair run` with chatter, rests and releases: anchors, random scenes, their mirror images.

Each listing is judged event by event against the proved legs of `timeline.py`, its outcome against what it shows, and
spoiled copies of it must be refused. At the first disagreement the scene is printed, and the exit code is 1.

Run: rests.py [--scenes N] [--seed S] [--impacts N] [--binary PATH] [--show]
"""
import argparse
import sys
import tomllib
from collections import Counter

from flint import ctx

from anchors import ANCHORS, ANCHOR_DIGITS, EDGES, check_anchor
from compare import Disagreement
from flight import Flight, Undecided
from listing import chatter_limit, check_order, check_widths, judge, judge_period
from mirror import check_overlap, mirror, reflected
from orbit import FIRST_BITS
from program import listing
from random_scenes import is_calm, ratio, scenes, toml
from rest_controls import check_rest_controls
from scene import Scene
from simulate import exact
from timeline import Timeline

# Of the scenes with small e or small A/d, so many must come to rest, or the scenes are badly drawn.
RESTING = 0.6
# So many may end before all was compared: undecided, in doubles above all, or at an exact graze.
CUT_SHORT = 0.2
ENOUGH = 10
# A motion that is said never to touch a wall is followed for so many periods.
NEVER = 100


def check_outcome(verdict, outcome, rows, impacts):
    """The outcome is what the rows show."""
    judge_period(verdict, outcome)
    listed = sum(row["event"] == "impact" for row in rows)
    if outcome["kind"] in ("impacts-reached", "periodic") and listed != impacts:
        raise Disagreement(f"{outcome['kind']} with {listed} impacts of {impacts}")
    if outcome["kind"] not in ("impacts-reached", "periodic", "undecided"):
        raise Disagreement(f"unexpected outcome {outcome['kind']!r}")


def check_never(scene, rows):
    """Nothing is listed, and there is no contact as far as the flight is followed."""
    with ctx.workprec(FIRST_BITS):
        wall, time, height, velocity = scene.start()
        try:
            if rows or wall is not None:
                raise Disagreement("a motion that never touches a wall, but was on one")
            wall, _ = Flight(scene.motion(), None, time, height, velocity).first_contact(NEVER)
        except Undecided:
            return
    raise Disagreement(f"a motion that never touches a wall, proved to touch the {wall} one")


def judge_scene(tables, binary, impacts, digits, arithmetic):
    """(rows, tally): what the program lists of a scene, and a Counter of what was found to agree."""
    arguments = ["--impacts", str(impacts), "--digits", str(digits), "--arithmetic", arithmetic]
    scene, is_auto = Scene(tomllib.loads(toml(tables))), arithmetic == "auto"
    timeline = Timeline(scene, digits)

    def check(rows):
        check_order(rows)
        return judge(rows, timeline, is_auto)

    rows, outcome = listing(binary, toml(tables), arguments)
    verdict = check(rows)
    if is_auto:
        check_widths(rows, scene, digits)
    judge_mirror(tables, binary, arguments, check, rows, outcome if is_auto else None)
    tally = Counter(scenes=1, impacts=verdict.impacts, rests=verdict.rests, releases=len(verdict.releases))
    tally.update(held=verdict.held, enclosures=2 * verdict.impacts + verdict.rests, resting=verdict.rests > 0)
    tally[outcome["kind"]] += 1
    if outcome["kind"] == "never-impacts":
        check_never(scene, rows)
    if verdict.proved_end is not None or outcome["kind"] == "never-impacts":
        tally["beyond"] += 1
        return rows, tally
    check_outcome(verdict, outcome, rows, impacts)
    cycle, limit = exact(scene.motion().period().mid()), chatter_limit(scene, digits)
    tally["spoiled"] = check_rest_controls(rows, cycle, limit, check, Disagreement) + spoil(outcome, verdict)
    return rows, tally


def judge_mirror(tables, binary, arguments, check, rows, outcome):
    """The same for the mirror image, which must list the same, and have the same outcome if one is given."""
    others, other = listing(binary, toml(mirror(tables)), arguments)
    others = list(reflected(others))
    try:
        check(others)
        check_overlap(rows, others)
        if outcome and any(outcome.get(key) != other.get(key) for key in ("kind", "period")):
            raise Disagreement(f"the outcome is {other}, expected {outcome}")
    except Disagreement as error:
        raise Disagreement(f"mirror image: {error}") from None


def spoil(outcome, verdict):
    """How many wrong periods were refused; all must be."""
    refused = 0
    for key, value in outcome.get("period", {}).items():
        try:
            judge_period(verdict, outcome | {"period": outcome["period"] | {key: value + 1}})
        except Disagreement:
            refused += 1
        else:
            raise Disagreement(f"negative control: a wrong number of {key} was not refused")
    return refused


def way(number):
    """(digits, arithmetic) for a scene: mostly nine digits, now and then more, fewer, or doubles."""
    return {3: (25, "auto"), 5: (2, "auto"), 7: (9, "interval")}.get(number % 10, (9, "auto"))


def cases(asked):
    """(name, tables, digits, arithmetic, further check) of all that is to be judged."""
    for name, tables in ANCHORS.items():
        yield name, tables, ANCHOR_DIGITS, "auto", check_anchor
    for name, tables in EDGES.items():
        yield name, tables, 9, "auto", None
    for number, tables in enumerate(scenes(asked.scenes, asked.seed)):
        name = f"scene {number} of seed {asked.seed}: e = {tables['pair']['restitution']}, A/d = {ratio(tables)}"
        yield name, tables, *way(number), None


def judge_all(asked):
    """The sum of the tallies; prints the scene and raises at the first disagreement."""
    total = Counter()
    for name, tables, digits, arithmetic, further in cases(asked):
        try:
            rows, tally = judge_scene(tables, asked.binary, asked.impacts, digits, arithmetic)
            if further:
                further(rows, tables)
        except Disagreement as error:
            print(toml(tables))
            raise Disagreement(f"{name}; --digits {digits} --arithmetic {arithmetic}: {error}") from None
        if is_calm(tables):
            tally.update(calm=1, calm_resting=tally["resting"])
        if asked.show:
            print(f"{name}: {dict(tally)}", flush=True)
        total += tally
    check_shares(total)
    return total


def check_shares(total):
    """Refuses a comparison that has compared too little to mean anything."""
    if total["calm"] >= ENOUGH and total["calm_resting"] < RESTING * total["calm"]:
        raise Disagreement(f"only {total['calm_resting']} of {total['calm']} scenes of small A/d or e come to rest")
    short = total["undecided"] + total["beyond"]
    if total["scenes"] >= ENOUGH and short > CUT_SHORT * total["scenes"]:
        raise Disagreement(f"{short} of {total['scenes']} scenes are undecided or beyond this proof")


SUMMARY = """\
{scenes} scenes and their mirror images agree: {impacts} impacts, {rests} rests, {releases} releases;
{held} of {enclosures} enclosures hold the whole Arb ball.
{resting} scenes come to rest, {calm_resting} of the {calm} with e <= 0.3 or A/d < 0.1.
{periodic} are periodic, {impacts-reached} go on, {undecided} end undecided, {beyond} go beyond this proof.
{spoiled} spoiled copies are refused"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1995)
    parser.add_argument("--impacts", type=int, default=200)
    parser.add_argument("--binary", default="impact-pair", help="the program under test")
    parser.add_argument("--show", action="store_true", help="a line for each scene")
    asked = parser.parse_args()
    try:
        print(SUMMARY.format_map(judge_all(asked)))
    except Disagreement as error:
        sys.exit(f"DISAGREEMENT: {error}")


if __name__ == "__main__":
    main()
