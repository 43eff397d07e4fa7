"""Tests of the machinery: the map, first contacts, Krawczyk's operator, contraction, growth, reading of scenes."""
import unittest

from flint import arb, arb_mat, ctx

from attract import contraction
from closed import Equispaced
from contact import Undecided, first_contact
from finding import Failed, excludes, tiny
from horseshoe import balance, every_sequence
from listed import ORBITS, listed
from lyapunov import exponent
from pair import LEFT, RIGHT, Pair, ball, name
from periodic import Orbit, Refused, find, krawczyk, prove
from program import bounds, number


class Case(unittest.TestCase):
    """All tests at 128 bits."""

    def setUp(self):
        ctx.prec = 128


class TheMap(Case):
    """pair.py."""

    def test_words_have_the_first_mapping_last(self):
        self.assertEqual(name([RIGHT, RIGHT, LEFT, LEFT]), "P2 P4 P1 P3")

    def test_slopes_are_the_implicit_derivative_of_the_jacobian(self):
        pair, th0, v0 = Pair(3, "0.6"), arb("0.4"), arb(-2)
        contact = first_contact(pair, LEFT, th0, v0)
        v1 = pair.drift(th0, v0) - contact.th.cos()
        by_this, by_next = pair.slopes(th0, v0, contact.th)
        implicit = arb_mat(by_next).inv() * arb_mat(by_this) * -1
        for one, other in zip(implicit.entries(), pair.jacobian(th0, v0, contact.th, v1).entries()):
            self.assertTrue(one.overlaps(other) and one.rad() < 1e-20)

    def test_fractions_and_decimals_are_exact(self):
        self.assertTrue((ball("1/3") * 3 - 1).contains(0) and (ball("0.1") * 10 - 1).contains(0))


class FirstContact(Case):
    """contact.py."""

    def test_a_set_of_starts_is_enclosed(self):
        pair, th0, v0 = Pair(3, "0.6"), arb("0.4", "0.001"), arb(-2, "0.001")
        whole = first_contact(pair, LEFT, th0, v0)
        for th in (th0.lower(), th0.upper()):
            for v in (v0.lower(), v0.upper()):
                self.assertTrue(whole.th.contains(first_contact(pair, LEFT, th, v).th))

    def test_a_narrow_gap_is_crossed_at_once(self):
        contact = first_contact(Pair("0.001", 1), LEFT, arb("0.4"), arb(-5))
        self.assertTrue(contact.wall == RIGHT and contact.th - arb("0.4") < 0.001)

    def test_a_graze_is_undecided(self):
        self.assertRaises(Undecided, first_contact, Pair(1 / arb("0.4"), "0.5"), RIGHT, -arb.pi() / 2, arb(0))

    def test_a_graze_cut_or_missed_by_1e_9_is_detected(self):
        # z' = c - cos th vanishes first at th = 2 pi - acos c, a maximum; the gap is its height -+ 1e-9.
        th0, v = arb.pi() / 2 + arb("0.5"), -arb("0.4")
        c = -v + th0.cos()
        top = 2 * arb.pi() - c.acos()
        height = c * (top - th0) - top.sin() + th0.sin()
        cut, missed = (first_contact(Pair(height + x, 1), LEFT, th0, v) for x in (arb("-1e-9"), arb("1e-9")))
        self.assertTrue(cut.wall == RIGHT and cut.th < top)
        self.assertTrue(missed.wall == LEFT or missed.th > top + 1)


