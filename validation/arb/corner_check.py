"""Judges a corner case: its first events, its outcome, the proof of the rest; and spoiled copies, all to be refused."""
from collections import Counter
from fractions import Fraction

from flint import arb, ctx, fmpq

from compare import Disagreement, bounds
from corners import GOES_ON, GRAZES, NEVER, ORBIT, STILL
from flight import Flight
from judging import check_never, judge_scene
from listing import judge
from program import listing
from recorded import toml
from scene import LEFT, Scene
from timeline import Timeline

# Bits to evaluate a touch with, and how far from one it may seem to be.
BITS, TOUCH = 400, "1e-90"


def judge_corner(corner, binary):
    """A Counter of what was found to agree; raises Disagreement."""
    arguments = ["--impacts", str(corner.impacts), "--digits", str(corner.digits), "--max-bits", str(corner.max_bits)]
    rows, outcome = listing(binary, toml(corner.tables), arguments)
    check_events(corner, rows, outcome["kind"])
    tally = PROOFS[corner.proof](corner, rows, binary)
    if corner.further:
        corner.further(rows, corner.tables)
    tally["scenes"], tally[outcome["kind"]], tally["events"] = 1, 1, len(corner.events)
    tally["spoiled"] += check_spoiled(corner, rows, outcome["kind"])
    return tally


def check_events(corner, rows, kind):
    """The listing begins and the outcome is as it must be."""
    # Of what the motion tends to nothing is expected here.
    if (GOES_ON if kind == "attracted" else kind) != corner.outcome:
        raise Disagreement(f"the outcome is {kind!r}, expected {corner.outcome!r}")
    if len(rows) < len(corner.events):
        raise Disagreement(f"{len(rows)} events, expected {len(corner.events)} at least")
    for number, (row, event) in enumerate(zip(rows, corner.events), 1):
        lower, upper = bounds(row, "time")
        is_exact = event.low == event.high
        is_there = lower <= event.low <= upper if is_exact else event.low <= lower and upper <= event.high
        if (row["event"], row["wall"]) != (event.kind, event.wall) or not is_there:
            found = f"{row['event']} {row['wall']} in [{float(lower)!r}, {float(upper)!r}]"
            raise Disagreement(f"event {number}: {found}, expected {event.kind} {event.wall} at {float(event.low)!r}")


def orbit_proof(corner, rows, binary):
    """All of the listing is proved by the simulator, and so is that of the mirror image."""
    _, tally = judge_scene(corner.tables, binary, corner.impacts, corner.digits, "auto")
    if tally["beyond"] or tally["undecided"]:
        raise Disagreement("not proved to the end by the simulator")
    return tally


def graze_proof(corner, rows, _):
    """Each graze is a touch of the first flight, and what follows is proved from a state after it."""
    grazes = [row for row in rows if row["event"] == "graze"]
    for event in corner.events[: len(grazes)]:
        check_touch(Scene(corner.tables), event.wall, event.low)
    tally = Counter(grazes=len(grazes))
    if corner.later is None:
        if not len(grazes) == len(rows) == len(corner.events):
            raise Disagreement("something else than the expected grazes, though there is no drift")
        return tally
    # The first impact after the graze may have a mapping here, and none from a start inside.
    rest = [rows[1] | {"mapping": ""}, *rows[2:]]
    verdict = judge(rest, Timeline(Scene(corner.later), corner.digits))
    if verdict.proved_end is not None or verdict.impacts != corner.impacts or len(grazes) != 1:
        raise Disagreement(f"after the graze only {verdict.impacts} impacts are proved")
    tally.update(impacts=verdict.impacts, held=verdict.held, enclosures=2 * verdict.impacts + verdict.rests)
    return tally


def check_touch(scene, wall, time):
    """From (11), (12): at this time the ball is at the wall, without velocity, and its acceleration is off the wall."""
    with ctx.workprec(BITS):
        start_wall, start, height, velocity = scene.start()
        motion = scene.motion()
        u = velocity if start_wall is None else -motion.restitution * velocity
        flight = Flight(motion, start_wall, start, height, u)
        z, z1, z2 = flight.derivatives(arb(fmpq(time.numerator, time.denominator)) - start)
        off = z2 if wall == LEFT else -z2
        if not (abs(z - flight.level(wall)) < arb(TOUCH) and abs(z1) < arb(TOUCH) and off > 0):
            raise Disagreement(f"no graze at {time}: z = {z.str(20)}, z' = {z1.str(20)}")


def still_proof(corner, rows, _):
    """The expected events are all there are."""
    if len(rows) != len(corner.events):
        raise Disagreement(f"{len(rows)} events, expected {len(corner.events)}")
    return Counter()


def never_proof(corner, rows, _):
    """Nothing is listed, and no contact is found."""
    check_never(Scene(corner.tables), rows)
    return Counter()


PROOFS = {ORBIT: orbit_proof, GRAZES: graze_proof, STILL: still_proof, NEVER: never_proof}


def spoiled(corner, rows, kind):
    """(name, rows, outcome) that must be refused."""
    yield "another outcome", rows, "undecided" if kind != "undecided" else "impacts-reached"
    for number in range(len(corner.events)):
        row, event = rows[number], corner.events[number]
        lower, upper = bounds(row, "time")
        step = upper - lower + event.high - event.low + Fraction(1, 10**60)

        def changed(**values):
            return rows[:number] + [row | values] + rows[number + 1 :]

        yield f"event {number + 1} on the other wall", changed(wall="right" if row["wall"] == LEFT else LEFT), kind
        another = "impact" if row["event"] != "impact" else "graze"
        yield f"event {number + 1} of another kind", changed(event=another), kind
        for sign, word in ((1, "later"), (-1, "earlier")):
            times = {"time_lower": exact_text(lower + sign * step), "time_upper": exact_text(upper + sign * step)}
            yield f"event {number + 1} {word}", changed(**times), kind


def exact_text(value):
    """A fraction with a denominator 2^a 5^b as a decimal, or the nearest one with 80 places."""
    return f"{round(value * 10**80)}e-80"


def check_spoiled(corner, rows, kind):
    """Number of corrupted copies refused; all must be."""
    count = 0
    for name, copy, outcome in spoiled(corner, rows, kind):
        try:
            check_events(corner, copy, outcome)
        except Disagreement:
            count += 1
        else:
            raise Disagreement(f"negative control: a copy with {name} was not refused")
    return count
