"""The spoiled lists and the judge themselves."""
import unittest
from fractions import Fraction

from mpmath import mpf

import judge
import lists
from lists import Row
from scene import LEFT, RIGHT, Motion
from spoil import spoil

WALLS = (RIGHT, LEFT, RIGHT, RIGHT, LEFT, RIGHT, LEFT, RIGHT)
ROWS = [Row(str(number), wall, str(number / 8)) for number, wall in enumerate(WALLS, 1)]
TRUTH = [judge.Bounds(row.wall, (Fraction(row.time),) * 2, (Fraction(row.velocity),) * 2) for row in ROWS]
MOTION = Motion(*map(mpf, (1, 2, 0, 1, "0.5")))
TOLERANCE = Fraction("1e-9")


class Spoiling(unittest.TestCase):
    def test_each_copy_differs_and_says_how(self) -> None:
        copies = list(spoil(ROWS, 4))
        self.assertEqual(len({copy.name for copy in copies}), 7)
        for copy in copies:
            self.assertNotEqual(copy.rows, ROWS, copy.name)
            self.assertTrue(copy.expected, copy.name)

    def test_lengths(self) -> None:
        length = {copy.name: len(copy.rows) for copy in spoil(ROWS, 4)}
        self.assertEqual((length["removed"], length["doubled"], length["shifted by 1e-6"]), (7, 9, 8))


class Judging(unittest.TestCase):
    def test_a_right_list_has_no_end(self) -> None:
        self.assertEqual(judge.beginning(ROWS, TRUTH, MOTION, TOLERANCE), (None, None))

    def test_the_first_wrong_impact_is_named(self) -> None:
        found = {copy.name: judge.beginning(copy.rows, TRUTH, MOTION, TOLERANCE) for copy in spoil(ROWS, 2)}
        self.assertEqual(found["on the other wall"], (2, 2))
        self.assertEqual(found["shifted by 1e-6"], (2, None))
        self.assertEqual(found["faster by 1e-6"], (2, None))

    def test_a_tolerance_is_relative_to_the_period(self) -> None:
        # 2 pi/W is pi.
        late = [ROWS[0]._replace(time="1.000000003"), *ROWS[1:]]
        self.assertEqual(judge.beginning(late, TRUTH, MOTION, TOLERANCE).wrong, None)
        later = [ROWS[0]._replace(time="1.0000000032"), *ROWS[1:]]
        self.assertEqual(judge.beginning(later, TRUTH, MOTION, TOLERANCE).wrong, 1)


class Writing(unittest.TestCase):
    def test_walls_are_written_as_people_do(self) -> None:
        self.assertIn("# t side v", lists.savetxt(ROWS))
        self.assertEqual(lists.matlab(ROWS).splitlines()[1].split()[1], "-1.0000000000000000e+00")
        self.assertEqual(lists.tsv_of_positions(ROWS, 0.5).splitlines()[2].split("\t")[2], "-0.5")


if __name__ == "__main__":
    unittest.main()
