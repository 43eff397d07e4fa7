"""Scenes that start next to where a simulator has to choose: an extremum, a graze, a release, a wall.

One quantity of each is 0 or +-10^-6 to 10^-60 (or a power of two as small) away from a touch, from a quarter turn,
from no velocity or from no drift, exactly: values are expressions. The quarter turns are in tau and the start is at
time 0 or so little before or after it. Lengths are told in gaps, times in turns, velocities in gaps a turn.
"""
import random
from collections import namedtuple
from fractions import Fraction

from flint import arb, ctx

from expression import ExpressionError
from scene import LEFT, RIGHT, Scene, SceneError

# The family of branch boundaries that the start is near, the scene, and the number of impacts requested.
Straddling = namedtuple("Straddling", "family tables impacts")
IMPACTS = 6

UNITS = ["2*pi", "2*pi", "pi", "1", "sqrt(2)", "300*pi"]
GAPS = ["1", "1", "1/3", "sqrt(5)", "1/1000", "77*pi"]
RATIOS = ["1/20", "0.3", "1/2", "1", "7/2", "25", "1000", "1/500", "1/10^30"]
SWINGS = ["1/25", "0.1", "1/5", "1/500"]
RESTITUTIONS = ["0", "1/10^30", "1/2", "1 - 1/10^16", "1"]
# So many digits of a start that is aimed at by bisection.
AIMED = 90
# So many tell whether a start is inside the gap.
BITS = 1024


def small(draw):
    """10^-6 to 10^-60, or a power of two as small."""
    k = draw.randint(6, 60)
    return f"1/10^{k}" if draw.random() < 0.7 else f"1/2^{round(k * 3.32)}"


def sign(draw):
    return draw.choice(("", "-"))


def offset(draw):
    """A little more or less, or nothing."""
    return "0" if draw.random() < 0.15 else f"{sign(draw)}{small(draw)}"


def pace(draw):
    """A speed: mostly hardly any, now and then none."""
    kind = draw.random()
    return "0" if kind < 0.15 else f"{draw.randint(1, 30)}/7" if kind < 0.25 else small(draw)


def turns(draw):
    """A phase that nothing is special about, in forcing periods."""
    return f"{draw.randint(1, 58)}/59"


def quarter(draw):
    """A multiple of a quarter period, more and less than 0."""
    return f"{draw.randint(-9, 9)}/4"


def angle(phase):
    return f"(2*pi*({phase}))"


def sine(phase):
    return f"sin{angle(phase)}"


def cosine(phase):
    return f"cos{angle(phase)}"


def tau(phase):
    """A phase in radians; of a whole number of half periods, k*pi: then it is exact in balls, too."""
    top, _, bottom = phase.partition("/")
    if bottom == "4" and int(top) % 2 == 0:
        return f"{int(top) // 2}*pi"
    return f"2*pi*({phase})"


def tables(draw, ratio, phase, time, first):
    """The tables; `first`: {"wall": ...} or {"position": ...} and the velocity, all in gaps and turns."""
    frequency, gap = draw.choice(UNITS), draw.choice(GAPS)
    start = {"time": "0" if time == "0" else f"({time})*2*pi/({frequency})"}
    for key, unit in (("position", gap), ("velocity", f"({gap})*({frequency})/(2*pi)")):
        if key in first:
            start[key] = "0" if first[key] == "0" else f"({first[key]})*{unit}"
    return {
        "excitation": {"amplitude": f"({ratio})*({gap})", "frequency": frequency, "phase": tau(phase)},
        "pair": {"gap": gap, "restitution": draw.choice(RESTITUTIONS)},
        "start": start | ({"wall": first["wall"]} if "wall" in first else {}),
    }


def at_wall(draw, speed):
    """On a wall, with a speed towards it."""
    wall = draw.choice((LEFT, RIGHT))
    return {"wall": wall, "velocity": "0" if speed == "0" else f"-({speed})" if wall == LEFT else speed}


def next_to_an_extremum(draw):
    """Inside the gap, next to a wall: hardly any velocity, or none, or aimed at an extremum just passed or ahead."""
    ratio, phase = draw.choice(RATIOS), draw.choice((turns, quarter))(draw)
    place = f"{sign(draw)}(1/2 - {small(draw)})" if draw.random() < 0.8 else f"{sign(draw)}(1/4)"
    time, velocity = offset(draw), draw.choice(("0", f"{sign(draw)}{small(draw)}"))
    if draw.random() < 0.4:
        velocity = f"2*pi*({ratio})*({cosine(f'({phase}) + ({offset(draw)})')} - {cosine(f'({phase}) + ({time})')})"
    return tables(draw, ratio, phase, time, {"position": place, "velocity": velocity})


def touch(ratio, begin, end, whole):
    """(v, way): with velocity v at the phase `begin` an extremum is at the phase `end`, `way` further on."""
    drift = f"2*pi*({ratio})*{cosine(end)}"
    way = f"({drift}*(({end}) - ({begin}) + ({whole})) - ({ratio})*({sine(end)} - {sine(begin)}))"
    return f"({drift} - 2*pi*({ratio})*{cosine(begin)})", way


def is_past(begin, end):
    """True if a phase is before another, so that it takes one more forcing period to get there."""
    return Fraction(end) < Fraction(begin)


def later_touch(draw):
    """From inside, an extremum touches a wall up to three forcing periods later, or nearly."""
    ratio, begin, end = draw.choice(SWINGS), turns(draw), draw.choice((turns(draw), f"{draw.randint(0, 3)}/4"))
    velocity, way = touch(ratio, begin, end, draw.randint(0, 3) + is_past(begin, end))
    place = f"{sign(draw)}(1/2) - {way} + ({offset(draw)})"
    return tables(draw, ratio, begin, "0", {"position": place, "velocity": f"{velocity} + ({offset(draw)})"})


