"""The judge of data/score.py: right answers are right, spoiled ones are not."""
import json
import unittest

import jsonschema

import score


def truth(name):
    """A simulator that knows the certified impacts of a set, by its scenes."""
    known = {repr(line["doubles"]): line for line in score.read(name)}

    def simulate(scene, until, impacts):
        events = [event for event in known[repr(scene)]["events"] if event["event"] == "impact"]
        return [(float(event["time"][0]), event["wall"], float(event["velocity"][0])) for event in events[:impacts]]

    return simulate


def changed(name, change):
    known = truth(name)
    return lambda *question: change(known(*question))


def right(name, simulate):
    """(asked, right) over a set."""
    rows = score.score(simulate, [name])
    return sum(row[1] for row in rows), sum(row[2] for row in rows)


class Score(unittest.TestCase):
    def test_certified_impacts_are_right(self):
        for name in score.SETS:
            asked, found = right(name, truth(name))
            self.assertEqual(asked, found, name)

    def test_what_is_spoiled_is_not(self):
        other = {"left": "right", "right": "left"}
        changes = {
            "nothing": lambda found: [],
            "late": lambda found: [(time + 1e-3 * (1 + abs(time)), wall, velocity) for time, wall, velocity in found],
            "the other wall": lambda found: [(time, other[wall], velocity) for time, wall, velocity in found],
        }
        for name in score.SETS:
            misses = sum(not score.impacts(line) for line in score.read(name))
            for words, change in changes.items():
                _, found = right(name, changed(name, change))
                self.assertLessEqual(found, misses if name != "orbits" else 0, f"{name}: {words}")

    def test_a_contact_that_is_none_is_invented(self):
        rows = score.score(lambda scene, until, impacts: [(scene["start"]["time"] + 1e-9, "left", -1.0)], ["flights"])
        self.assertTrue(all(row[2] == 0 for row in rows if "miss" in row[0] or "falls short" in row[0]))

    def test_an_error_is_a_failure(self):
        def fails(*_):
            raise RuntimeError

        rows = score.score(fails, ["flights", "chatters"])
        self.assertTrue(all(row[2] == 0 and row[3] == {"failed": row[1]} for row in rows))

    def test_sets_are_as_large_as_promised(self):
        self.assertEqual([len(score.read(name)) for name in score.SETS], [242, 40, 60])

    def test_lines_fit_the_schema(self):
        schema = json.loads((score.HERE / "schema.json").read_text(encoding="utf-8"))
        validator = jsonschema.Draft202012Validator(schema)
        for name in score.SETS:
            for line in score.read(name):
                validator.validate(line)
        line["events"][0]["time"] = [0.0, 1.0]
        self.assertFalse(validator.is_valid(line))

    def test_expressions(self):
        self.assertEqual(score.number("2*pi"), 6.283185307179586)
        self.assertEqual(score.number("10^3*sqrt(4)"), 2000.0)
        with self.assertRaises(ValueError):
            score.number("__import__('os')")


if __name__ == "__main__":
    unittest.main()
