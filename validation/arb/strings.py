"""Growth of words, and how much strings of words expand, in Arb balls: what bounds of entropy and of exponents have to follow from.

A string is a word with one before it and some behind it. Its points are in the cells of the word whose images may meet the next strips, at
heights that images of the word before have. Lemmas D27, D28 of docs/proofs/hyperbolic.md.
"""
from collections import namedtuple

import numpy as np
from flint import arb

from compare import Disagreement
from quads import around

# The part of a strip within so much of these a and eta, in doubles; the middle of its image, and what the derivative makes of its half sides,
# in the next h-set.
Cell = namedtuple("Cell", "a reach eta rise")
Mapped = namedtuple("Mapped", "cell middle sides")
# Words of a string behind its first two; rounds of potentials, and of slopes; what a ratio may be missed by in doubles.
BEHIND, ROUNDS, MAX_CUTS, SLACK = 4, 400, 3, 1e-12
# Cells here are coarser than those of the program: its bounds of exponents are proved moved outward by this part of them.
SHARE = arb(1) / 16


class Strings:
    """Bounds of ln |X| over the points of strings; `words` and the images of their cells as `cones.py` proves them.

    `image` maps a cell of a word: middle and half sides.
    """

    def __init__(self, words, images, kappa, image):
        self.words, self.image = words, image
        self.before = [[n for n, other in enumerate(words) if other.end == word.start] for word in words]
        self.heights = [heights(of) for of in images]
        for _ in range(MAX_CUTS):
            # The cells of a word at the heights of another one's images.
            self.images = {(first, n): self.cut(images[n], first) for n in range(len(words)) for first in self.before[n]}
            self.heights = [heights(mapped for first in self.before[n] for mapped in self.images[first, n]) for n in range(len(words))]
        self.slopes = [around(arb(0), kappa) for _ in words]
        for _ in range(MAX_CUTS):
            self.slopes = [hull(self.slopes_after(n)) for n in range(len(words))]

    def cut(self, images, first):
        at = self.heights[first]
        near = (mapped for mapped in images if around(arb(mapped.cell.eta), arb(mapped.cell.rise)).overlaps(at))
        return [mapped for mapped in near if not abs(spread(mapped, 0)) > 1]

    def slopes_after(self, n):
        """The slopes that cones, as the words before lead to them, are mapped into."""
        for first in self.before[n]:
            for mapped in self.images[first, n]:
                for slope in ends(self.slopes[first]):
                    x, y = direction(self.words[n], mapped, slope)
                    yield y / x

    def left(self, n, strip, within):
        """The parts of the a of a word that may be mapped between these a of the next strip."""
        for first in self.before[n]:
            for mapped in self.images[first, n]:
                along, across = (side[0] - strip.slope * side[1] for side in mapped.sides)
                target = strip.middle + within * strip.half - (mapped.middle[0] - strip.slope * mapped.middle[1])
                share = around(target, across) / along
                if share.overlaps(around(arb(0), arb(1))):
                    yield mapped.cell.a + common(share, around(arb(0), arb(1))) * mapped.cell.reach

    def edges(self):
        """(from, to, word, bounds of ln |X|) of all strings; a node is a string without its last word, or without its first."""
        left = {(n,): around(arb(0), arb(1)) for n in range(len(self.words))}
        for _ in range(BEHIND):
            found = {}
            for string, within in left.items():
                for n in self.before[string[0]]:
                    parts = list(self.left(n, self.words[string[0]].strip, within))
                    if parts:
                        found[n, *string] = hull(parts)
            left = found
        for string, within in left.items():
            for first in self.before[string[0]]:
                yield (first, *string[:-1]), string, string[0], self.expansion(first, string[0], within)

    def expansion(self, first, n, within):
        word = self.words[n]
        mapped = self.image(word, Cell(*middle_of(within), *middle_of(self.heights[first])))
        if mapped is None:
            raise Disagreement(f"hyperbolic: a string of word {word.number} is not mapped")
        return hull((word.sign * direction(word, mapped, slope)[0]).log() for slope in ends(self.slopes[first]))


def heights(images):
    return hull(spread(mapped, 1) for mapped in images if not abs(spread(mapped, 0)) > 1)


