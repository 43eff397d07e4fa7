"""The classes of claims, on an orbit known by a theorem: impacts at 1, 2, 3, ... with v = +-4 pi."""
import unittest

from mpmath import mp, mpf

from claims import Verdict, classify, is_earlier, proves_us_wrong
from legs import legs_of
from program import Certified, Event
from scene import LEFT, RIGHT
from simulator import Contact, Listing
from test_flight import EQUISPACED
from verdicts import Drift, drift


def impact(number: int) -> Event:
    """An impact of the equispaced orbit, in bounds of 2e-20."""
    with mp.workdps(50):
        speed = 4 * mp.pi if number % 2 else -4 * mp.pi
        ends = [tuple(mp.nstr(value + side * mpf("1e-20"), 40) for side in (-1, 1)) for value in (mpf(number), speed)]
    return Event("impact", RIGHT if number % 2 else LEFT, *ends)


EVENTS = [impact(number) for number in range(1, 7)]


class Claims(unittest.TestCase):
    legs = legs_of(EQUISPACED, Certified(EVENTS, ""))

    def verdict(self, time: float, wall: str) -> Verdict:
        return classify(self.legs[0], Listing([Contact(time, wall, 1.0)], "impacts"))

    def test_classes_of_a_contact_at_1(self) -> None:
        self.assertEqual(self.verdict(1 + 1e-7, RIGHT), Verdict.RIGHT)
        self.assertEqual(self.verdict(1.001, RIGHT), Verdict.INEXACT)
        self.assertEqual(self.verdict(1.7, RIGHT), Verdict.MISSED)
        self.assertEqual(self.verdict(0.3, RIGHT), Verdict.INVENTED)
        self.assertEqual(self.verdict(0.99, LEFT), Verdict.INVENTED)
        self.assertEqual(classify(self.legs[0], Listing([], "time")), Verdict.MISSED)
        self.assertEqual(classify(self.legs[0], Listing([], "budget")), Verdict.UNKNOWN)

    def test_a_true_contact_proves_a_denial_wrong_and_a_false_one_does_not(self) -> None:
        leg = self.legs[0]
        denial = leg._replace(wall=None, low=mpf("1.01"), high=mpf("1.01"))
        for time in (1 - 1e-9, 1.0, 1 + 1e-9):
            self.assertTrue(proves_us_wrong(denial, Contact(time, RIGHT, 12.5)))
        self.assertFalse(proves_us_wrong(leg, Contact(0.5, RIGHT, 12.5)))
        self.assertFalse(proves_us_wrong(leg, Contact(0.0, LEFT, 0.0)))
        self.assertTrue(is_earlier(leg, Listing([Contact(0.5, RIGHT, 12.5)], "impacts")))

    def test_drift_counts_impacts_from_1(self) -> None:
        times = [1 + 1e-9, 2 - 1e-9, 3.1, 4.0]
        contacts = [Contact(time, leg.wall, 0.0) for time, leg in zip(times, self.legs)]
        self.assertEqual(drift(self.legs[:4], contacts, 1e-12), Drift(1, 3, None, 2))
        self.assertEqual(drift(self.legs, contacts, 1e-3), Drift(3, 3, 5, 2))


if __name__ == "__main__":
    unittest.main()
