"""Scenes and the closed form, against what the theory says."""
import unittest
from fractions import Fraction

from mpmath import mp, mpf

from adversarial import DEPTHS, flights, rises
from flight import extrema, fly
from scene import LEFT, RIGHT, SIGN, Scene, Start, doubles, evaluate, rounded

EQUISPACED = Scene("1", "pi", "0", "3*pi", "0.5", "0", LEFT, "-4*pi")  # (66), (67): impacts at 1, 2, 3, ...


class Scenes(unittest.TestCase):
    def test_expressions_are_exact(self) -> None:
        with mp.workdps(60):
            self.assertEqual(evaluate("9.42497"), mpf(942497) / 100000)
            self.assertEqual(evaluate("-(10*pi - 1/4)"), mpf("0.25") - 10 * mp.pi)
        for wrong in ("__import__('os')", "e", "2**3"):
            with self.assertRaises(ValueError):
                evaluate(wrong)

    def test_the_ball_leaves_inward_by_eq_15(self) -> None:
        self.assertAlmostEqual(float(EQUISPACED.start().after), 6.283185307179586)


class Flights(unittest.TestCase):
    def test_the_equispaced_orbit_is_on_the_other_wall_half_a_cycle_later(self) -> None:
        with mp.workdps(50):
            motion, start = EQUISPACED.motion(), EQUISPACED.start()
            flight = fly(motion, start)
            self.assertLess(abs(flight.height(mpf(1)) - motion.gap / 2), mpf("1e-45"))
            self.assertLess(abs(flight.velocity(mpf(1)) - 4 * mp.pi), mpf("1e-45"))
            near = fly(doubles(motion), rounded(start)).height(0.3)
            self.assertAlmostEqual(near, float(flight.height(mpf("0.3"))), 13)

    def test_extrema_are_all_zeros_of_the_velocity(self) -> None:
        with mp.workdps(50):
            motion, start = EQUISPACED.motion(), Start(mpf("0.3"), LEFT, mpf("-1.5"))
            velocity = fly(motion, start).velocity
            found = list(extrema(motion, start, mpf(20)))
            self.assertTrue(all(abs(velocity(time)) < 1e-45 for time in found))
            times = [mpf("0.3") + mpf(count) / 1000 for count in range(1, 19701)]
            signs = [velocity(time) > 0 for time in times]
            self.assertEqual(len(found), sum(a != b for a, b in zip(signs, signs[1:])))

    def test_hard_flights_are_aimed_to_their_depth_and_mirrored(self) -> None:
        with mp.workdps(50):
            hard = [one for one in flights(True) if one.family == "graze, far wall"]
            self.assertEqual(len({one.scene for one in hard}), len(hard))
            for one, image in zip(hard[::2], hard[1::2]):
                gap = mpf(one.scene.gap)
                depths = [top / gap - 1 for _, top in rises(one.scene, 4)]
                self.assertLess(min(abs(found / mpf(depth) - 1) for found in depths for depth in DEPTHS), 1e-3)
                ours, theirs = (fly(each.scene.motion(), each.scene.start()) for each in (one, image))
                time = mpf(one.scene.time) + mpf("0.2")
                self.assertLess(abs(ours.height(time) + theirs.height(time)), mpf("1e-40"))
                self.assertEqual(image.scene.wall, RIGHT)

    def test_decimals_have_17_digits_at_most(self) -> None:
        for one in flights(True):
            self.assertLess(abs(Fraction(one.scene.gap) / Fraction(float(one.scene.gap)) - 1), Fraction(1, 2**53))
            self.assertEqual(SIGN[one.scene.wall] > 0, not one.scene.before.startswith("-"))


if __name__ == "__main__":
    unittest.main()
