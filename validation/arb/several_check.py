"""Judges scenes with several harmonics that are written in more than one way, and corner cases no precision tells."""
from collections import Counter

from compare import Disagreement
from corner_check import check_events, check_spoiled, graze_proof
from corners import GOES_ON, GRAZES
from judging import judge_scene
from listing import check_order, judge, judge_period
from mirror import check_overlap
from program import listing
from random_scenes import toml
from scene import Scene
from timeline import Timeline

IMPACTS, DIGITS = 100, 9


def judge_written(motion, binary):
    """A Counter: each way to write the motion lists the same, proved by the legs of the first; another does not."""
    rows, tally = judge_scene(motion.tables, binary, IMPACTS, DIGITS, "auto")
    if tally["beyond"] or tally["undecided"]:
        raise Disagreement("not proved to the end")
    timeline = Timeline(Scene(motion.tables), DIGITS)
    for number, tables in enumerate(motion.others, 1):
        try:
            judge_same(rows, timeline, *ask(binary, tables))
        except Disagreement as error:
            raise Disagreement(f"written in another way, {number}: {error}\n{toml(tables)}") from None
    try:
        judge_same(rows, timeline, *ask(binary, motion.another))
    except Disagreement:
        return tally + Counter(written=len(motion.others), spoiled=1)
    raise Disagreement(f"negative control: another motion was not refused\n{toml(motion.another)}")


def ask(binary, tables):
    """The program's listing of the scene."""
    return listing(binary, toml(tables), ["--impacts", str(IMPACTS), "--digits", str(DIGITS)])


def judge_same(rows, timeline, others, outcome):
    """The rows of another way to write the motion are proved by its legs, and are the same events."""
    check_order(others)
    judge_period(judge(others, timeline), outcome)
    if len(others) != len(rows):
        raise Disagreement(f"{len(others)} events, expected {len(rows)}")
    check_overlap(rows, others)


def judge_untold(corner, binary):
    """A Counter: the listing is what is known of the corner, or stops, undecided, with nothing wrong before."""
    arguments = ["--impacts", str(corner.impacts), "--digits", str(corner.digits), "--max-bits", str(corner.max_bits)]
    rows, outcome = listing(binary, toml(corner.tables), arguments)
    if outcome["kind"] == "undecided":
        known = corner._replace(outcome="undecided", events=corner.events[: len(rows)])
    else:
        known = corner
    check_events(known, rows, outcome["kind"])
    tally = Counter(scenes=1, events=len(known.events))
    if known is corner and corner.proof == GRAZES:
        tally += graze_proof(corner, rows, binary)
    tally["spoiled"] += check_spoiled(known, rows, outcome["kind"])
    tally["undecided" if known is not corner else GOES_ON] += 1
    return tally
