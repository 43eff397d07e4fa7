"""Tests of rests under several harmonics. Run: python -m unittest discover -s validation/arb"""
import unittest

from flint import arb, ctx, fmpq

from commensurate import common_measure, half_turns
from flight import Flight, Undecided
from release import Root, release_after
from scene import LEFT, RIGHT, Scene
from several_corners import inside_graze, touch


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


if __name__ == "__main__":
    unittest.main()
