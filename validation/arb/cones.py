"""Judges what `impact-pair chaos --hyperbolic` says: strips, cones, entropy and exponents are proved by another program, in Arb balls.

Strips are proposed in doubles (`tubes.floating_map`) and cut into cells. Each cell is proved to be mapped between bottom and top of the next
h-set, the sides of its strip beyond its edges, and to expand a cone and map it into itself (Lemmas D25, D26 of docs/proofs/hyperbolic.md). The bounds
of exponents follow from strings of words, by potentials. The Hausdorff dimension is not judged here.
"""
from collections import namedtuple

import numpy as np
from flint import arb, ctx

from compare import Disagreement
from quads import Chord, Flights, around, cross, minus
from strings import Cell, Mapped, check_ratios, direction, spread
from tubes import floating_map

BITS = 80
# The states centre + xi along + eta across, |xi|, |eta| <= 1, of an h-set.
Frame = namedtuple("Frame", "centre along across")
# xi = middle + slope eta + a half, |a| <= 1.
Strip = namedtuple("Strip", "middle slope half")
# A word with its strip; sign is 1 where the image runs along the next h-set, -1 where it runs back.
Word = namedtuple("Word", "number start end far turns impacts half_cycles strip sign")
# Sides are mapped a little beyond the edges; places on a row that are looked at, how many beyond those inside, and how often nearer.
BEYOND, PLACES, REACH, ZOOMS = 1.004, 200, 8, 4
HALVINGS = 14


def frame_of(base):
    corners = [base.left.bottom, base.left.top, base.right.bottom, base.right.top]
    centre, along, across = (
        tuple(sum(sign * point[i] for sign, point in zip(signs, corners)) / 4 for i in (0, 1))
        for signs in ((1, 1, 1, 1), (-1, -1, 1, 1), (-1, 1, -1, 1))
    )
    return Frame(centre, along, across)


def edges_of(frame):
    """The left and the right edge of the parallelogram of an h-set, each as its bottom and its top."""
    at = lambda a, b: tuple(frame.centre[i] + a * frame.along[i] + b * frame.across[i] for i in (0, 1))
    return [Chord(at(a, -1), at(a, 1)) for a in (-1, 1)]


def coordinates(frame, vector):
    area = cross(frame.along, frame.across)
    return cross(vector, frame.across) / area, cross(frame.along, vector) / area


def vector(frame, xi, eta):
    return tuple(xi * frame.along[i] + eta * frame.across[i] for i in (0, 1))


def place(frame, state, turns):
    return coordinates(frame, minus((state[0] - turns, state[1]), frame.centre))


def row(law, frames, word, xi, eta):
    """Places along the next h-set of the images of states of a row, in doubles: NaN where they fly otherwise."""
    own, to = frames[word.start], frames[word.end]
    states = np.array([[float(x) for x in minus(vector(own, at, eta), (-own.centre[0], -own.centre[1]))] for at in xi])
    alike = np.ones(len(states), dtype=bool)
    for far in word.far:
        states, is_far, _ = floating_map(law, np.nan_to_num(states, nan=1.0))
        alike &= (is_far == far) & np.isfinite(states).all(axis=1)
    images = np.array([[float(x) for x in place(to, state, word.turns)] for state in np.nan_to_num(states, nan=9.0)])
    return np.where(alike & (abs(images[:, 1]) < 1), images[:, 0], np.nan)


def ends(law, frames, word, eta):
    """Places of the row that are mapped to the edges of the next h-set and a little beyond, and the sign of the crossing; None without one."""
    xi = np.linspace(-1, 1, PLACES + 1)
    image = row(law, frames, word, xi, eta)
    inside = np.flatnonzero(abs(image) < 1)
    if len(inside) < 2:
        return None
    sign = np.sign(image[inside[-1]] - image[inside[0]])
    found = []
    for edge, last in ((-1, inside[0]), (1, inside[-1])):
        low, high = sorted(xi[[last, np.clip(last + edge * REACH, 0, PLACES)]])
        for _ in range(ZOOMS):
            near = np.linspace(low, high, 21)
            beyond = np.flatnonzero(sign * edge * row(law, frames, word, near, eta) > BEYOND)
            if not len(beyond):
                return None
            at = beyond[-1] if edge < 0 else beyond[0]
            low, high = near[max(at - 1, 0)], near[min(at + 1, len(near) - 1)]
        found.append(near[at])
    return found, int(sign)


def with_strip(law, frames, word):
    """The word with a strip between two lines that are parallel, as floats propose it."""
    rows = [ends(law, frames, word, eta) for eta in (-1, 0, 1)]
    if None in rows or len({sign for _, sign in rows}) > 1:
        raise Disagreement(f"hyperbolic: no strip of word {word.number} is seen")
    slope = (rows[2][0][0] + rows[2][0][1] - rows[0][0][0] - rows[0][0][1]) / 4
    left, right = (
        choose(at[end] - slope * eta for eta, (at, _) in zip((-1, 0, 1), rows)) for end, choose in ((0, min), (1, max))
    )
    strip = Strip(*(arb(float(x)) for x in ((left + right) / 2, slope, (right - left) / 2)))
    return word._replace(strip=strip, sign=rows[0][1])


