"""Each reference where it must do well, and where it must not hang."""
import unittest

from runs import SIMULATORS, Question, answer
from scene import RIGHT, Scene, doubles, rounded
from simulator import Contact, bounce
from test_flight import EQUISPACED

CHATTER = Scene("1", "pi", "pi", "9.42497", "0.3", "0", "left", "-0.5")


def question(scene: Scene, until: float, limit: int) -> Question:
    return Question(doubles(scene.motion()), rounded(scene.start()), until, limit)


class Simulators(unittest.TestCase):
    def test_all_see_the_equispaced_orbit(self) -> None:
        for simulator in SIMULATORS:
            contacts = answer(simulator, question(EQUISPACED, 100.0, 4)).listing.contacts
            self.assertEqual(len(contacts), 4)
            for number, contact in enumerate(contacts, 1):
                self.assertLess(abs(contact.time - number), max(20 * simulator.tolerance, 1e-11), simulator.name)
                self.assertEqual(contact.wall == RIGHT, number % 2 == 1)

    def test_all_stop_at_the_end_of_time(self) -> None:
        for simulator in SIMULATORS:
            self.assertEqual(answer(simulator, question(EQUISPACED, 2.5, 9)).listing.ended, "time", simulator.name)

    def test_none_hangs_in_a_chatter(self) -> None:
        for simulator in SIMULATORS:
            self.assertLessEqual(len(answer(simulator, question(CHATTER, 5.0, 60)).listing.contacts), 60)

    def test_a_bounce_leads_inward(self) -> None:
        motion = doubles(EQUISPACED.motion())
        self.assertEqual(bounce(motion, Contact(1.0, RIGHT, 2.0)).after, -1.0)
        self.assertEqual(bounce(motion, Contact(1.0, "left", 2.0)).after, 1.0)


if __name__ == "__main__":
    unittest.main()
