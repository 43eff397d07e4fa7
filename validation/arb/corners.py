"""Corner cases, each with a name, what must come first in its listing, how it must end, and who proves the rest.

Most scenes have W = pi, so that a turn lasts 2, and an exact time is a fraction. A graze is a touch without velocity.
"""
from collections import namedtuple
from fractions import Fraction

from anchors import ANCHOR_DIGITS, ANCHORS, EDGES, check_anchor
from scene import LEFT, RIGHT

# The first events, with a time between low and high, or exactly at both. `proof` is ORBIT: by the simulator, event by
# event; GRAZES: all of them are touches, and `later`, a start after the graze, proves what follows; STILL: the events
# are all there is, since nothing moves by (10) or nothing can be proved; NEVER: no contact, followed for 100 periods.
ORBIT, GRAZES, STILL, NEVER = "orbit", "grazes", "still", "never"
Event = namedtuple("Event", "kind wall low high")
Corner = namedtuple(
    "Corner", "name tables outcome events proof impacts digits later further max_bits",
    defaults=(ORBIT, 12, 9, None, None, 1_000_000),
)
GOES_ON, PERIODIC = "impacts-reached", "periodic"


def hit(wall, low, high):
    """An impact between two times."""
    return Event("impact", wall, Fraction(low), Fraction(high))


def at(kind, wall, time):
    """An event at an exact time."""
    return Event(kind, wall, Fraction(time), Fraction(time))


def scene(amplitude, frequency, phase, gap, restitution, **start):
    """The tables of a scene; the start is at time 0 if nothing else is said."""
    return {
        "excitation": {"amplitude": amplitude, "frequency": frequency, "phase": phase},
        "pair": {"gap": gap, "restitution": restitution},
        "start": {"time": "0", **start},
    }


def inside_graze(depth, **start):
    """Drift pi, W = 2 pi, A = 1, d = 4: the first maximum, cos th = 1/2 at t = 5/6, is `depth` beyond the wall."""
    start = start or {"position": f"2 - sqrt(3)/2 - (5/6)*pi + ({depth})", "velocity": "-pi"}
    return scene("1", "2*pi", "0", "4", "0.5", **start)


GRAZING_GAP = "(7*pi/12 + sqrt(3)/2 + 1)"


def wall_graze(depth, **start):
    """From the left wall, u = c = pi/2, W = pi, A = 1: the maximum at t = 7/6 is `depth` gaps beyond the right wall."""
    start = start or {"wall": LEFT, "velocity": "-pi"}
    return scene("1", "pi", "pi/2", f"{GRAZING_GAP}*(1 - ({depth}))", "0.5", **start)


