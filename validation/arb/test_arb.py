"""Tests of the simulator and of the comparison. Run: python -m unittest discover -s validation/arb"""
import random
import unittest
from pathlib import Path

from flint import arb, ctx, fmpq

from compare import Disagreement, compare
from controls import check_controls, printed
from expression import ExpressionError, evaluate
from flight import Flight, Undecided
from orbit import States, Walk, leave, orbit, orbit_at
from scene import LEFT, RIGHT, Motion, Scene
from simulate import decimals
from tangency import no_resonance

SCENES = Path(__file__).resolve().parents[2] / "scenes"


def scene(figure):
    return Scene.read(SCENES / f"figure-{figure}.toml")


class Resonances(unittest.TestCase):
    def test_a_resonance_is_not_excluded_from_its_order_on(self):
        no_resonance((arb(2), arb("0.25")), 3)
        with self.assertRaises(Undecided):
            no_resonance((arb(2), arb("0.25")), 4)


class Expressions(unittest.TestCase):
    def test_fractions_stay_exact(self):
        for text, value in [
            ("9.42497", fmpq(942497, 100000)), ("-2^2 + 1/4", fmpq(-15, 4)), ("2^3^2", fmpq(512)), ("2^-2", fmpq(1, 4)),
            (".5e1", fmpq(5)), ("1_000.5", fmpq(2001, 2)), ("-(1 - 3)*2/3", fmpq(4, 3)), ("6/3/2", fmpq(1)),
        ]:
            self.assertEqual(evaluate(text), value, text)

    def test_balls_hold_the_value(self):
        with ctx.workprec(200):
            self.assertTrue(evaluate("sqrt(2)^2").contains(2))
            self.assertTrue(evaluate("sin(pi/6)").contains(arb(1) / 2))
            self.assertTrue(evaluate("cos(3*pi)").contains(-1))

    def test_nonsense_is_refused(self):
        for text in ["", "1 +", "2pi", "(1", "1/0", "1/sin(0)", "2^0.5", "[1, 2]", "nan", "1.2.3", "sqrt(-1)", "1.7 +- 0.1", "--1", "2*+ -3", "2^--1"]:
            with self.assertRaises(ExpressionError, msg=text):
                evaluate(text)


class Orbits(unittest.TestCase):
    def test_exact_orbit_of_figure_12(self):
        # Equispaced, (66)-(69): impacts at t = 1, 2, 3, ... with v = 4 pi and -4 pi by turns.
        impacts, bits = orbit(scene("12-exact"), 50)
        with ctx.workprec(bits):
            for impact in impacts:
                self.assertTrue(impact.time.contains(impact.index))
                self.assertTrue(impact.velocity.contains(arb.pi() * (4 if impact.wall == RIGHT else -4)))
                self.assertEqual(impact.mapping, "P2" if impact.wall == RIGHT else "P1")

    def test_box_at_rest(self):
        # Without excitation, from the middle with v = 1: each flight is 1/e times as long as the one before.
        impacts, _ = orbit(Scene({
            "excitation": {"amplitude": 0, "frequency": 1, "phase": 0},
            "pair": {"gap": "1", "restitution": "0.5"},
            "start": {"time": 0, "position": 0, "velocity": 1},
        }), 4)
        for impact, time, speed in zip(impacts, (0.5, 2.5, 6.5, 14.5), (1, 0.5, 0.25, 0.125)):
            self.assertTrue(impact.time.contains(time))
            self.assertTrue(impact.velocity.contains(speed if impact.wall == RIGHT else -speed))
        self.assertEqual([impact.mapping for impact in impacts], [None, "P1", "P2", "P1"])

    def test_few_bits_hold_many_bits(self):
        for figure in (13, 14, 15, 16, 17):
            truth, _ = orbit(scene(figure), 60, 60)
            rough, _, _ = orbit_at(scene(figure), 60, 4, 140, 128)
            self.assertGreater(len(rough), 50)
            for few, many in zip(rough, truth):
                self.assertEqual(few.wall, many.wall)
                self.assertTrue(few.time.contains(many.time) and few.velocity.contains(many.velocity))

    def test_set_holds_the_images_of_its_corners(self):
        # The mean value form with (A.7): both balls are tight, so a wrong Jacobian would lose the corners.
        with ctx.workprec(300):
            walk = Walk(scene(14), 128)
            width = arb(2) ** -60
            start = States.of_balls(LEFT, arb(0, width), arb(fmpq(-1256636, 100000)).mid() + arb(0, width), 128)
            middle, states = start.centre, start
            corners = [(middle[0] + i * width, middle[1] + j * width) for i in (-1, 1) for j in (-1, 1)]
            for _ in range(30):
                for k, ball in enumerate(states.coarse()):
                    self.assertTrue(all(ball.overlaps(corner[k]) for corner in corners))
                wall, after = states.wall, walk.step(states)
                for k, corner in enumerate(corners):
                    flight = leave(walk.fine, wall, *corner)
                    side, bracket = flight.first_contact()
                    corners[k] = flight.land(side, bracket)
                    self.assertEqual(side, after.wall)
                reach = [max(abs(corner[k] - after.centre[k]).mid() for corner in corners) for k in (0, 1)]
                for ball, far in zip(after.balls(), reach):
                    self.assertTrue(far <= ball.rad())
                    self.assertTrue(ball.rad() <= 2 * far)
                states = after