def ends(x):
    return x.lower(), x.upper()


def middle_of(x):
    """A double inside, and one that is no less than how far it is from there to either end."""
    middle = float(x.mid())
    return middle, float((x - middle).abs_upper()) * (1 + 2**-40)


def hull(balls):
    balls = list(balls)
    all_of = balls[0]
    for other in balls[1:]:
        all_of = all_of.union(other)
    return all_of


def common(x, y):
    low, high = max(x.lower(), y.lower()), min(x.upper(), y.upper())
    return low.union(high)


def spread(mapped, i):
    return around(mapped.middle[i], sum(abs(side[i]) for side in mapped.sides))


def direction(word, mapped, slope):
    """The image of the vector (1, slope) at each state of a cell."""
    reach, rise = arb(mapped.cell.reach), arb(mapped.cell.rise)
    along, across = (1 - slope * word.strip.slope) / (word.strip.half * reach), slope / rise
    return tuple(mapped.sides[0][i] * along + mapped.sides[1][i] * across for i in (0, 1))


def is_bound(edges, ratio, is_lower):
    """True if the weights around all cycles are proved to be at least the ratio times their lengths, or at most: by potentials."""
    sign = 1 if is_lower else -1
    weights = [(start, end, sign * (weight - ratio * length)) for start, end, weight, length in edges]
    least = [(start, end, float(weight.lower()) - SLACK) for start, end, weight in weights]
    potentials = dict.fromkeys([node for start, end, _ in least for node in (start, end)], 0.0)
    for _ in range(ROUNDS):
        before = dict(potentials)
        for start, end, weight in least:
            potentials[end] = min(potentials[end], potentials[start] + weight)
        if potentials == before:
            break
    return all(weight + arb(potentials[start]) - arb(potentials[end]) >= 0 for start, end, weight in weights)


def is_growth(words, bases, rate, weight, is_upper):
    """True if the words grow by at most this rate, or by at least: M v <= v, or M v >= v, for a positive v, M the sums of exp(-rate weight)."""
    matrix = [[sum(((-rate * weight(word)).exp() for word in words if (word.start, word.end) == (a, b)), arb(0)) for b in bases] for a in bases]
    floats, vector = np.array([[float(x.mid()) for x in row] for row in matrix]), np.ones(len(bases))
    for _ in range(2000):
        vector = vector + floats @ vector
        vector /= vector.max()
    vector = [arb(float(x)) for x in vector]
    sums = [sum(m * y for m, y in zip(row, vector)) for row in matrix]
    return all((total <= x if is_upper else total >= x) and x > 0 for total, x in zip(sums, vector))


def check_entropy(told, words):
    bases = sorted({word.start for word in words})
    for key, weight in (("per_impact", lambda word: word.impacts), ("per_cycle", lambda word: arb(word.half_cycles) / 2)):
        low, high = map(arb, told["entropy"][key])
        if not (is_growth(words, bases, low, weight, False) and is_growth(words, bases, high, weight, True)):
            raise Disagreement(f"hyperbolic: entropy.{key} does not follow from the words")


def check_ratios(told, law, words, images, kappa, image):
    """Refuses bounds of entropy or of exponents that are not proved here."""
    check_entropy(told, words)
    edges = list(Strings(words, images, kappa, image).edges())
    twice = 2 * law.restitution.log()
    low, high = map(arb, told["second_exponent"])
    claims = [("exponents.per_impact", told["exponents"]["per_impact"], lambda word: word.impacts),
              ("exponents.per_cycle", told["exponents"]["per_cycle"], lambda word: arb(word.half_cycles) / 2),
              ("second_exponent", [twice - high, twice - low], lambda word: word.impacts)]  # fmt: skip
    for name, bounds, length in claims:
        measured = [(start, end, weight, length(words[n])) for start, end, n, weight in edges]
        low, high = arb(bounds[0]) * (1 - SHARE), arb(bounds[1]) * (1 + SHARE)
        if not (is_bound(measured, low, True) and is_bound(measured, high, False)):
            raise Disagreement(f"hyperbolic: {name}, moved outward by a sixteenth, does not follow from the strings of words")
