"""Judges one scene: its listing event by event against the proved legs, its outcome, its mirror image, spoiled copies.

Each listing is judged against `timeline.py`, the mirror image must list the same, the outcome must be what the rows
show, and spoiled copies of the rows must be refused.
"""
import tomllib
from collections import Counter

from flint import ctx

from compare import Disagreement
from flight import Flight, TooLong
from listing import chatter_limit, check_order, check_widths, judge, judge_period
from mirror import check_overlap, mirror, reflected
from orbit import FIRST_BITS
from program import listing
from recorded import toml
from rest_controls import check_first_controls, check_rest_controls
from scene import Scene
from simulate import exact
from timeline import Timeline
from untold import merged

# Number of periods for which a motion that is claimed never to touch a wall is followed.
NEVER = 100
# A velocity of 10^-60 in 256 bits is distinguished from its neighbours.
STRADDLING_DIGITS = 140


def check_outcome(verdict, outcome, rows, impacts):
    """The outcome is what the rows show."""
    judge_period(verdict, outcome)
    listed = sum(row["event"] == "impact" for row in rows)
    if outcome["kind"] in ("impacts-reached", "periodic", "attracted") and listed != impacts:
        raise Disagreement(f"{outcome['kind']} with {listed} impacts of {impacts}")
    if outcome["kind"] not in ("impacts-reached", "periodic", "attracted", "undecided"):
        raise Disagreement(f"unexpected outcome {outcome['kind']!r}")


def check_never(scene, rows):
    """Nothing is listed, and there is no contact as far as the flight is followed."""
    with ctx.workprec(FIRST_BITS):
        wall, time, height, velocity = scene.start()
        try:
            if rows or wall is not None:
                raise Disagreement("a motion that never touches a wall, but was on one")
            wall, _ = Flight(scene.motion(), None, time, height, velocity).first_contact(NEVER)
        except TooLong:
            return
    raise Disagreement(f"a motion that never touches a wall, proved to touch the {wall} one")


def judge_scene(tables, binary, impacts, digits, arithmetic, max_bits=None):
    """(rows, tally): what the program lists of a scene, and a Counter of what was found to agree.

    With `max_bits`, bits may not tell whether a wall is touched, or that a chatter ends: what is listed after such a
    graze, or of such a chatter, is judged, too.
    """
    arguments = ["--impacts", str(impacts), "--digits", str(digits), "--arithmetic", arithmetic]
    arguments += ["--max-bits", str(max_bits)] if max_bits else []
    scene, is_auto = Scene(tomllib.loads(toml(tables))), arithmetic == "auto"
    timeline = Timeline(scene, digits, STRADDLING_DIGITS, True) if max_bits else Timeline(scene, digits)

    def check(rows):
        check_order(rows)
        return judge(merged(rows, timeline) if max_bits else rows, timeline, is_auto and not max_bits)

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
    if max_bits:
        tally["spoiled"] += check_first_controls(rows, exact(scene.motion().period().mid()), check, Disagreement)
    cycle, limit = exact(scene.motion().period().mid()), chatter_limit(scene, digits)
    tally["spoiled"] += check_rest_controls(rows, cycle, limit, check, Disagreement) + spoil(outcome, verdict)
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
    """Number of wrong periods refused; all must be, and so must silence where the period has to be told."""
    wrong = {key: outcome | {"period": outcome["period"] | {key: value + 1}} for key, value in outcome.get("period", {}).items()}
    if wrong and not verdict.releases[0].origin.timeline.scene.has_roots():
        wrong["cycles and no word"] = {"kind": "impacts-reached"}
    for key, copy in wrong.items():
        try:
            judge_period(verdict, copy)
        except Disagreement:
            continue
        raise Disagreement(f"negative control: a wrong number of {key} was not refused")
    return len(wrong)
