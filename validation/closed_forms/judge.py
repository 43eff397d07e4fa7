"""Judges a run of the program against a two-impact orbit: all impacts enclosed, or the earlier contact found."""
from mpmath import pi

from program import OTHER, Disagreement, run, scene
from two_impact import TINY, evaluate

IMPACTS = 8
MAPPING = {("left", "right"): "P2", ("right", "left"): "P1", ("left", "left"): "P4", ("right", "right"): "P3"}


def check_inside(name, bounds, value):
    """The bounds hold the value, but for what its 50 digits leave uncertain."""
    slack = TINY * (1 + abs(value))
    if not bounds[0] - slack <= value <= bounds[1] + slack:
        raise Disagreement(f"{name}: {value} is not in [{bounds[0]}, {bounds[1]}]")


def check_event(event, kind, mapping, wall, time, velocity):
    """One event; the velocity may be None."""
    found = (event.kind, event.mapping, event.wall)
    if found != (kind, mapping, wall):
        raise Disagreement(f"found {found}, expected {(kind, mapping, wall)}")
    check_inside(f"time on the {wall} wall", event.time, time)
    if velocity is not None:
        check_inside(f"velocity on the {wall} wall", event.velocity, velocity)


def check_impacts(found, orbit, wall="left", time="0", count=IMPACTS):
    """All impacts are those of the closed form: how many enclosures hold."""
    goes_on = found.outcome in ("impacts-reached", "attracted")
    if not found.certified or not goes_on or len(found.events) != count:
        raise Disagreement(f"{len(found.events)} events of {count}, outcome {found.outcome}")
    start, sign, here = evaluate(time), 1 if wall == "left" else -1, wall
    for event, impact in zip(found.events, orbit.impacts(count)):
        there = OTHER[here]
        check_event(event, "impact", MAPPING[here, there], there, start + impact.time, sign * impact.velocity)
        here = there
    return 2 * count


def check_earlier(found, orbit, earlier, wall="left", time="0"):
    """The contact before the impact of the closed form is found where theory says: how many enclosures hold."""
    start, sign = evaluate(time), 1 if wall == "left" else -1
    before = list(orbit.impacts(earlier.flight))
    if earlier.wall == "rest":
        check_event(found.events[0], "rest", None, wall, start, None)
        return 1
    here = wall
    for event, impact in zip(found.events, before):
        there = OTHER[here]
        check_event(event, "impact", MAPPING[here, there], there, start + impact.time, sign * impact.velocity)
        here = there
    there = here if earlier.wall == "near" else OTHER[here]
    when = start + (before[-1].time if before else 0) + earlier.phase / orbit.W
    check_event(found.events[earlier.flight], "impact", MAPPING[here, there], there, when, None)
    return 1 + 2 * len(before)


def check_half_map(found, orbit):
    """(t + N pi/W, y -> -y): each event, so much earlier and mirrored, meets the one before it (equispaced, odd N)."""
    shift = orbit.N * pi / orbit.W
    for before, after in zip(found.events, found.events[1:]):
        check_meet("time", before.time, (after.time[0] - shift, after.time[1] - shift))
        check_meet("velocity", before.velocity, (-after.velocity[1], -after.velocity[0]))
    return len(found.events) - 1


def check_meet(name, first, second):
    slack = TINY * (1 + abs(first[0]))
    if first[1] + slack < second[0] or second[1] + slack < first[0]:
        raise Disagreement(f"half-map symmetry: the {name} in {first} and in {second}")


def check_mirrored_runs(binary, orbit, factor, impacts):
    """The same symmetry for any motion, N odd: start on the other wall, N pi/W later, -v, the same excitation."""
    one = run(binary, scene(orbit, factor=factor), impacts, 15)
    two = run(binary, scene(orbit, "right", f"{orbit.N}*pi/({orbit.texts['frequency']})", factor), impacts, 15)
    shift = orbit.N * pi / orbit.W
    if (one.outcome, len(one.events)) != (two.outcome, len(two.events)):
        raise Disagreement("half-map symmetry: another outcome or number of events")
    for first, second in zip(one.events, two.events):
        if (first.kind, first.wall) != (second.kind, OTHER[second.wall]):
            raise Disagreement("half-map symmetry: another event")
        check_meet("time", first.time, (second.time[0] - shift, second.time[1] - shift))
        if first.velocity:
            check_meet("velocity", first.velocity, (-second.velocity[1], -second.velocity[0]))
    return len(one.events)


def must_refuse(name, check, *arguments):
    """A negative control: the check raises, or the comparison means nothing."""
    try:
        check(*arguments)
    except Disagreement:
        return 1
    raise Disagreement(f"negative control: {name} was not refused")
