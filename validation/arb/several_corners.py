"""Corner cases with several harmonics.

The pressure of the touch is cos th - b cos 2 th, th = pi t: at b = 1 it touches 0 at t = 0 and ends at t = 2/3. With b
a little more it ends just before 0 for a moment, a departure of third order into a flight as short as that moment.
"""
from fractions import Fraction

from corners import GOES_ON, GRAZES, PERIODIC, STILL, Corner, Event, at, hit, scene
from scene import LEFT, RIGHT

# Exact grazes and touches may stay undecided, as no precision tells them.
UNTOLD_BITS = 2048


def event(kind, wall, low, high):
    """An event between two times."""
    return Event(kind, wall, Fraction(low), Fraction(high))


def inside_graze(depth, **start):
    """Drift 4 pi/5, A = 1 and 1/10, d = 4: the first maximum, at t = 5/6, is `depth` beyond the right wall.

    There cos 2 pi t = 1/2, cos 4 pi t = -1/2 and both sines are -sqrt(3)/2.
    """
    start = start or {"position": f"2 - 11*sqrt(3)/20 - 2*pi/3 + ({depth})", "velocity": "-8*pi/5"}
    return scene(["1", "1/10"], ["2*pi", "4*pi"], "0", "4", "0.5", **start)


DRIFT = "(1/2 - sqrt(3)/10)*pi"
GRAZING_GAP = f"(7/6*{DRIFT} + sqrt(3)/2 + 21/20)"


def wall_graze(depth, **start):
    """From the left wall with u = c, E = cos pi t + cos(2 pi t)/10: the maximum at 7/6 is `depth` gaps beyond."""
    start = start or {"wall": LEFT, "velocity": f"-2*{DRIFT}"}
    return scene(["1", "1/10"], ["pi", "2*pi"], "pi/2", f"{GRAZING_GAP}*(1 - ({depth}))", "0.5", **start)


def near_grazes():
    """Cut by 10^-k of the gap, the contact is at most about 10^(-k/2) before the maximum; missed, later."""
    for k in (3, 6, 12, 20, 30):
        digits, reach = max(9, k // 2 + 3), Fraction(2, 10 ** (k // 2))
        for place, tables, top, low, high in [
            ("from inside the gap", inside_graze, Fraction(5, 6), "1.28", "1.42"),
            ("from the other wall", wall_graze, Fraction(7, 6), "2.3", "2.41"),
        ]:
            cut, missed = hit(RIGHT, top - reach, top), hit(RIGHT, low, high)
            size = f"4e-{k}" if tables is inside_graze else f"1e-{k}"
            yield Corner(f"two harmonics, cut by 1e-{k}, {place}", tables(size), GOES_ON, [cut], digits=digits)
            name = f"two harmonics, missed by 1e-{k}, {place}"
            yield Corner(name, tables(f"(-{size})"), GOES_ON, [missed], digits=digits)


def touch(excess):
    """Pressed on the left wall at t = -1/3; b = 1 + excess."""
    amplitudes, start = ["1", f"(1 + ({excess}))/4"], {"time": "-1/3", "wall": LEFT, "velocity": "0"}
    return scene(amplitudes, ["pi", "2*pi"], ["-pi/2", "pi/2"], "3", "0.5", **start)


def near_touches():
    """b = 1 +- 10^-k: the release is at most 10^(-k/2)/3 before 0, or about 2/3."""
    rest = at("rest", LEFT, "-1/3")
    for k in (3, 6, 9, 12, 20):
        digits = max(9, k // 2 + 5)
        early = event("release", LEFT, -Fraction(1, 3 * 10 ** (k // 2)), 0)
        name = f"the pressure ends for a moment, by 1e-{k}"
        yield Corner(name, touch(f"1e-{k}"), GOES_ON, [rest, early], digits=digits)
        late = event("release", LEFT, "0.66", "0.67")
        yield Corner(f"the pressure does not end, by 1e-{k}", touch(f"(-1e-{k})"), GOES_ON, [rest, late], digits=digits)


def rests():
    """Starts at rest, and one motion whose releases repeat, if the frequencies do."""
    still = scene(["0", "0"], ["pi", "sqrt(2)"], "0", "1", "0.5", wall=LEFT, velocity="0")
    yield Corner("two terms of amplitude 0, at rest", still, "rests-forever", [at("rest", LEFT, 0)], STILL)
    pressed = scene(["1", "1/3"], ["pi", "sqrt(2)"], "-pi/2", "1", "0.5", wall=LEFT, velocity="-1e-300")
    events = [event("rest", LEFT, "-1e-9", "1e-9"), event("release", LEFT, "0.5", "0.55")]
    yield Corner("incommensurate, pressed with a speed of 1e-300", pressed, GOES_ON, events)
    # The right wall's pressure is sin th + 6 sin 3 th.
    beginning = scene(["1", "2/3"], ["pi", "3*pi"], "0", "1", "0.5", wall=RIGHT, velocity="0")
    events = [at("rest", RIGHT, 0), event("release", RIGHT, "0.34", "0.36")]
    yield Corner("two harmonics, start where the press begins", beginning, GOES_ON, events)
    leaving = scene(["1", "2/3"], ["pi", "3*pi"], "0", "1", "0.5", wall=LEFT, velocity="0")
    yield Corner("two harmonics, start at a release", leaving, GOES_ON, [hit(RIGHT, "0.2", "0.3")])
    for second, outcome in (("2*pi", PERIODIC), ("2*sqrt(10)", GOES_ON)):
        dead = scene(["5", "1"], ["pi", second], "0", "1", "0", wall=LEFT, velocity="-1")
        yield Corner(f"two harmonics, e = 0, frequencies pi and {second}", dead, outcome, [], impacts=20)


def several_corners():
    """Those that are decided."""
    return [*near_grazes(), *near_touches(), *rests()]


def untold_corners():
    """A graze and a touch that are exact: listed as they are, or undecided with what comes before."""
    first, then = at("graze", RIGHT, "5/6"), hit(RIGHT, "1.28", "1.42")
    later = inside_graze(0, time="1", position="2 - 11*sqrt(3)/20 + 2*pi/15", velocity="-8*pi/5")
    name = "two harmonics, graze from inside the gap"
    yield Corner(name, inside_graze(0), GOES_ON, [first, then], GRAZES, later=later, max_bits=UNTOLD_BITS)
    position = f"3/2*{DRIFT} + 6/5 - {GRAZING_GAP}/2"
    later = wall_graze(0, time="3/2", position=position, velocity=f"{DRIFT} - pi")
    first, then = at("graze", RIGHT, "7/6"), hit(RIGHT, "2.3", "2.41")
    name = "two harmonics, graze from the other wall"
    yield Corner(name, wall_graze(0), GOES_ON, [first, then], GRAZES, later=later, max_bits=UNTOLD_BITS)
    events = [at("rest", LEFT, "-1/3"), at("release", LEFT, "2/3")]
    yield Corner("the pressure touches 0", touch("0"), GOES_ON, events, max_bits=UNTOLD_BITS)
