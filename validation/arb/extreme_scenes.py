"""Random scenes over the extremes of everything: units, times, A/d, e, speeds, places."""
import random

from random_scenes import late_press
from scene import LEFT, RIGHT

UNITS = ["1", "pi", "200*pi", "sqrt(2)"]
PHASES = ["0", "pi", "pi/2", "-pi/2", "pi/3", "1.047196"]


def decimal(value):
    return f"{value:.9g}"


def restitution(draw):
    """e: 0, 1, near 0, near 1, or anything."""
    return draw.choice([
        "0",
        "1",
        decimal(10 ** -draw.uniform(1, 12)),
        f"1 - {decimal(10 ** -draw.uniform(1, 9))}",
        decimal(draw.random()),
    ])


def unit(draw):
    """W or d: a plain one, or between 10^-12 and 10^12 of one."""
    plain = draw.choice(UNITS)
    return plain if draw.random() < 0.5 else f"{decimal(10 ** draw.uniform(-12, 12))}*{plain}"


def time(draw):
    """t0: 0, of order 1, or as large as 10^15."""
    return draw.choice(["0", "0", decimal(draw.uniform(-5, 5)), "1e15 + 1/3", f"-{decimal(10 ** draw.uniform(3, 15))}"])


def place(draw):
    """y/d inside the gap: anywhere, or as near to a wall as 10^-15."""
    side = draw.choice(("", "-"))
    if draw.random() < 0.5:
        return f"{side}{decimal(draw.uniform(0, 0.49))}"
    return f"{side}(1/2 - {decimal(10 ** -draw.uniform(2, 15))})"


def speed(draw, frequency, gap):
    """A speed, as an expression, that crosses the gap in 10^-9 to 10^4 forcing periods; or none."""
    if draw.random() < 0.2:
        return "0"
    turns = 10 ** draw.choice([draw.uniform(-9, 0), draw.uniform(-1, 1), draw.uniform(1, 4)])
    return f"({gap})*({frequency})/(2*pi)/{decimal(turns)}"


def start(draw, frequency, gap):
    """On a wall or inside."""
    pace = speed(draw, frequency, gap)
    if draw.random() < 0.3:
        sign = draw.choice(("", "-"))
        return {"time": time(draw), "position": f"{place(draw)}*({gap})", "velocity": f"{sign}{pace}"}
    wall = draw.choice((LEFT, RIGHT))
    return {"time": time(draw), "wall": wall, "velocity": f"-{pace}" if wall == LEFT else pace}


def scene(draw):
    """The tables of a scene; A/d from 10^-6 to 10^6."""
    frequency, gap, ratio = unit(draw), unit(draw), 10 ** draw.uniform(-6, 6)
    phase, first = draw.choice(PHASES + [decimal(draw.uniform(-7, 7))]), start(draw, frequency, gap)
    if draw.random() < 0.1:
        phase, first = late_press(draw, 1)
        first["velocity"] += f"*{decimal(ratio)}*({gap})*({frequency})"
    return {
        "excitation": {"amplitude": f"{decimal(ratio)}*({gap})", "frequency": frequency, "phase": phase},
        "pair": {"gap": gap, "restitution": restitution(draw)},
        "start": first,
    }


def extreme_scenes(count, seed):
    """So many scenes, the same ones for the same seed."""
    draw = random.Random(seed)
    return [scene(draw) for _ in range(count)]