def image(law, frames, word, cell):
    """The image of a cell and of its half sides, or None where flights are not proved to end as the word says."""
    own, to, strip = frames[word.start], frames[word.end], word.strip
    a, reach, eta, rise = map(arb, cell)
    offset = vector(own, strip.middle + strip.slope * eta + a * strip.half, eta)
    centre = tuple(own.centre[i] + offset[i] for i in (0, 1))
    sides = [vector(own, strip.half * reach, 0), vector(own, strip.slope * rise, rise)]
    for far in word.far:
        states, walls, _ = floating_map(law, np.array([[float(x.mid()) for x in centre]]))
        if not np.isfinite(states).all() or bool(walls[0]) != far:
            return None
        landed = Flights(law, centre, sides).land(far, states[0][0] - (0.5 if far else 0))
        if landed is None:
            return None
        centre, sides = landed.centre, landed.images()
    return Mapped(cell, place(to, centre, word.turns), [coordinates(to, side) for side in sides])


def is_good(word, mapped, kappa):
    """True if a cell is mapped across the next h-set, and where it meets it, expands its cone and maps it into itself."""
    if not abs(spread(mapped, 1)) < 1:
        return False
    for edge in (-1, 1):
        if edge * mapped.cell.a + mapped.cell.reach < 1:
            continue
        side = around(mapped.middle[0] + edge * mapped.sides[0][0], abs(mapped.sides[1][0]))
        if not edge * word.sign * side > 1:
            return False
    if abs(spread(mapped, 0)) > 1:
        return True
    images = [direction(word, mapped, slope) for slope in (-kappa, kappa)]
    return all(word.sign * x > 1 and abs(y) < kappa * word.sign * x for x, y in images)


def proved(law, frames, word, kappa, dropped):
    """The images of the cells of a word's strip, each of which is good."""
    if not kappa * abs(word.strip.slope) < 1:
        raise Disagreement(f"hyperbolic: the strip of word {word.number} leans too much for cones of slope {kappa}")
    done, pieces = [], [(0, Cell(0.0, 1.0, 0.0, 1.0))]
    while pieces:
        depth, cell = pieces.pop()
        mapped = image(law, frames, word, cell)
        if mapped is not None and is_good(word, mapped, kappa) and not dropped(cell):
            done.append(mapped)
            continue
        if depth == HALVINGS:
            raise Disagreement(f"hyperbolic: word {word.number} is not proved to expand cones of slope {kappa}")
        a, reach, eta, rise = cell
        for to in (-0.5, 0.5):
            if depth % 3 == 2:
                pieces.append((depth + 1, Cell(a, reach, eta + to * rise, rise / 2)))
            else:
                pieces.append((depth + 1, Cell(a + to * reach, reach / 2, eta, rise)))
    return done


def check_strips(words):
    """Refuses strips that leave their h-set, or that have a state in common with another one of it."""
    line = lambda strip, a, eta: strip.middle + strip.slope * eta + a * strip.half
    for word in words:
        if not all(abs(line(word.strip, a, eta)) < 1 for a in (-1, 1) for eta in (-1, 1)):
            raise Disagreement(f"hyperbolic: the strip of word {word.number} is not in its h-set")
        for other in words:
            if other.start == word.start and other.number < word.number:
                apart = (all(line(p, -1, eta) > line(q, 1, eta) for eta in (-1, 1)) for p, q in ((word.strip, other.strip), (other.strip, word.strip)))
                if not any(apart):
                    raise Disagreement(f"hyperbolic: the strips of words {other.number} and {word.number} are not proved to be disjoint")


def words_of(document):
    """The words that the document lists as those of the set, without strips."""
    for number in document["hyperbolic"]["words"]:
        word = document["words"][number]
        far = [flight == "F" for flight in word["flights"]]
        turns = (word["half_cycles"] + sum(far)) / 2
        yield Word(number, word["from"], word["to"], far, turns, word["impacts"], word["half_cycles"], None, None)


def check_recurrent(words):
    """Refuses words some of which do not lead back to where they come from."""
    for word in words:
        reached = {word.end}
        for _ in words:
            reached |= {other.end for other in words if other.start in reached}
        if word.start not in reached:
            raise Disagreement(f"hyperbolic: word {word.number} does not lead back")


def prove_cones(document, bases, law, dropped=lambda cell: False):
    """(words with strips, images of their cells) of the set that a document has, every cone proved."""
    frames = [frame_of(base) for base in bases]
    with ctx.workprec(BITS):
        words = [with_strip(law, frames, word) for word in words_of(document)]
        check_recurrent(words)
        check_strips(words)
        kappa = arb(document["hyperbolic"]["kappa"])
        return words, [proved(law, frames, word, kappa, dropped) for word in words]


def check_hyperbolic(document, bases, law, words, images):
    """Refuses bounds of entropy or exponents that do not follow from the words and their cells."""
    frames, claimed = [frame_of(base) for base in bases], document["hyperbolic"]
    with ctx.workprec(BITS):
        check_ratios(claimed, law, words, images, arb(claimed["kappa"]), lambda word, cell: image(law, frames, word, cell))
