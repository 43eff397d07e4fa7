"""Tests of the formulas and of the judgement. Run: python -m unittest discover -s validation/closed_forms"""
import unittest

from mpmath import mpf, pi, sqrt

import equispaced
import stability
import verb
from judge import check_half_map, check_impacts, must_refuse
from program import Disagreement, Event, Run, negated, scene
from two_impact import TINY, evaluate
from unequispaced import decimal_interval


def figure_12():
    """A = 1, W = pi, e = 1/2, th0 = 0: d = 3 pi, v = -4 pi."""
    return equispaced.equispaced("1", "pi", "0.5", "0", 1)


def listed(orbit, count=8, width=mpf("1e-9")):
    """The listing of a correct program."""
    events = [
        Event("impact", "P2" if impact.is_far else "P1", "right" if impact.is_far else "left",
              (impact.time - width, impact.time + width), (impact.velocity - width, impact.velocity + width))
        for impact in orbit.impacts(count)
    ]
    return Run("impacts-reached", True, events)


class Formulas(unittest.TestCase):
    def test_expressions(self):
        for text, value in [("1/3 + 2e-1", mpf(8) / 15), ("-(2^3)*pi", -8 * pi), ("sqrt(2)*cos(pi/3)", sqrt(2) / 2)]:
            self.assertLess(abs(evaluate(text) - value), TINY)


class Judgement(unittest.TestCase):
    def test_impacts_are_held_or_refused(self):
        orbit = figure_12()
        found = listed(orbit)
        self.assertEqual(check_impacts(found, orbit), 16)
        self.assertEqual(check_half_map(found, orbit), 7)
        late = found.events[5]._replace(time=tuple(t + 1 for t in found.events[5].time))
        copies = [found.events[:-1], found.events[1:], [*found.events[:5], late, *found.events[6:]]]
        copies.append([*found.events[:5], found.events[5]._replace(mapping="P4"), *found.events[6:]])
        for events in copies:
            must_refuse("a spoiled copy", check_impacts, found._replace(events=events), orbit)
        must_refuse("a late impact", check_half_map, found._replace(events=copies[2]), orbit)
        must_refuse("nothing certified", check_impacts, found._replace(certified=False), orbit)
        with self.assertRaisesRegex(Disagreement, "was not refused"):
            must_refuse("a good copy", check_impacts, found, orbit)

    def test_wrong_identities_are_refused(self):
        orbit = equispaced.equispaced("1", "2", "0.6", "-0.7", 1)
        stability.check_identities(orbit)
        stability.check_derivative(orbit)
        orbit.theta0 += mpf("1e-20")
        must_refuse("another th0", stability.check_identities, orbit)

    def test_entries_of_two_impact_are_held_or_refused(self):
        orbit, around = figure_12(), lambda value: [str(value - mpf("1e-9")), str(value + mpf("1e-9"))]
        right = {"wall": "right", "phase": around(pi), "velocity": around(4 * pi)}
        left = {"wall": "left", "phase": ["-1e-9", "1e-9"], "velocity": around(-4 * pi)}
        root = {"re": ["0.25", "0.25"], "im": ["0", "0"]}
        entry = {"impacts": [left, right], "unique": True, "physical": True, "symmetric": True, "trace": ["0.5", "0.5"],
                 "determinant": ["0.0625", "0.0625"], "eigenvalues": [root, root], "stability": "stable"}
        self.assertTrue(verb.is_listed(entry, orbit, "left"))
        self.assertEqual(verb.check_entry(entry, orbit)["stable"], 1)
        spoiled = [("physical", False), ("symmetric", False), ("stability", "unstable"), ("trace", ["0.6", "0.7"]),
                   ("eigenvalues", [root, {"re": ["0.3", "0.3"], "im": ["0", "0"]}]), ("unique", False)]
        for key, value in spoiled:
            must_refuse(key, verb.check_entry, {**entry, key: value}, orbit)
        self.assertFalse(verb.is_listed({**entry, "impacts": [left, {**right, "phase": around(3)}]}, orbit, "left"))

    def test_scenes(self):
        self.assertEqual(negated("[1, 2]"), "[-(2), -(1)]")
        self.assertIn('velocity = "-((2*(1)*(pi)/(1 - 0.5)*cos(0))*(1))"', scene(figure_12()))
        low, high = (evaluate(part) for part in decimal_interval(pi)[1:-1].split(","))
        self.assertTrue(low < pi < high and high - low < mpf("1e-43"))


if __name__ == "__main__":
    unittest.main()
