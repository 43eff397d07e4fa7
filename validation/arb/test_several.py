"""Tests of rests under several harmonics and of their judges. Run: python -m unittest discover -s validation/arb"""
import math
import os
import tomllib
import unittest
from unittest import mock

from flint import arb, ctx, fmpq
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import stand_in
from commensurate import common_measure, half_turns
from compare import Disagreement
from corner_check import check_touch
from flight import Flight, Undecided
from judging import judge_scene
from listing import judge, judge_period
from parts import judge_one_corner, judge_one_untold, judge_one_written
from random_scenes import toml
from release import Root, release_after
from scene import LEFT, RIGHT, Scene
from several_corners import Written, inside_graze, several_corners, touch, untold_corners, wall_graze, written
from several_scenes import several_scenes
from stand_in import listed

# The suite judges these by the program as well.
FEWER = 3 if "ARB_QUICK" in os.environ else 1


def by_stand_in(judge_it, *arguments):
    """The result of a comparison if the program under test is the stand-in."""
    with mock.patch("program.run", stand_in.run):
        return judge_it(*arguments, "no binary")


class Frequencies(unittest.TestCase):
    def test_common_measures(self):
        for texts, measure in [
            (["pi", "3*pi"], fmpq(1)), (["2*pi", "3*pi/2"], fmpq(1, 4)), (["pi + 2*pi", "2*pi"], fmpq(1, 3)),
            (["sqrt(2)*sqrt(3)", "sqrt(24)", "6/sqrt(6)"], fmpq(1)), (["sqrt(2)^2", "0.7"], fmpq(1, 20)),
            (["2^-1*pi", "pi^2/pi"], fmpq(1)), (["pi", "sqrt(2)*pi"], None), (["1", "pi"], None),
            (["1", "3.14159"], fmpq(1, 100000)), (["sin(1)", "1"], None), (["1 + sqrt(2)"], fmpq(1)),
        ]:
            self.assertEqual(common_measure(texts), measure, texts)

    def test_phases_that_are_half_turns(self):
        for text, turns in [("0", 0), ("3*pi", 3), ("(0) + pi", 1), ("-pi", -1), ("pi/3", None), ("3.14", None)]:
            self.assertEqual(half_turns(text), turns, text)

    def test_the_cycle_is_a_whole_number_of_periods(self):
        excitation = {"amplitude": ["1", "0", "2"], "frequency": ["2*pi", "sqrt(2)", "3*pi"], "phase": "0"}
        scene = Scene(inside_graze("0") | {"excitation": excitation})
        period, cycles = scene.common_period()
        self.assertTrue(period.contains(2))
        self.assertEqual(cycles, 3)
        self.assertEqual(len(scene.motion().terms), 2)


class Releases(unittest.TestCase):
    def test_the_root_is_the_first(self):
        # cos th - cos 2 th touches 0 at t = 0 and passes it at t = 2/3.
        with ctx.workprec(256):
            motion = Scene(touch("0")).motion()
            root = release_after(motion, LEFT, arb("0.01"))
            self.assertTrue(root.time(motion).contains(arb(2) / 3))
            self.assertLess(root.time(motion).rad(), 1e-70)
            for time, message in [("-0.3", "touch 0"), ("0.8", "not be pressed")]:
                with self.assertRaisesRegex(Undecided, message):
                    release_after(motion, LEFT, arb(time))

    def test_nearly_a_touch(self):
        # 2 b c^2 - c - b = 0 for c = cos th.
        for k in (2, 5, 10, 20, 40):
            with ctx.workprec(512):
                excess = arb(10) ** -k
                b = 1 + excess
                known = -((1 + (1 + 8 * b * b).sqrt()) / (4 * b)).acos() / arb.pi()
                motion = Scene(touch(f"1e-{k}")).motion()
                self.assertTrue(release_after(motion, LEFT, -arb(1) / 3).time(motion).overlaps(known))
                motion = Scene(touch(f"(-1e-{k})")).motion()
                self.assertTrue(abs(release_after(motion, LEFT, -arb(1) / 3).time(motion) - arb(2) / 3) < excess)

    def test_a_departure_of_third_order(self):
        # The flight begins in a ball of times; from its earlier ones the ball would still be pressed.
        with ctx.workprec(192):
            motion = Scene(touch("1e-6")).motion()
            root = release_after(motion, LEFT, -arb(1) / 3)
            time = root.time(motion)
            with self.assertRaisesRegex(Undecided, "does not leave"):
                Flight(motion, LEFT, time, arb(0), arb(0)).first_contact()
            flight = Flight(motion, LEFT, time, arb(0), arb(0), released=True)
            wall, bracket = flight.first_contact()
            self.assertEqual(wall, LEFT)
            # z'' = m (h + q s - ...) near th = 0: the excursion lasts four times as long as the way to th = 0, nearly.
            self.assertTrue(abs(bracket / -time - 4) < arb("0.01"))
            with self.assertRaises(Undecided):
                Flight(motion, RIGHT, time, motion.gap, arb(0), released=True).first_contact()

    def test_a_bracket_is_refined_at_any_precision(self):
        with ctx.workprec(128):
            root = release_after(Scene(touch("0")).motion(), LEFT, arb("0.01"))
        balls = []
        for bits in (128, 1000, 4000):
            with ctx.workprec(bits):
                balls.append(Root(LEFT, root.bracket).time(Scene(touch("0")).motion()))
                self.assertTrue(balls[-1].contains(arb(fmpq(2, 3))))
                self.assertLess(balls[-1].rad(), arb(2) ** (20 - bits))

    def test_one_harmonic_in_two_terms(self):
        motion = written()[0]
        whole, halves = Scene(motion.tables), Scene(motion.others[1])
        (rows, timeline), (others, other) = listed(whole, 9, 90), listed(halves, 9, 90)
        for verdict in (judge(others, timeline), judge(rows, other)):
            self.assertEqual((verdict.impacts, verdict.proved_end), (90, None))
            self.assertGreater(verdict.rests, 1)
            self.assertEqual(verdict.period(), judge(rows, timeline).period())


