"""Tests of the judge of shadowed orbits. Run: python -m unittest discover -s validation/arb"""
import tomllib
import unittest
from pathlib import Path

from flint import arb, ctx

from compare import Disagreement
from controls import printed
from orbit import orbit
from scene import Scene
from shadow import check_own, judge_document

IMPACTS = 60
TEXT = (Path(__file__).resolve().parents[2] / "scenes/figure-14.toml").read_text(encoding="utf-8")


def figure(**start):
    """Figure 14, with another start if one is given."""
    tables = tomllib.loads(TEXT, parse_float=str)
    return Scene(tables | {"start": tables["start"] | start})


def document():
    """Boxes of 10^-13 to each side around an orbit that starts 5 10^-13 slower."""
    impacts, _ = orbit(figure(velocity="-12.5663599999995"), IMPACTS)
    with ctx.workprec(200):
        rows = list(printed(impacts, arb("1e-13")))
    events = [
        {key: row[key] for key in ("event", "mapping", "wall")}
        | {"index": int(row["index"])}
        | {name: [row[f"{name}_lower"], row[f"{name}_upper"]] for name in ("time", "velocity")}
        for row in rows
    ]
    start = {"time": ["0", "0"], "velocity": ["-12.566360000001", "-12.566359999999"]}
    outcome = {"kind": "impacts-reached", "start": start, "epsilon": {"median": "5e-14", "maximum": "5e-14"}}
    return {"certified": True, "claim": "shadowed", "outcome": outcome, "events": events}


class Shadow(unittest.TestCase):
    def test_another_orbit_is_found_in_the_boxes(self):
        self.assertEqual(len(judge_document(figure(), document())), IMPACTS)
        self.assertLess(check_own(figure(), document(), 0), 20)

    def test_an_orbit_that_is_only_near_is_refused(self):
        # The orbit of another gap: a true one, and each impact near, but of no start of this motion.
        wider = figure()
        wider.tables["pair"] = wider.tables["pair"] | {"gap": "9.42497000001"}
        with self.assertRaises(Disagreement):
            judge_document(wider, document())

    def test_the_given_start_must_leave_the_boxes_but_not_before_the_splice(self):
        with self.assertRaisesRegex(Disagreement, "of 60 impacts"):
            check_own(figure(velocity="-12.5663599999995"), document(), 0)
        with self.assertRaisesRegex(Disagreement, "of 60 impacts"):
            check_own(figure(), document(), 50)


if __name__ == "__main__":
    unittest.main()
