"""Random scenes, many of which chatter, rest and are released."""
import json
import random

from expression import evaluate
from scene import LEFT, RIGHT

FREQUENCIES = [("pi", 3.14), ("2*pi", 6.28), ("1", 1.0), ("sqrt(2)", 1.41), ("200*pi", 628.3), ("0.37", 0.37)]
GAPS = [("1", 1.0), ("9.42497", 9.42), ("3*pi", 9.42), ("1/3", 0.333), ("0.002", 0.002), ("sqrt(5)*100", 223.6)]
PHASES = ["0", "pi", "pi/3", "-pi/2", "1.047196", "sqrt(2)"]


def restitution(draw):
    """e in [0, 1), often 0, near 0 or near 1."""
    kind = draw.random()
    if kind < 0.2:
        return "0"
    if kind < 0.35:
        return f"{10 ** -draw.uniform(0.7, 6):.9f}"
    if kind < 0.5:
        return f"{1 - 10 ** -draw.uniform(0.7, 4):.9f}"
    return f"{draw.random():.6f}"


def one_of(draw, known, low, high):
    """(expression, value): one of the known ones, or a decimal, log-uniform."""
    if draw.random() < 0.5:
        return draw.choice(known)
    value = 10 ** draw.uniform(low, high)
    return f"{value:.8g}", value


def start(draw, gap, speed):
    """On a wall or inside; without velocity, slow or fast."""
    pace = draw.choice([0.0, 10 ** draw.uniform(-3, 0), 10 ** draw.uniform(-3, 0), 10 ** draw.uniform(-1, 1)]) * speed
    time = draw.choice(["0", "0", f"{draw.uniform(-5, 5):.6f}", "sqrt(3)"])
    if draw.random() < 0.25:
        sign = draw.choice((-1, 1))
        place = draw.uniform(-0.49, 0.49)
        return {"time": time, "position": f"{place:.6f}*({gap})", "velocity": f"{sign * pace:.9g}"}
    wall = draw.choice((LEFT, RIGHT))
    return {"time": time, "wall": wall, "velocity": f"{-pace if wall == LEFT else pace:.9g}"}


def late_press(draw, speed):
    """(phase, start) on a wall whose pressure ends soon, with a bounce that just comes to rest before, or does not."""
    ahead = 10 ** draw.uniform(-4, -0.3)
    pace = speed * ahead**2 * 10 ** draw.uniform(-1.5, 0.5)
    wall = draw.choice((LEFT, RIGHT))
    phase = f"-{ahead:.9g}" if wall == LEFT else f"pi - {ahead:.9g}"
    return phase, {"time": "0", "wall": wall, "velocity": f"{-pace if wall == LEFT else pace:.9g}"}


def scene(draw):
    """The tables of a random scene; all its values are strings, that is expressions."""
    bounce = restitution(draw)
    frequency, w = one_of(draw, FREQUENCIES, -1, 3)
    gap, d = one_of(draw, GAPS, -3, 3)
    ratio = 10 ** draw.uniform(-2, 2)
    phase, first = draw.choice([draw.choice(PHASES), f"{draw.uniform(-7, 7):.6f}"]), start(draw, gap, ratio * d * w)
    if draw.random() < 0.15:
        phase, first = late_press(draw, ratio * d * w)
    return {
        "excitation": {"amplitude": f"{ratio:.6g}*({gap})", "frequency": frequency, "phase": phase},
        "pair": {"gap": gap, "restitution": bounce},
        "start": first,
    }


def scenes(count, seed):
    """So many scenes, the same ones for the same seed."""
    draw = random.Random(seed)
    return [scene(draw) for _ in range(count)]


def ratio(tables):
    """A/d."""
    return float(tables["excitation"]["amplitude"].partition("*")[0])


def is_calm(tables):
    """Small e or small A/d: most of these scenes come to rest at least once."""
    return float(evaluate(tables["pair"]["restitution"])) <= 0.3 or ratio(tables) < 0.1


def written(value):
    """A value or a list of them as strings of TOML."""
    return json.dumps(value if isinstance(value, list) else str(value))


def toml(tables):
    """The scene file."""
    lines = []
    for table, values in tables.items():
        lines += [f"[{table}]", *(f"{key} = {written(value)}" for key, value in values.items())]
        lines.append("")
    return "\n".join(lines)