class Judges(unittest.TestCase):
    def test_touches_are_exact(self):
        for tables, time in ((inside_graze, fmpq(5, 6)), (wall_graze, fmpq(7, 6))):
            time = type("Time", (), {"numerator": int(time.p), "denominator": int(time.q)})
            check_touch(Scene(tables("0")), RIGHT, time)
            with self.assertRaises(Disagreement):
                check_touch(Scene(tables("1e-30")), RIGHT, time)

    def test_random_scenes(self):
        for tables in several_scenes(8, 7)[:: 2 * FEWER]:
            _, tally = by_stand_in(lambda *rest: judge_scene(*rest[:1], rest[-1], 20, 9, "auto"), tables)
            self.assertEqual((tally["impacts"], tally["beyond"]), (20, 0))
            self.assertTrue(tally["spoiled"] > 0 or tally["rests"] == 0)

    def test_corner_cases(self):
        for corner in several_corners()[3 :: 9 * FEWER]:
            if corner.outcome != "rests-forever":
                self.assertGreater(by_stand_in(judge_one_corner, corner)[0]["spoiled"], 4)
        with mock.patch("orbit.MOST_COARSE_BITS", 128):
            for corner in list(untold_corners())[::FEWER]:
                self.assertEqual(by_stand_in(judge_one_untold, corner)[0]["undecided"], 1)

    def test_another_motion_is_refused(self):
        motion = written()[4]
        self.assertEqual(by_stand_in(judge_one_written, motion)[0]["written"], 3)
        for wrong in (
            Written("the same as another", motion.tables, [], motion.others[0]),
            Written("another as the same", motion.tables, [motion.another], motion.another),
        ):
            with self.assertRaises(Disagreement):
                by_stand_in(judge_one_written, wrong)

    def test_a_period_that_is_not_said(self):
        tables = next(corner.tables for corner in several_corners() if "e = 0, frequencies pi and 2*pi" in corner.name)
        for base, refused in [("pi", True), ("sqrt(10)", False)]:
            excitation = tables["excitation"] | {"frequency": [base, f"2*{base}"]}
            rows, timeline = listed(Scene(tables | {"excitation": excitation}), 9, 20)
            verdict = judge(rows, timeline)
            self.assertIsNotNone(verdict.period())
            silent = {"kind": "impacts-reached"}
            if refused:
                with self.assertRaisesRegex(Disagreement, "period"):
                    judge_period(verdict, silent)
            else:
                judge_period(verdict, silent)
            with self.assertRaisesRegex(Disagreement, "period"):
                judge_period(verdict, {"kind": "periodic", "period": {"cycles": 1, "impacts": 1}})

    def test_periods_are_of_commensurate_frequencies_only(self):
        dead = {corner.name.rpartition(" ")[2]: corner.tables for corner in several_corners() if "e = 0" in corner.name}
        periods = {}
        for name, tables in dead.items():
            rows, timeline = listed(Scene(tables), 9, 20)
            periods[name] = judge(rows, timeline).period()
        self.assertEqual(periods, {"2*pi": (2, 2), "2*sqrt(10)": None})


