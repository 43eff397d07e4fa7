"""Judges `run --arithmetic shadow`: a start within the document's bounds whose proved orbit lies in all of its boxes.

The document says that there is such a start, not which. It is found from the middles of the boxes: Newton's iteration for
all impacts at once, by eq. (A.7), makes them an orbit whose last time stays. What it finds needs no proof: the orbit of
that start, rounded to a decimal, is proved from its first impact on (`orbit.py`).
"""
import json
import tomllib
from collections import Counter
from fractions import Fraction
from pathlib import Path
from statistics import median

from flint import arb, ctx

from compare import Disagreement, bounds, judge_row
from corners import scene as tables_of
from expression import evaluate
from flight import Undecided
from orbit import FIRST_COARSE_BITS, leave, orbit
from program import as_row, run
from recorded import toml
from scene import LEFT, RIGHT, Scene
from simulate import decimal_below, exact

# Digits of the proved orbits, many more than those of the boxes.
DIGITS = 30
# Bits of the search: these, and one for each impact, of which the motions here lose 0.2 to 0.7.
SEARCH_BITS, MOST_SWEEPS = 200, 12
# Impacts of the given start that are compared, in all or after those of a splice: it leaves the boxes before.
OWN = 100
# So many impacts, the first ones, are spoiled.
SPOILED = 60
PLACES = 60


def chaotic_scenes():
    """(name, text, how near 200 impacts by precision bring the start at least); figure 16 expands by the least."""
    for number, near in ((14, "1e-30"), (16, "1e-20"), (17, "1e-30")):
        path = Path(f"scenes/figure-{number}.toml")
        yield path.stem, path.read_text(encoding="utf-8"), near
    overtone = tables_of(["8", "1"], ["pi", "3*pi"], ["0", "1"], "9.42497", "0.5", wall=LEFT, velocity="-12.56636")
    yield "figure 14 with an overtone", toml(overtone), "1e-30"


def document_of(binary, text, impacts, splice):
    """The JSON document that the program under test prints."""
    arguments = ["--impacts", str(impacts), "--arithmetic", "shadow", "--splice", str(splice)]
    return json.loads("\n".join(run(binary, text, arguments, "json")))


def middle(row, name):
    """The middle of the printed bounds, exact up to rounding."""
    twice = sum(bounds(row, name))
    return (arb(twice.numerator) / (2 * twice.denominator)).mid()


def is_of_times(scene):
    """True if it is the time of the start that is moved: no velocity is left after the impact."""
    _, _, _, velocity = scene.start()
    return scene.motion().restitution * velocity == 0


def linked(motion, rough, state, wall):
    """F(state) and (A.7) there, if the first contact is on the wall."""
    with ctx.workprec(FIRST_COARSE_BITS):
        found, bracket = leave(rough, *state).first_contact()
    if found != wall:
        raise Undecided(f"it lands on the {found} wall")
    flight = leave(motion, *state)
    time, velocity = flight.land(found, bracket)
    return (time.mid(), velocity.mid()), flight.jacobian(time - state[1])


def sweep(motion, rough, states, moves_time):
    """(states, how far they moved in periods and A W): one step of Newton's iteration for x_k+1 = F(x_k).

    Each move is growth s + error with one s, the move of the start in its time or its velocity: the last time stays.
    """
    growth, error = (arb(1), arb(0)) if moves_time else (arb(0), arb(1)), (arb(0), arb(0))
    moves = [(growth, error)]
    for number, (state, after) in enumerate(zip(states, states[1:]), 1):
        try:
            landing, jacobian = linked(motion, rough, state, after[0])
        except Undecided as reason:
            raise Disagreement(f"impact {number} from the middle of the box before it: {reason}") from None
        defect = landing[0] - after[1], landing[1] - after[2]
        growth = tuple((p * growth[0] + q * growth[1]).mid() for p, q in jacobian)
        error = tuple((p * error[0] + q * error[1] + add).mid() for (p, q), add in zip(jacobian, defect))
        moves.append((growth, error))
    along, units, farthest = -(error[0] / growth[0]).mid(), (motion.period(), motion.speed()), arb(0)
    moved = []
    for (wall, *state), (growth, error) in zip(states, moves):
        by = [(g * along + b).mid() for g, b in zip(growth, error)]
        moved.append((wall, *((x + step).mid() for x, step in zip(state, by))))
        farthest = max(farthest, *(abs(step / unit).mid() for step, unit in zip(by, units)))
    return moved, farthest


