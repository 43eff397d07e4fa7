"""Tests of the judge of horseshoes. Run: python -m unittest discover -s validation/arb"""
import random
import unittest

import numpy as np
from flint import arb, ctx

from chaos import Base, Word, check_bases, check_entropy, crossings, judge_document
from compare import Disagreement
from cones import Word as Letter
from cones import Strip, check_recurrent, check_strips
from quads import Chord, Flights, Law, corners, cross, minus
from strings import is_bound, is_growth
from tubes import floating_map, is_held

FIGURE_14 = Law(arb("9.42497") / 8, arb("0.5"))


def chord(*ends):
    return Chord(*(tuple(arb(x) for x in end) for end in ends))


def square(left, right, low=0.0, high=1.0):
    return Base(chord((left, low), (left, high)), chord((right, low), (right, high)))


class Quads(unittest.TestCase):
    def test_images_hold_those_of_points(self):
        draw, landed = random.Random(1995), 0
        for _ in range(300):
            u, w, size = draw.random(), draw.uniform(0.3, 2), 10 ** draw.uniform(-6, -2)
            moved = [(u + size * draw.uniform(-1, 1), w + size * draw.uniform(-1, 1)) for _ in range(4)]
            start, end = chord(*moved[:2]), chord(*moved[2:])
            states = np.array([[sum(x * share for x, share in zip(column, shares)) for column in zip(*moved)]
                               for shares in draw.choices([(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1), (0.25,) * 4], k=4)])
            images, far, _ = floating_map(FIGURE_14, states)
            if not np.isfinite(images).all() or len(set(far)) > 1:
                continue
            guess = float(images[0][0]) - 0.5 * bool(far[0])
            image = Flights.of_corners(FIGURE_14, corners(start, end, 0, 1, 0, 1)).land(bool(far[0]), guess)
            if image is None:
                continue
            landed += 1
            edge, origin = (arb(draw.uniform(-1, 1)), arb(draw.uniform(-1, 1))), (arb(1), arb(1))
            bounds = image.beside(origin, edge)
            for state in images:
                value = cross(edge, minus(tuple(arb(float(x)) for x in state), origin))
                self.assertTrue(bounds.overlaps(value + arb(0, 1e-11)), (moved, state))
        self.assertGreater(landed, 100)

    def test_an_image_is_only_held_away_from_tops_and_bottoms(self):
        image = Flights.of_corners(FIGURE_14, corners(*[chord((0.78, 1.2), (0.78, 1.2))] * 2, 0, 1, 0, 1))
        (at,), (far,), _ = floating_map(FIGURE_14, np.array([[0.78, 1.2]]))
        image = image.land(bool(far), at[0] - 0.5 * bool(far))
        for below, above, held in ((0.1, 0.1, True), (-1e-6, 0.1, False), (0.1, -1e-6, False)):
            tube = [chord((at[0] + 0.1 * k, at[1] - below), (at[0] + 0.1 * k, at[1] + above)) for k in (-3.5, -2.5, -1.5, -0.5, 0.5, 1.5, 2.5, 3.5)]
            self.assertIs(is_held(image, tube, 3), held)


class Words(unittest.TestCase):
    def test_a_tube_that_crosses_does_so_once(self):
        tube = [chord((x, 0.4), (x, 0.6)) for x in (2.9, 3.1, 3.3, 3.5)]
        self.assertEqual(list(crossings(square(0.0, 0.2), tube, 3)), [(0, 2)])
        self.assertEqual(list(crossings(square(0.0, 0.2), tube, 2)), [])
        self.assertEqual(list(crossings(square(0.0, 0.2, 0.5), tube, 3)), [])
        self.assertEqual(list(crossings(square(0.0, 0.6), tube, 3)), [])

    def test_bases_that_overlap_some_turns_later_are_refused(self):
        check_bases([square(0.0, 0.2), square(0.3, 0.4)])
        with self.assertRaisesRegex(Disagreement, "not apart"):
            check_bases([square(0.0, 0.2), square(1.1, 1.4)])
        check_bases([square(0.1, 1.05)])
        with self.assertRaisesRegex(Disagreement, "not apart from its own translate"):
            check_bases([square(0.1, 1.3)])
        with self.assertRaisesRegex(Disagreement, "not convex"):
            check_bases([square(0.2, 0.0)])

    def test_entropies_of_known_words(self):
        # Two words of one impact: ln 2; one of one and one of two: the golden ratio's logarithm.
        for lengths, told, more in (((1, 1), "0.693147", "0.693148"), ((1, 2), "0.481211", "0.481212")):
            words = [Word(0, 0, length, length, "") for length in lengths]
            check_entropy(words, 1, told, 1, lambda word: word.impacts)
            with self.assertRaisesRegex(Disagreement, "does not follow"):
                check_entropy(words, 1, more, 1, lambda word: word.impacts)

    def test_a_word_that_is_not_proved_is_refused(self):
        word = {"from": 0, "to": 0, "impacts": 1, "half_cycles": 1, "flights": "F"}
        document = {"bases": [0], "words": [word, word], "entropy": {"per_impact": "0", "per_cycle": "0"}}
        judge_document(document, [Word(*word.values())] * 2)
        with self.assertRaisesRegex(Disagreement, "not proved here"):
            judge_document(document, [Word(*word.values())])


class Hyperbolic(unittest.TestCase):
    @staticmethod
    def letter(number, start, end, middle=0.0, impacts=1):
        return Letter(number, start, end, [True], 1, impacts, impacts, Strip(arb(middle), arb("0.01"), arb("0.2")), 1)

    def test_ratios_are_those_of_closed_ways(self):
        # A way around alone of ratio 1, and one there and back of ratio 1/2.
        edges = [(0, 0, arb(1), 1), (0, 1, arb(5), 1), (1, 0, arb(-4), 1)]
        for ratio, is_lower, holds in (("0.49", True, True), ("0.51", True, False), ("1.01", False, True), ("0.99", False, False)):
            self.assertIs(is_bound(edges, arb(ratio), is_lower), holds, (ratio, is_lower))

    def test_words_grow_by_the_golden_ratio(self):
        words = [self.letter(0, 0, 0), self.letter(1, 0, 1), self.letter(2, 1, 0)]
        for rate, is_upper, holds in (("0.4812", False, True), ("0.4813", False, False), ("0.4813", True, True), ("0.4812", True, False)):
            self.assertIs(is_growth(words, [0, 1], arb(rate), lambda word: word.impacts, is_upper), holds, (rate, is_upper))

    def test_strips_that_meet_and_words_that_lead_nowhere_are_refused(self):
        check_strips([self.letter(0, 0, 0, -0.5), self.letter(1, 0, 0, 0.5), self.letter(2, 1, 0, 0.5)])
        with self.assertRaisesRegex(Disagreement, "disjoint"):
            check_strips([self.letter(0, 0, 0, 0.3), self.letter(1, 0, 0, 0.5)])
        with self.assertRaisesRegex(Disagreement, "not in its h-set"):
            check_strips([self.letter(0, 0, 0, 0.8)])
        check_recurrent([self.letter(0, 0, 1), self.letter(1, 1, 0)])
        with self.assertRaisesRegex(Disagreement, "lead back"):
            check_recurrent([self.letter(0, 0, 0), self.letter(1, 0, 1)])


if __name__ == "__main__":
    ctx.prec = 80
    unittest.main()
