"""Tests of rests, releases and their judgement. Run: python -m unittest discover -s validation/arb"""
import json
import unittest

from flint import arb, ctx

from anchors import ANCHORS, EDGES, crossing
from compare import Disagreement
from controls import printed
from flight import Flight, Undecided
from listing import judge
from orbit import prove
from program import as_row
from recorded import toml
from release import release_after
from rest import Rest, accumulation
from judging import check_never
from scene import LEFT, RIGHT, Motion, Scene
from timeline import Timeline


def box(**changes):
    """A scene with A = d = 1, W = pi."""
    tables = {
        "excitation": {"amplitude": "1", "frequency": "pi", "phase": "0"},
        "pair": {"gap": "1", "restitution": "0"},
        "start": {"time": "0", "wall": LEFT, "velocity": "0"},
    }
    for table, values in tables.items():
        values.update({key: value for key, value in changes.items() if key in values})
    return Scene(tables)


class Rests(unittest.TestCase):
    def test_accumulation_under_constant_pressure(self):
        # A slow large box: a = A W^2 is nearly constant near th = -pi/2, and S = 2u/(a (1 - e)) in the limit.
        with ctx.workprec(128):
            motion = Motion([(arb("1e12"), arb("1e-6"), -arb.pi() / 2)], arb(1), arb("0.5"))
            total = accumulation(motion, LEFT, arb(0), arb("0.01"))
            self.assertTrue(total.contains(arb("0.04")))
            self.assertLess(total.rad(), 1e-10)
            self.assertIsNone(accumulation(motion, RIGHT, arb(0), arb("0.01")))
            # The bounce is higher than the gap, or too long for the press.
            self.assertIsNone(accumulation(motion, LEFT, arb(0), arb(2)))
            fast = Motion([(arb(1), arb(1), -arb.pi() / 2)], arb(100), arb("0.5"))
            self.assertIsNone(accumulation(fast, LEFT, arb(0), arb(1)))

    def test_accumulation_holds_the_sum_of_proved_flights(self):
        with ctx.workprec(600):
            for e in ("0.1", "0.5", "0.9"):
                motion = Motion([(arb(1), arb(1), arb(4))], arb(10), arb(e))
                time, u, bounds = arb(0), arb("0.001"), []
                for _ in range(12):
                    bounds.append(time + accumulation(motion, LEFT, time, u))
                    flight = Flight(motion, LEFT, time, arb(0), u)
                    wall, bracket = flight.first_contact()
                    self.assertEqual(wall, LEFT)
                    time, velocity = flight.land(wall, bracket)
                    u = -motion.restitution * velocity
                for wide, narrow in zip(bounds, bounds[1:]):
                    self.assertTrue(wide.overlaps(narrow) and wide.rad() > narrow.rad())

    def test_no_accumulation_without_loss(self):
        motion = Motion([(arb(1), arb(1), arb(4))], arb(10), arb(1))
        self.assertIsNone(accumulation(motion, LEFT, arb(0), arb("0.001")))
        self.assertEqual(accumulation(motion, LEFT, arb(0), arb(0)), 0)

    def test_release_is_where_the_pressure_ends(self):
        with ctx.workprec(128):
            motion = Motion([(arb(1), arb.pi(), arb(0))], arb(1), arb(0))
            for wall, time, half_turns in [(LEFT, "1.5", 2), (LEFT, "-0.1", 0), (RIGHT, "0.9", 1), (RIGHT, "8.3", 9)]:
                self.assertEqual(release_after(motion, wall, arb(time)), half_turns)
            for wall, time in [(LEFT, arb("0.5")), (RIGHT, arb("1.5")), (LEFT, arb(2, 0.01)), (LEFT, arb(1, 0.01))]:
                with self.assertRaises(Undecided):
                    release_after(motion, wall, time)

    def test_a_released_ball_crosses(self):
        for name in ANCHORS:
            timeline = Timeline(Scene(ANCHORS[name]), 30)
            proved = timeline.begin().prove(200, True)
            origin = timeline.begin().next(proved.rest)
            with ctx.workprec(256):
                self.assertTrue(origin.time(256).contains(1))
                leg = origin.prove(1, False)
                self.assertTrue(origin.shifted(leg.impacts[0].time, 256).overlaps(crossing()))
            self.assertEqual((leg.impacts[0].wall, leg.impacts[0].mapping), (RIGHT, "P2"))

    def test_a_start_at_the_edge_of_the_press(self):
        # th = 0: the left wall releases the ball, the right wall begins to press; th = pi the other way round.
        for phase, wall, rest in [("0", LEFT, None), ("0", RIGHT, 1), ("pi", RIGHT, None), ("pi", LEFT, 2)]:
            proved = Timeline(box(phase=phase, wall=wall), 9).begin().prove(3, True)
            if rest is None:
                self.assertEqual(proved.impacts[0].wall, {LEFT: RIGHT, RIGHT: LEFT}[wall])
            else:
                self.assertEqual((proved.impacts, proved.rest), ([], Rest(wall, arb(0), rest)))


    def test_the_edge_of_coming_to_rest(self):
        ends, does_not = (Timeline(Scene(tables), 9).begin().prove(150, True) for tables in EDGES.values())
        self.assertEqual(ends.rest.release, 0)
        self.assertTrue(0 < arb("0.3") - ends.rest.time < arb("1e-9"))
        self.assertTrue(does_not.rest is None or does_not.rest.time > 1)


class Judgements(unittest.TestCase):
    def test_motions_that_never_touch(self):
        inside = Scene(box(amplitude="0.2", phase="pi/2").tables | {"start": {"time": 0, "position": 0, "velocity": 0}})
        check_never(inside, [])
        with self.assertRaisesRegex(Disagreement, "touch the left one"):
            check_never(Scene(inside.tables | {"start": {"time": 0, "position": 0, "velocity": "-0.1"}}), [])
        for scene, rows in [(inside, [{}]), (box(), [])]:
            with self.assertRaisesRegex(Disagreement, "was on one"):
                check_never(scene, rows)

    def test_a_graze_between_proved_impacts_is_refused(self):
        scene = box(restitution="0.5", velocity="-1")
        rows, timeline = list(printed(prove(scene, 4, 30).impacts, arb("1e-9"))), Timeline(scene, 9)
        graze = rows[1] | {"event": "graze", "index": "", "mapping": "", "velocity_lower": "", "velocity_upper": ""}
        with self.assertRaisesRegex(Disagreement, "a graze, proved none"):
            judge(rows[:1] + [graze] + rows[1:], timeline)

    def test_scenes_are_written_as_toml(self):
        self.assertIn('[start]\ntime = "0"\nwall = "left"\n', toml(next(iter(ANCHORS.values()))))

    def test_events_of_the_json_lines(self):
        event = json.loads('{"event":"rest","wall":"left","time":["0.1","0.2"],"skipped":"infinite"}')
        self.assertEqual(list(as_row(event).values()), ["rest", "", "", "left", "0.1", "0.2", "", ""])


if __name__ == "__main__":
    unittest.main()