class Doubles:
    """The same motion by SciPy, in doubles, with its own formula of E''; chatter is cut at flights of 10^-5."""

    SHORT = 1e-5

    def __init__(self, tables):
        with ctx.workprec(64):
            scene = Scene(tables)
            motion = scene.motion()
            self.terms = [tuple(float(x.mid()) for x in term) for term in motion.terms]
            self.gap, self.e = float(motion.gap.mid()), float(motion.restitution.mid())
            self.wall, *start = scene.start()
            self.time, self.y, self.v = (float(x.mid()) for x in start)

    def acceleration(self, t):
        return sum(a * w * w * math.sin(w * t + tau) for a, w, tau in self.terms)

    def pressure(self, t):
        return -self.acceleration(t) if self.wall == LEFT else self.acceleration(t)

    def fly(self):
        """To the next contact."""
        pressure = self.pressure(self.time) if self.wall is not None else 0
        # No step is as long as a bounce: both its ends would lie on the wall.
        longest = min(0.005, 0.4 * abs(self.v) / pressure) if pressure > 0 and self.v != 0 else 0.005
        low, high = (lambda t, s: s[0]), (lambda t, s: s[0] - self.gap)
        low.direction, high.direction, low.terminal, high.terminal = -1, 1, True, True
        found = solve_ivp(
            lambda t, s: (s[1], self.acceleration(t)), (self.time, self.time + 100), (self.y, self.v),
            "DOP853", events=(low, high), rtol=1e-13, atol=1e-15, max_step=longest,
        )
        self.wall = LEFT if len(found.t_events[0]) else RIGHT
        self.time, self.v = found.t[-1], found.y[1, -1]
        self.y = 0.0 if self.wall == LEFT else self.gap

    def release(self):
        """The next time at which the pressure ends, by a scan."""
        t, step = self.time, 1e-3
        while self.pressure(t + step) > 0:
            t += step
        return brentq(self.pressure, t, t + step, xtol=1e-14)

    def events(self, count):
        """[(event, wall, time)], without the flights of chatter after the first short one."""
        found = []
        while len(found) < count:
            if self.wall is not None:
                self.v = -self.e * self.v
                if self.pressure(self.time) > 0 and 2 * abs(self.v) / self.pressure(self.time) < self.SHORT:
                    found.append(("rest", self.wall, self.time))
                    self.time, self.v = self.release(), 0.0
                    found.append(("release", self.wall, self.time))
            self.fly()
            found.append(("impact", self.wall, self.time))
        return found


class SciPy(unittest.TestCase):
    def test_the_same_events(self):
        rests = 0
        for amplitudes, frequencies, phase, e, wall, velocity in [
            (["1", "0.3"], ["1", "sqrt(5)"], "4", "0.3", LEFT, "-0.1"),
            (["1", "1/3", "1/5"], ["pi", "3*pi", "5*pi"], "0", "0.2", RIGHT, "0.5"),
            (["2", "0.5", "0.01"], ["sqrt(2)", "2", "20"], ["1", "2", "3"], "0", LEFT, "-1"),
            (["0.5", "0.4"], ["2", "3"], "pi/2", "0.4", RIGHT, "0.05"),
        ]:
            tables = {
                "excitation": {"amplitude": amplitudes, "frequency": frequencies, "phase": phase},
                "pair": {"gap": "3", "restitution": e}, "start": {"time": "0", "wall": wall, "velocity": velocity},
            }
            rows, _ = listed(Scene(tomllib.loads(toml(tables))), 12, 80)
            proved = [(row["event"], row["wall"], float(row["time_lower"])) for row in rows]
            at = 0
            for kind, wall, time in Doubles(tables).events(25):
                if kind == "rest":
                    # The proved chatter is followed farther.
                    while proved[at][0] == "impact":
                        at += 1
                    rests += 1
                self.assertEqual(proved[at][:2], (kind, wall))
                self.assertAlmostEqual(proved[at][2], time, delta=1e-4 if kind == "rest" else 1e-7)
                at += 1
        self.assertGreater(rests, 8)


if __name__ == "__main__":
    unittest.main()
