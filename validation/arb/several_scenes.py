"""Random scenes with two to five harmonics: commensurate or not, weak and fast, equal, of amplitude 0."""
import random

from expression import evaluate
from extreme_scenes import decimal
from extreme_scenes import restitution as extreme_restitution
from random_scenes import PHASES, start
from scene import LEFT, RIGHT

# W of the first harmonic, and what the others are of it.
BASES = ["pi", "2*pi", "1", "sqrt(2)", "0.37", "20*pi"]
RATIONAL = ["2", "3", "5", "1/2", "3/2", "7/4", "9", "1/5"]
IRRATIONAL = ["sqrt(2)", "sqrt(5)", "pi", "sqrt(2)/3", "(1 + sqrt(5))/2"]
GAPS = ["1", "9.42497", "1/3", "sqrt(5)*100", "0.002"]


def restitution(draw):
    """e: half of them small enough to rest often, the others over the extremes."""
    if draw.random() < 0.5:
        return draw.choice(["0", decimal(draw.uniform(0.05, 0.4)), decimal(draw.uniform(0.4, 0.8))])
    return extreme_restitution(draw)


def others(draw):
    """[(A, W)] of the harmonics after the first, relative to it."""
    kind = draw.random()
    if kind < 0.12:
        return [(decimal(10 ** -draw.uniform(3, 6)), "200")]
    if kind < 0.2:
        return [("1", "1")] * draw.randint(1, 3)
    if kind < 0.28:
        return [("1/3", "3"), ("1/5", "5")]
    ratios = draw.choice([RATIONAL, IRRATIONAL, RATIONAL + IRRATIONAL])
    found = [
        (decimal(10 ** -draw.choice([draw.uniform(0, 1), draw.uniform(0, 6)])), draw.choice(ratios))
        for _ in range(draw.randint(1, 4))
    ]
    if draw.random() < 0.15:
        found[-1] = ("0", found[-1][1])
    return found


def phases(draw, count):
    """One for all or a list."""
    if draw.random() < 0.3:
        return draw.choice(PHASES)
    return [draw.choice([draw.choice(PHASES), decimal(draw.uniform(-7, 7))]) for _ in range(count)]


def just_before_release(draw, fastest, speed):
    """A start shortly before time 0, when the left wall releases the ball if all phases are 0, the right one if pi."""
    ahead = 10 ** -draw.uniform(0.5, 4)
    pace = speed * ahead**2 * 10 ** draw.uniform(-1.5, 0.5)
    wall = draw.choice((LEFT, RIGHT))
    first = {"time": f"-{decimal(ahead / fastest)}", "wall": wall, "velocity": decimal(-pace if wall == LEFT else pace)}
    return "0" if wall == LEFT else "pi", first


def scene(draw):
    """The tables of a scene; the sum of the amplitudes is 10^-2 to 10^2 gaps."""
    base, gap, ratio = draw.choice(BASES), draw.choice(GAPS), 10 ** draw.uniform(-2, 2)
    terms = [("1", "1"), *others(draw)]
    sizes = [(float(evaluate(size)), float(evaluate(f"({w})*({base})"))) for size, w in terms]
    total = sum(size for size, _ in sizes)
    speed = ratio / total * float(evaluate(gap)) * sum(size * w for size, w in sizes)
    phase, first = phases(draw, len(terms)), start(draw, gap, speed)
    if draw.random() < 0.1:
        phase, first = just_before_release(draw, max(w for _, w in sizes), speed)
    return {
        "excitation": {
            "amplitude": [f"{size}*{decimal(ratio / total)}*({gap})" for size, _ in terms],
            "frequency": [f"({w})*{base}" for _, w in terms],
            "phase": phase,
        },
        "pair": {"gap": gap, "restitution": restitution(draw)},
        "start": first,
    }


def several_scenes(count, seed):
    """So many scenes, the same ones for the same seed."""
    draw = random.Random(seed)
    return [scene(draw) for _ in range(count)]
