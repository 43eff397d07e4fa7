"""Tests of the corner cases, the interval scenes and the shares. Run: python -m unittest discover -s validation/arb"""
import unittest
from collections import Counter
from fractions import Fraction

from flint import arb, ctx

from compare import Disagreement
from controls import printed
from corner_check import check_events, check_spoiled, check_touch
from corners import corners, inside_graze, wall_graze
from flight import Flight, TooLong
from intervals import check_spoiled as check_member_spoiled
from intervals import interval_scenes, judge_member
from orbit import orbit, prove
from recorded import random_scenes
from scene import LEFT, RIGHT, Motion, Scene
from suite import check_shares


class Corners(unittest.TestCase):
    def test_near_grazes_are_what_their_names_say(self):
        for corner in corners():
            if corner.name.startswith(("cut", "missed")):
                impacts, _ = orbit(Scene(corner.tables), 1, 30)
                (event,) = corner.events
                self.assertEqual(impacts[0].wall, event.wall)
                rows = list(printed(impacts, arb(10) ** -25))
                check_events(corner, rows, corner.outcome)
                self.assertEqual(check_spoiled(corner, rows, corner.outcome), 5)

    def test_a_touch_is_exact(self):
        for tables, time in ((inside_graze, Fraction(5, 6)), (wall_graze, Fraction(7, 6))):
            check_touch(Scene(tables("0")), RIGHT, time)
            for wrong in [(tables("1e-30"), RIGHT, time), (tables("0"), LEFT, time), (tables("0"), RIGHT, time + 1)]:
                with self.assertRaises(Disagreement):
                    check_touch(Scene(wrong[0]), *wrong[1:])

    def test_names_are_unique(self):
        names = [corner.name for corner in corners()]
        self.assertEqual(len(names), len(set(names)))


class Long(unittest.TestCase):
    def test_parts_of_many_periods(self):
        # Without excitation worth the name the ball crosses 10^6 gaps' worth of forcing periods at the speed u.
        with ctx.workprec(128):
            motion = Motion([(arb("1e-9"), arb.pi(), arb(0))], arb(1), arb(1))
            wall, bracket = Flight(motion, LEFT, arb(0), arb(0), arb("1e-6")).first_contact()
            self.assertEqual(wall, RIGHT)
            self.assertTrue(abs(bracket.mid() - arb("1e6") / (1 + arb.pi() / 1000)) < 10)
            still = Motion([(arb("0.1"), arb.pi(), arb(0))], arb(1), arb(1))
            with self.assertRaises(TooLong):
                Flight(still, None, arb(0), arb("0.5"), -arb("0.1") * arb.pi()).first_contact(100)

    def test_more_bits_are_no_help_when_it_takes_too_long(self):
        tables = inside_graze("0", position="0", velocity="-2*pi")
        proved = prove(Scene(tables), 1)
        self.assertIsInstance(proved.reason, TooLong)

    def test_extremes_are_extreme(self):
        kinds = Counter(tables["pair"]["restitution"] for tables in random_scenes("extreme", 100))
        self.assertGreater(kinds["0"], 5)
        self.assertGreater(kinds["1"], 5)


class Intervals(unittest.TestCase):
    def test_members_are_held_or_refused(self):
        (scene,) = interval_scenes(1, 3)
        impacts, _ = orbit(Scene(scene.members[2]), 4, 30)
        rows = list(printed(impacts, arb("1e-20")))
        tally = judge_member(rows, scene.members[2], 4)
        self.assertEqual((tally["held"], tally["enclosures"]), (8, 8))
        with self.assertRaises(Disagreement):
            judge_member(rows, scene.members[0], 4)
        self.assertEqual(check_member_spoiled(rows, scene.members[2:3], 4), 1)


class Shares(unittest.TestCase):
    def test_too_little_proved_is_a_disagreement(self):
        good = Counter(scenes=100, undecided=3, beyond=2)
        self.assertEqual(list(check_shares({"extreme scenes": good})), [])
        self.assertEqual(len(list(check_shares({"extreme scenes": good + Counter(beyond=6)}))), 1)
        self.assertEqual(len(list(check_shares({"resting scenes": Counter(scenes=9, calm=9, calm_resting=5)}))), 1)


if __name__ == "__main__":
    unittest.main()