def far_touch(draw):
    """From a wall, a maximum touches the other wall, or nearly: the amplitude is made for it."""
    begin, end, wall = turns(draw), turns(draw), draw.choice((LEFT, RIGHT))
    velocity, way = touch("1", begin, end, draw.randint(0, 2) + is_past(begin, end))
    restitution = draw.choice(("1/2", "1", "1 - 1/10^16"))
    ratio = f"(1 + ({offset(draw)}))/{way}"
    if wall == RIGHT:
        begin = f"{begin} + 1/2"
    before = f"{velocity}*({ratio})/({restitution})"
    found = tables(draw, ratio, begin, "0", {"wall": wall, "velocity": before if wall == RIGHT else f"-{before}"})
    found["pair"]["restitution"] = restitution
    return found


def aimed_hop(lowest):
    """The phase in forcing periods, as a decimal, from which a hop of the left wall touches it again at `lowest` radians.

    Before it the ball was at sin(lowest) - sin(lowest - s) - s cos(lowest) amplitudes: at its highest for s = 2 lowest,
    and below the wall for s = 2 pi.
    """
    low, high = 2 * lowest, 2 * arb.pi()
    while not abs(high - low) < arb(10) ** -AIMED:
        middle = ((low + high) / 2).mid()
        height = lowest.sin() - (lowest - middle).sin() - middle * lowest.cos()
        low, high = (low, middle) if height < 0 else (middle, high)
    begin = (lowest - low) / (2 * arb.pi()) * arb(10) ** AIMED
    return f"{(begin - arb('0.5')).ceil().mid().unique_fmpz()}/10^{AIMED}"


def own_touch(draw):
    """A hop from a wall that grazes the same wall, or nearly."""
    part, wall, ratio = draw.randint(3, 29), draw.choice((LEFT, RIGHT)), draw.choice(SWINGS)
    with ctx.workprec(5 * AIMED):
        begin = aimed_hop(2 * arb.pi() * part / 128)
    velocity, _ = touch(ratio, begin, f"{part}/128", 0)
    restitution = draw.choice(("1/2", "1", "1 - 1/10^16"))
    before = f"({velocity} + ({offset(draw)}))/({restitution})"
    first = {"wall": wall, "velocity": before if wall == RIGHT else f"-{before}"}
    found = tables(draw, ratio, begin if wall == LEFT else f"{begin} + 1/2", "0", first)
    found["pair"]["restitution"] = restitution
    return found


def edge_of_the_pressure(draw):
    """On a wall where its pressure begins or ends, at rest or slow."""
    speed = "0" if draw.random() < 0.5 else pace(draw)
    return tables(draw, draw.choice(RATIOS), quarter(draw), offset(draw), at_wall(draw, speed))


def slow_bounces(draw):
    """A slow start on a wall, at any phase."""
    return tables(draw, draw.choice(RATIOS), turns(draw), "0", at_wall(draw, pace(draw)))


def no_drift(draw):
    """Inside, with so little drift that the first extrema are at one height, which is that of a wall, or nearly."""
    ratio, begin, end = draw.choice(SWINGS), turns(draw), draw.choice(("1/4", "-1/4"))
    wall, drift = ("1/2", small(draw)) if end == "-1/4" else ("-1/2", f"-{small(draw)}")
    velocity = f"{drift} - 2*pi*({ratio})*{cosine(begin)}"
    way = f"({drift}*(({end}) - ({begin}) + {draw.randint(2, 4)}) - ({ratio})*({sine(end)} - {sine(begin)}))"
    place = f"{wall} - {way} + ({offset(draw)})"
    if draw.random() < 0.2:
        place = draw.choice(("0", "1/4", "-0.4"))
    return tables(draw, ratio, begin, "0", {"position": place, "velocity": velocity})


def drift_of_the_box(draw):
    """The drift is the greatest speed of the box, or nearly: two extrema meet and vanish."""
    ratio, phase = draw.choice(("1/20", "1", "7/2", "1/500", "25")), draw.choice((turns, quarter))(draw)
    time = offset(draw)
    rest = f"2*pi*({ratio})*({sign(draw)}1 - {cosine(f'({phase}) + ({time})')})"
    velocity = f"{rest} + ({offset(draw)})"
    return tables(draw, ratio, phase, time, {"position": draw.choice(("0", "1/4", "-0.4")), "velocity": velocity})


FAMILIES = [
    next_to_an_extremum, later_touch, far_touch, own_touch, edge_of_the_pressure, slow_bounces, no_drift,
    drift_of_the_box, edge_of_the_pressure,
]


def is_start(found):
    """True if the program takes it: inside the gap, or on a wall and not away from it."""
    with ctx.workprec(BITS):
        try:
            Scene(found).start()
        except (SceneError, ExpressionError):
            return False
    return True


def straddling_scenes(count, seed):
    """So many scenes, the same ones for the same seed; the families in turn."""
    draw, found = random.Random(seed), []
    while len(found) < count:
        make = FAMILIES[len(found) % len(FAMILIES)]
        drawn = make(draw)
        if is_start(drawn):
            # Without drift the second impact is as many forcing periods away as the drift is small.
            impacts = 1 if make is no_drift else IMPACTS
            found.append(Straddling(make.__name__.replace("_", " "), drawn, impacts))
    return found