class Flights(unittest.TestCase):
    def test_no_contact_before_the_first(self):
        # A dense scan in balls of single times never sees the ball outside before the proved bracket.
        draw = random.Random(1995)
        for _ in range(150):
            terms = [(arb(draw.uniform(0.1, 3)), arb(draw.uniform(1, 9)), arb(draw.uniform(0, 6)))]
            motion = Motion(terms, arb(draw.uniform(0.5, 3)), arb(1))
            wall = draw.choice((LEFT, RIGHT))
            u = arb(draw.choice((1e-3, 0.1, 1, 10)) * draw.uniform(0.1, 1) * (1 if wall == LEFT else -1))
            with ctx.workprec(128):
                flight = Flight(motion, wall, arb(0), arb(0) if wall == LEFT else motion.gap, u)
                side, bracket = flight.first_contact()
                self.assertTrue(flight.height(bracket).overlaps(flight.level(side)))
                self.assertLess(bracket.rad(), arb(2) ** -100)
                for k in range(1, 500):
                    z = flight.height(bracket.lower() * k / 500)
                    self.assertTrue(0 < z < motion.gap, f"{wall} {u} {k}")


    def test_departures_that_are_not_proved(self):
        with ctx.workprec(128):
            motion = Motion([(arb(1), arb(1), arb(0))], arb(3), arb(1))
            inward, outward = -arb.pi() / 2, arb.pi() / 2
            for wall, time, u in [(LEFT, inward, arb(0)), (RIGHT, outward, arb(0)), (LEFT, arb(1), arb(0, 1e-9))]:
                with self.assertRaises(Undecided):
                    Flight(motion, wall, time, arb(0) if wall == LEFT else motion.gap, u).first_contact()
            # Without velocity the ball leaves the left wall where z'' > 0; from pi/2 it comes back to graze.
            self.assertEqual(Flight(motion, LEFT, arb(1), arb(0), arb(0)).first_contact()[0], RIGHT)
            with self.assertRaisesRegex(Undecided, "near s = .6.2831"):
                Flight(motion, LEFT, outward, arb(0), arb(0)).first_contact()

    def test_a_ball_of_flights_lands_around_its_corners(self):
        with ctx.workprec(128):
            motion, width = Scene.read(SCENES / "figure-14.toml").motion(), arb(2) ** -30
            flights = Flight(motion, LEFT, arb(0, width), arb(0), arb(6, width))
            side, bracket = flights.first_contact()
            landing = flights.land(side, bracket)
            slower = Flight(motion, LEFT, arb(0), arb(0), arb(6, width))
            narrow = slower.land(*slower.first_contact())
            for i, j in [(-1, -1), (-1, 1), (1, -1), (1, 1), (0, -1), (0, 1)]:
                corner = Flight(motion, LEFT, i * width, arb(0), 6 + j * width)
                one = corner.land(*corner.first_contact())
                self.assertTrue(all(ball.contains(point) for ball, point in zip(narrow if i == 0 else landing, one)))


class Comparisons(unittest.TestCase):
    def test_controls(self):
        for figure in (12, 14, 17):
            impacts, _ = orbit(scene(figure), 40)
            for width in (arb("1e-9"), arb("1e-25")):
                rows = list(printed(impacts, width))
                self.assertEqual(compare(rows, impacts), 2 * len(rows))
                self.assertEqual(check_controls(rows, impacts, compare, Disagreement), 10)

    def test_every_kind_of_contradiction_is_refused(self):
        impacts, _ = orbit(scene(14), 1, 20)
        (row,) = printed(impacts, arb("1e-9"))
        high = decimals(impacts[0].time, 60)[1]
        inside = decimals(impacts[0].time.mid(), 80)[0]
        for changes, message in [
            ({"time_lower": "0.6", "time_upper": "0.7"}, "proved to be outside"),
            ({"time_lower": high, "time_upper": high}, "proved to be outside"),
            ({"time_lower": inside, "time_upper": "0.6"}, "the ball sticks out"),
            ({"time_lower": "0.7"}, "the wrong way round"),
            ({"velocity_upper": "nan"}, "is not a decimal"),
            ({"event": "graze"}, "found 'graze,"),
            ({"index": "2"}, "found 'impact,2,"),
        ]:
            with self.assertRaisesRegex(Disagreement, message):
                compare([row | changes], impacts)

    def test_decimals_are_rounded_outward(self):
        third = arb(1) / 3
        self.assertEqual(decimals(third, 3), ("0.333", "0.334"))
        self.assertEqual(decimals(-third, 3), ("-0.334", "-0.333"))
        self.assertEqual(decimals(arb(2), 1), ("2.0", "2.0"))


if __name__ == "__main__":
    unittest.main()