class Proofs(Case):
    """periodic.py and attract.py."""

    def test_krawczyk_encloses_the_square_root_of_two(self):
        def problem(x):
            return arb_mat([[x[0] * x[0] - 2]]), arb_mat([[2 * x[0]]])
        self.assertTrue(krawczyk(problem, [arb("1.4")], arb("0.01"))[0].overlaps(arb(2).sqrt()))

    def test_krawczyk_refuses_a_double_zero_beside_a_simple_one(self):
        def problem(x):
            return arb_mat([[x[0] * x[0] - 2], [x[1] * x[1]]]), arb_mat([[2 * x[0], 0], [0, 2 * x[1]]])
        self.assertRaises(Refused, krawczyk, problem, [arb("1.4"), arb("0.1")], arb("0.01"))

    def test_an_orbit_that_touches_a_wall_earlier_is_refused(self):
        family = Equispaced("0.05")
        th0 = family.pitchfork_phase()
        orbit = Orbit(family.pair(th0), 1, family.states(th0))
        for miss in orbit.misses():
            tiny(miss, "the equations")
        self.assertRaises(Refused, orbit.require_first_contacts)

    def test_a_wrong_number_of_cycles_is_refused(self):
        seed = ORBITS["N = 2"]
        self.assertRaises((Refused, Undecided), find, Pair(1 / ball(seed.ratio), seed.e), LEFT, seed.th, seed.v, 2, 7)

    def test_an_unstable_orbit_is_no_contraction(self):
        family = Equispaced("0.8")
        th0 = family.pitchfork_phase() - arb("0.01")
        orbit = prove(family.pair(th0), family.states(th0), 1)
        self.assertFalse(orbit.stable())
        self.assertRaises(Refused, contraction, orbit, arb("1e-6"))

    def test_growth_along_a_periodic_orbit_is_its_eigenvalue(self):
        orbit = listed("equispaced, A = 0.51 d")
        states = [(wall, th + 2 * k * arb.pi(), v) for k in range(200) for wall, th, v in orbit.states]

        class Listing:
            """As program.Run."""
            pair, start, impacts = orbit.pair, states[0], states[1:]
        self.assertLess(abs(exponent(Listing) - orbit.eigenvalues()[1].log() / 2), 0.02)


class Sequences(Case):
    """horseshoe.py."""

    def test_equal_flights_are_the_equispaced_orbit(self):
        family = Equispaced("0.9", 5)
        th0 = family.phase(1 / arb("0.036"))
        tiny(balance(1 / arb("0.036"), family.e, (5, 5), (th0, th0, th0)), "F")

    def test_alternating_flights_obey_the_equations_of_the_map(self):
        orbit = listed("N = 2")
        (_, th0, v0), (_, th1, _) = orbit.states
        # Flights of odd half periods M = 1, N = 3 between the phases th0 and th1, each told in its mirror.
        y, z = th0, th1 - arb.pi()
        tiny(balance(orbit.pair.gap, orbit.pair.e, (3, 1), (z, y, z)), "F")
        tiny(balance(orbit.pair.gap, orbit.pair.e, (1, 3), (y, z, y)), "F")

    def test_a_window_without_a_change_of_sign_fails(self):
        self.assertRaises(Failed, every_sequence, "0.036", "0.9", (5, 7), "-1.4", "-0.9")

    def test_slow_drift_fails(self):
        self.assertRaises(Failed, every_sequence, "0.036", "0.9", (9, 11), "-2", "-1")


class Expectations(Case):
    """finding.py fails on what is not proved."""

    def test_tiny_and_excludes(self):
        self.assertRaises(Failed, tiny, arb("0.1"), "x")
        self.assertRaises(Failed, tiny, arb(0, 1), "x")
        self.assertRaises(Failed, excludes, arb(0, 1), "x")


class Scenes(Case):
    """program.py reads expressions and bounds exactly."""

    def test_expressions(self):
        self.assertTrue(number("-14/(20000*pi)").overlaps(-arb(14) / 20000 / arb.pi()))
        self.assertTrue(number("0.1^2").contains(arb("0.01")))

    def test_bounds_hold_both_ends(self):
        held = bounds(["0.1", "0.3"])
        self.assertTrue(held.contains(arb("0.1")) and held.contains(arb("0.3")))


if __name__ == "__main__":
    unittest.main()