def refined(scene, rows):
    """The start, a time or a velocity as a decimal, whose orbit follows the rows for as long as there are any."""
    bits = SEARCH_BITS + len(rows)
    with ctx.workprec(bits):
        motion = scene.motion()
        with ctx.workprec(FIRST_COARSE_BITS):
            rough = scene.motion()
        wall, time, _, velocity = scene.start()
        states = [(wall, time.mid(), velocity.mid())]
        states += [(row["wall"], middle(row, "time"), middle(row, "velocity")) for row in rows]
        for _ in range(MOST_SWEEPS):
            states, farthest = sweep(motion, rough, states, is_of_times(scene))
            # The next step is about the square of this step: less than the precision.
            if farthest < arb(2) ** (-bits // 2):
                return decimal_below(exact(states[0][1 if is_of_times(scene) else 2]), bits)
    raise Disagreement(f"no orbit is near: the middles still move by {farthest.str(3)}")


def start_bounds(scene, start):
    """(name, lower, upper) of what is moved of the start; the other is exactly the scene's own."""
    moved, fixed = ("time", "velocity") if is_of_times(scene) else ("velocity", "time")
    own = {name: Fraction(str(evaluate(str(scene.text("start", name))))) for name in start}
    lower, upper = map(Fraction, start[moved])
    if [Fraction(text) for text in start[fixed]] != 2 * [own[fixed]] or not lower <= own[moved] <= upper:
        raise Disagreement(f"the start {start} is not one near the scene's own in its {moved} only")
    return moved, lower, upper


def kept_in(rows, impacts):
    """Number of impacts in their boxes before the first that is not: same wall, all of both balls in the bounds."""
    for number, (row, impact) in enumerate(zip(rows, impacts)):
        try:
            if judge_row(row, impact) < 2:
                return number
        except Disagreement:
            return number
    return min(len(rows), len(impacts))


def check_epsilon(scene, epsilon, rows, impacts):
    """Refuses a greatest or median distance, in forcing periods, that the times do not keep to, measured from the boxes' middles."""
    period = exact(scene.motion().period().mid())
    far = [abs(sum(bounds(row, "time")) / 2 - exact(impact.time.mid())) / period for row, impact in zip(rows, impacts)]
    if max(far) > Fraction(epsilon["maximum"]) or median(far) > Fraction(epsilon["median"]):
        raise Disagreement(f"in turns {float(max(far)):.2e} and {float(median(far)):.2e} off, listed are {epsilon}")


def judge_document(scene, document):
    """The proved impacts of a start within the document's bounds, if all of them lie in its boxes."""
    said, outcome = (document["certified"], document["claim"], document["outcome"]["kind"]), document["outcome"]
    if said != (True, "shadowed", "impacts-reached"):
        raise Disagreement(f"the document says {said}")
    moved, lower, upper = start_bounds(scene, outcome["start"])
    rows = [as_row(event) for event in document["events"]]
    start = refined(scene, rows)
    if not lower <= Fraction(start) <= upper:
        raise Disagreement(f"an orbit near the boxes starts with the {moved} {float(Fraction(start))!r}: not in the bounds")
    impacts, _ = orbit(Scene(scene.tables | {"start": scene.tables["start"] | {moved: start}}), len(rows), DIGITS)
    kept = kept_in(rows, impacts)
    if kept < len(rows):
        raise Disagreement(f"impact {kept + 1} is not in its box")
    check_epsilon(scene, outcome["epsilon"], rows, impacts)
    return impacts


def past(texts):
    """The bounds moved by their width."""
    lower, upper = map(Fraction, texts)
    return [texts[1], decimal_below(2 * upper - lower, PLACES)]


def spoiled(scene, document):
    """(name, copy) pairs; of the events the middle one is spoiled, or all."""
    events, outcome = document["events"], document["outcome"]
    at, event = len(events) // 2, document["events"][len(events) // 2]

    def changed(values):
        return document | {"events": events[:at] + [event | values] + events[at + 1 :]}

    yield "the other wall", changed({"wall": {LEFT: RIGHT, RIGHT: LEFT}[event["wall"]]})
    yield "another mapping", changed({"mapping": "P1" if event["mapping"] != "P1" else "P3"})
    left_out = [kept | {"index": number} for number, kept in enumerate(events[:at] + events[at + 1 :], 1)]
    yield "an impact left out, the rest numbered anew", document | {"events": left_out}
    for name in ("time", "velocity"):
        yield f"one {name} moved by its width", changed({name: past(event[name])})
        yield f"all bounds of the {name} moved by their width", document | {
            "events": [each | {name: past(each[name])} for each in events]
        }
    moved, _, _ = start_bounds(scene, outcome["start"])
    own = str(scene.text("start", moved))
    yield "the scene's own start", document | {"outcome": outcome | {"start": outcome["start"] | {moved: [own, own]}}}
    for which in ("median", "maximum"):
        epsilon = outcome["epsilon"] | {which: "0"}
        yield f"a {which} of the distance that is not true", document | {"outcome": outcome | {"epsilon": epsilon}}
    yield "the claim of the exact start", document | {"claim": "exact start"}


def check_spoiled(scene, document):
    """Number of corrupted copies of the first impacts refused; all must be, and those as they are must not."""
    begin = document | {"events": document["events"][:SPOILED]}
    judge_document(scene, begin)
    count = 0
    for name, copy in spoiled(scene, begin):
        try:
            judge_document(scene, copy)
        except Disagreement:
            count += 1
        else:
            raise Disagreement(f"negative control: a copy with {name} was not refused")
    return count


def check_own(scene, document, splice):
    """Number of impacts of the given start itself in the boxes: those before the last of the splice, and not all."""
    rows = [as_row(event) for event in document["events"][: splice + OWN]]
    impacts, _ = orbit(scene, len(rows), DIGITS)
    kept = kept_in(rows, impacts)
    if not splice - 1 <= kept < len(rows):
        raise Disagreement(f"{kept} of {len(rows)} impacts of the given start are in their boxes")
    return kept


def judge_shadow(text, impacts, splice, near, binary):
    """(tally, remark) of a scene; its start must be known within `near`."""
    scene = Scene(tomllib.loads(text, parse_float=str))
    document = document_of(binary, text, impacts, splice)
    judged = judge_document(scene, document)
    if len(judged) != impacts:
        raise Disagreement(f"{len(judged)} impacts")
    moved, lower, upper = start_bounds(scene, document["outcome"]["start"])
    if not upper - lower < Fraction(near):
        raise Disagreement(f"the {moved} of the start is only known within {float(upper - lower):.1e}")
    own = check_own(scene, document, splice)
    # The first impacts of a splice are those of many starts, farther away: what is cut after them says nothing of its start.
    count = 0 if splice else check_spoiled(scene, document)
    tally = Counter(scenes=1, impacts=impacts, enclosures=2 * impacts, held=2 * impacts, spoiled=count)
    tally["impacts-reached"] = 1
    return tally, (
        f"{impacts} impacts of a start in the bounds, whose {moved} is known within {float(upper - lower):.1e}, are in their "
        f"boxes; the given start leaves them after {own}; {count} spoiled copies were refused"
    )