def near_grazes():
    """Cut by 10^-k of the gap, the contact is at most about 10^(-k/2) before the maximum; missed, a turn later."""
    for k in (3, 6, 9, 12, 15, 20, 25, 30):
        digits, reach = max(9, k // 2 + 3), Fraction(2, 10 ** (k // 2))
        for place, tables, top, low, high in [
            ("from inside the gap", inside_graze, Fraction(5, 6), "1.3", "1.4"),
            ("from the other wall", wall_graze, Fraction(7, 6), "2.2", "2.3"),
        ]:
            cut, missed = hit(RIGHT, top - reach, top), hit(RIGHT, low, high)
            size = f"4e-{k}" if tables is inside_graze else f"1e-{k}"
            yield Corner(f"cut by 1e-{k} of the gap, {place}", tables(size), GOES_ON, [cut], digits=digits)
            name = f"missed by 1e-{k} of the gap, {place}"
            yield Corner(name, tables(f"(-{size})"), GOES_ON, [missed], digits=digits)


def exact_grazes():
    """Touches without velocity, exact by construction; after the first two the ball is followed from a later state."""
    later = inside_graze(0, time="1", position="2 - sqrt(3)/2 - (5/6)*pi + pi", velocity="-pi")
    first, then = at("graze", RIGHT, "5/6"), hit(RIGHT, "1.3", "1.4")
    yield Corner("graze from inside the gap", inside_graze(0), GOES_ON, [first, then], GRAZES, later=later)
    position = f"1 + 3*pi/4 - {GRAZING_GAP}/2"
    later = wall_graze(0, time="3/2", position=position, velocity="-pi/2")
    first, then = at("graze", RIGHT, "7/6"), hit(RIGHT, "2.2", "2.3")
    yield Corner("graze from the other wall", wall_graze(0), GOES_ON, [first, then], GRAZES, later=later)
    for share in ("1/4", "1/1000"):
        for wall, phase in ((RIGHT, "-pi/2"), (LEFT, "pi/2")):
            turns = [at("graze", wall, turn) for turn in range(2, 26, 2)]
            tables = scene(share, "pi", phase, "1", "0.5", wall=wall, velocity="0")
            yield Corner(f"model II, {wall} wall, A = {share} d", tables, PERIODIC, turns, GRAZES)
    both = [at("graze", LEFT if turn % 2 else RIGHT, turn) for turn in range(1, 13)]
    tables = scene("1/2", "pi", "-pi/2", "1", "0.5", wall=RIGHT, velocity="0")
    yield Corner("model II, both walls, A = d/2", tables, PERIODIC, both, GRAZES)
    both = [event._replace(low=event.low - Fraction(1, 2), high=event.high - Fraction(1, 2)) for event in both]
    tables = scene("1", "pi", "0", "2", "0.5", position="0", velocity="-pi")
    yield Corner("grazes of both walls from inside", tables, PERIODIC, both, GRAZES)


def rests():
    """Starts at rest, at a release, chatter, dead impacts."""
    tables = scene("0.51", "pi", "-pi/2", "1", "0.5", wall=RIGHT, velocity="0")
    yield Corner("beyond model II, A = 0.51 d", tables, GOES_ON, [hit(LEFT, "0.9", "0.92")])
    for wall, phase in ((LEFT, "-pi/2"), (RIGHT, "pi/2")):
        events = [at("rest", wall, 0), at("release", wall, "1/2")]
        tables = scene("1", "pi", phase, "1", "0.5", wall=wall, velocity="0")
        yield Corner(f"at rest on the pressing {wall} wall", tables, GOES_ON, events)
        sign = "-" if wall == LEFT else ""
        tables = scene("1", "pi", phase, "1", "0.5", wall=wall, velocity=f"{sign}1e-300")
        events = [Event("rest", wall, Fraction(0), Fraction(1, 10**40)), at("release", wall, "1/2")]
        yield Corner(f"pressed on the {wall} wall with a speed of 1e-300", tables, GOES_ON, events)
    tables = scene("1", "pi", "0", "1", "0.5", wall=LEFT, velocity="0")
    yield Corner("start at the phase of release", tables, GOES_ON, [hit(RIGHT, "0.61", "0.62")])
    tables = scene("1", "pi", "0", "1", "0.5", wall=RIGHT, velocity="0")
    yield Corner("start where the press begins", tables, GOES_ON, [at("rest", RIGHT, 0), at("release", RIGHT, 1)])
    tables = scene("1", "pi", "-pi/2", "1", "0.5", position="-1/2 + 1e-30", velocity="0")
    events = [hit(LEFT, 0, "1e-15"), Event("rest", LEFT, 0, Fraction(1, 10**14))]
    yield Corner("start 1e-30 of the gap off a pressing wall", tables, GOES_ON, events + [at("release", LEFT, "1/2")])
    for name, tables in ANCHORS.items():
        outcome = PERIODIC if tables["pair"]["restitution"] == "0.3" else GOES_ON
        yield Corner(name, tables, outcome, [], impacts=200, digits=ANCHOR_DIGITS, further=check_anchor)
    for name, tables in EDGES.items():
        yield Corner(name, tables, GOES_ON, [], impacts=200)
    tables = scene("5", "pi", "0", "1", "0", wall=LEFT, velocity="-1")
    dead = [Event(kind, RIGHT, Fraction("0.34"), Fraction("0.35")) for kind in ("impact", "rest")]
    dead.append(at("release", RIGHT, 1))
    yield Corner("e = 0, periodic from the second release", tables, PERIODIC, dead, impacts=20)


def extremes():
    """e = 1, large times, nothing moving, no contact."""
    tables = scene("0.1", "pi", "0", "9", "1", wall=LEFT, velocity="-9")
    yield Corner("e = 1", tables, GOES_ON, [hit(RIGHT, "0.9", "1.1")], impacts=60)
    tables = scene("1", "1", "-1.5", "3", "1", wall=LEFT, velocity="-0.001")
    yield Corner("e = 1, pressed: no chatter ends", tables, GOES_ON, [hit(LEFT, "0.0019", "0.0021")], impacts=60)
    late = hit(RIGHT, "1000000000000000.3", "1000000000000000.31")
    tables = scene("8", "2*pi", "0", "9.42497", "0.5", time="1e15", wall=LEFT, velocity="-12.56636")
    yield Corner("start at 1e15", tables, GOES_ON, [late], impacts=60)
    still, rest = ("0", "pi", "0", "1"), at("rest", LEFT, 0)
    tables = scene(*still, "0.5", wall=LEFT, velocity="0")
    yield Corner("A = 0, at rest on a wall", tables, "rests-forever", [rest], STILL)
    tables = scene(*still, "0", position="0", velocity="1")
    dead = [at(kind, RIGHT, "1/2") for kind in ("impact", "rest")]
    yield Corner("A = 0, e = 0: one impact, then rest", tables, "rests-forever", dead, STILL)
    tables = scene(*still, "0.5", position="0", velocity="1")
    hits = [at("impact", RIGHT, "1/2"), at("impact", LEFT, "5/2"), at("impact", RIGHT, "13/2")]
    yield Corner("A = 0, e = 1/2: flights twice as long each", tables, GOES_ON, hits)
    yield Corner("A = 0, at rest inside", scene(*still, "0.5", position="0", velocity="0"), "never-impacts", [], NEVER)
    tables = scene("1", "pi", "0", "3", "0.5", position="0", velocity="-pi")
    yield Corner("A < d/2, no drift", tables, "never-impacts", [], NEVER)
    tables = scene("1", "pi", "cos(pi/5) - cos(2*pi/5) - 1/2", "1", "0.5", wall=LEFT, velocity="0")
    name = "a release that no precision tells: undecided, and nothing is listed"
    yield Corner(name, tables, "undecided", [], STILL, max_bits=1024)


def corners():
    """All of them."""
    return [*near_grazes(), *exact_grazes(), *rests(), *extremes()]
