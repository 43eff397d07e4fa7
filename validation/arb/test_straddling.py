"""Tests of the straddling scenes and of their judgement. Run: python -m unittest discover -s validation/arb"""
import unittest
from collections import Counter

from flint import arb, ctx

from compare import Disagreement, bounds
from controls import printed
from corners import inside_graze
from listing import judge
from orbit import prove
from parts import STRADDLING
from recorded import straddling_scenes, toml
from rest_controls import moved, renumbered
from scene import LEFT, RIGHT, Scene
from suite import check_shares
from timeline import Timeline
from untold import merged


class Scenes(unittest.TestCase):
    def test_all_families_and_extremes_are_there(self):
        found = straddling_scenes(200)
        self.assertEqual(len({toml(tables) for _, tables, _ in found}), 200)
        self.assertEqual(len({family for family, _, _ in found}), 10)
        kinds = Counter(tables["pair"]["restitution"] for _, tables, _ in found)
        self.assertTrue(all(kinds[e] > 3 for e in ("0", "1/10^30", "1/2", "1-1/10^16", "1")))
        walls = Counter(tables["start"].get("wall") for _, tables, _ in found)
        self.assertTrue(all(walls[where] > 9 for where in (LEFT, RIGHT, None)))
        self.assertGreater(sum(tables["start"]["velocity"] in ("(0)", "-(0)") for _, tables, _ in found), 6)


class Shares(unittest.TestCase):
    def test_too_much_undecided_is_a_disagreement(self):
        good = Counter({"scenes": 100, "undecided": 35, "beyond": 5, "by auto": 20, "undecided by auto": 6})
        self.assertEqual(list(check_shares({STRADDLING: good})), [])
        for more in ({"beyond": 1}, {"undecided by auto": 1}):
            self.assertEqual(len(list(check_shares({STRADDLING: good + Counter(more)}))), 1)


class Untold(unittest.TestCase):
    def listing(self, depth, hits):
        """A graze and what follows it, of a ball that hits the right wall near t = 5/6 or does not."""
        scene = Scene(inside_graze(depth))
        timeline = Timeline(scene, 9, 60, True)
        impacts = prove(scene, 5, 60).impacts
        with ctx.workprec(256):
            (graze,) = printed([impacts[0]._replace(time=arb(5) / 6)], arb("1e-5"))
            graze |= {"event": "graze", "index": "", "mapping": "", "velocity_lower": "", "velocity_upper": ""}
            rows = renumbered(list(printed(impacts[1 if hits else 0 :], arb("1e-9"))))
        return [graze, *rows], timeline

    def test_what_follows_an_untold_graze_is_judged(self):
        for depth, hits in (("1e-20", True), ("-1e-20", False)):
            rows, timeline = self.listing(depth, hits)
            plain = merged(rows, timeline)
            self.assertEqual([row["event"] for row in plain], ["impact"] * 5)
            self.assertEqual(judge(plain, timeline, False).impacts, 5)
            spoiled = [
                [rows[0], *renumbered(rows[2:])],
                [rows[0], rows[1] | {"wall": LEFT if rows[1]["wall"] == RIGHT else RIGHT}, *rows[2:]],
                [rows[0], moved(rows[1], (bounds(rows[1], "time")[1] - bounds(rows[1], "time")[0]) * 2), *rows[2:]],
            ]
            for copy in spoiled:
                with self.assertRaises(Disagreement):
                    judge(merged(copy, timeline), timeline, False)

    def test_a_graze_that_is_none_hides_no_impact(self):
        rows, timeline = self.listing("1e-20", True)
        with self.assertRaises(Disagreement):
            judge(merged([moved(rows[0], -1), *rows[1:]], timeline), timeline, False)

    def test_an_exact_graze_ends_the_proof(self):
        rows, timeline = self.listing("1e-20", True)
        exact = Timeline(Scene(inside_graze("0")), 9, 60, True)
        plain = merged(rows, exact)
        self.assertEqual(plain, rows[:1])
        self.assertIsNotNone(judge(plain, exact, False).proved_end)


class Patience(unittest.TestCase):
    def test_a_chatter_may_be_listed_on(self):
        tables = inside_graze("0", wall=LEFT, velocity="-1e-15")
        tables["excitation"]["phase"] = "-pi/2"
        scene = Scene(tables)
        impacts = prove(scene, 6, 60).impacts
        rows = list(printed(impacts, arb("1e-25"), 60))
        self.assertEqual(judge(rows, Timeline(scene, 9, 60, True), False).impacts, 6)
        with self.assertRaises(Disagreement):
            judge(rows, Timeline(scene, 9, 60), False)
        tables["pair"]["restitution"] = "0"
        with self.assertRaises(Disagreement):
            judge(rows, Timeline(Scene(tables), 9, 60, True), False)


if __name__ == "__main__":
    unittest.main()
