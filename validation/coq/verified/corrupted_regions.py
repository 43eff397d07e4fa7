"""Corrupted copies of a trapping region, in documents of `trap`: each claims something that is false, or that the theorem does not cover."""
import copy
import math
from fractions import Fraction


def middle(bounds):
    return sum(map(Fraction, bounds)) / 2


def box_of(document, event):
    """The box, column and row, of an impact of the scene's motion, seen from the left wall."""
    amplitude, frequency = (float(value.replace("pi", str(math.pi)).replace("200*", "")) for value in (document["scene"]["excitation"][key][0] for key in ("amplitude", "frequency")))
    phase = frequency * float(middle(event["time"])) / (2 * math.pi) + (0.5 if event["wall"] == "right" else 0)
    return math.floor(phase % 1 * document["columns"]), math.floor(abs(float(middle(event["velocity"]))) / (amplitude * frequency) * document["rows"])


def without_box(document, box):
    """The region without one box."""
    runs = []
    for column, first, last in document["region"]:
        if column == box[0] and first <= box[1] <= last:
            runs += [[column, first, box[1] - 1]] if first < box[1] else []
            runs += [[column, box[1] + 1, last]] if box[1] < last else []
        else:
            runs.append([column, first, last])
    document["region"] = runs
    document["boxes"] -= 1


def boxes_left_out(document, events):
    """Changes that leave out a box which the scene's motion comes to from another box of the region."""
    boxes = [box_of(document, event) for event in events]
    first = max(document["entered_at_impact"], 1)
    for number in range(first, len(boxes)):
        if boxes[number] != boxes[number - 1]:
            yield f"box {boxes[number]} left out", lambda copied, box=boxes[number]: without_box(copied, box)


def bound(key, at, value):
    return lambda document: document[key].__setitem__(at, value)


def count(step):
    return lambda document: document.update(boxes=document["boxes"] + step)


def runs_exchanged(document):
    document["region"][:2] = document["region"][1::-1]


def run_twice(document):
    document["region"].insert(0, document["region"][0])
    document["boxes"] += document["region"][0][2] - document["region"][0][1] + 1


def beyond_the_grid(document):
    """A box one period on, which is the first one again."""
    column, first, _ = document["region"][0]
    document["region"].append([column + document["columns"], first, first])
    document["boxes"] += 1


def upside_down(document):
    column, first, last = document["region"][0]
    document["region"].insert(0, [column, last + 2, last])
    document["boxes"] -= 1


def last_run_left_out(document):
    _, first, last = document["region"].pop()
    document["boxes"] -= last - first + 1


def scene(**data):
    return lambda document: document["scene"].update(data)


def shaken(**data):
    return lambda document: document["scene"]["excitation"].update(data)


CHANGES = {
    "a box more than there are": count(1), "a box less": count(-1), "runs exchanged": runs_exchanged, "a run twice": run_twice, "a box beyond the grid": beyond_the_grid,
    "a run upside down": upside_down, "the last run left out": last_run_left_out, "no box": lambda document: document.update(region=[], boxes=0, entered_at_impact=1),
    "no box, and no impact in it": lambda document: document.update(region=[], boxes=0, entered_at_impact=None),
    "longer flights": bound("flight", 0, "0.6"), "shorter flights": bound("flight", 1, "0.3"), "flights longer in time": bound("flight_time", 0, "1.2"),
    "flights shorter in time": bound("flight_time", 1, "0.6"), "flights of no duration": bound("flight", 0, "0"), "a shorter longest flight": lambda document: document.update(longest_flight="0.3"),
    "more speed": bound("speed", 0, "2.7"), "less speed": bound("speed", 1, "0.1"), "more speed in the scene's units": bound("speed_before", 0, "20"),
    "less speed in the scene's units": bound("speed_before", 1, "5"), "another restitution": scene(restitution="0.7"), "another gap": scene(gap="11"), "a negative gap": scene(gap="-1"),
    "another amplitude": shaken(amplitude=["5"]), "no amplitude": shaken(amplitude=["0"]), "two harmonics": shaken(amplitude=["8", "1"], frequency=["pi", "1"], phase=["0", "0"]),
    "more columns": lambda document: document.update(columns=2 * document["columns"]), "fewer rows": lambda document: document.update(rows=document["rows"] // 2), "no rows": lambda document: document.update(rows=0),
    "in it from the start on": lambda document: document.update(entered_at_impact=0), "never followed so far": lambda document: document.update(entered_at_impact=10**12),
    "rests": lambda document: document.update(no_rest=False), "not certified": lambda document: document.update(certified=False), "words": lambda document: document.update(words={"impacts": 2, "count": "4", "entropy_at_most": "0.7"}),
    "an orbit document": lambda document: document.update(schema="impact-pair/orbit/1"), "another key": lambda document: document.update(attracts=True),
}


def copies(document, events):
    """(what, copy) of each change; `events` are the first impacts of the scene's motion."""
    for what, change in [*CHANGES.items(), *boxes_left_out(document, events)]:
        copied = copy.deepcopy(document)
        change(copied)
        yield what, copied
