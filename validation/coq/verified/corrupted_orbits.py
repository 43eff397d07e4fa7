"""Corrupted copies of periodic orbits, in documents of `periodic` and in outcomes `attracted`: each claims something that is false."""
import copy
from decimal import Decimal

OTHER = {"left": "right", "right": "left"}
OTHER_NAME = {"P1": "P2", "P2": "P1", "P3": "P4", "P4": "P3"}
OTHER_STABILITY = {"stable": "unstable", "unstable": "stable"}


def moved(bounds, amount):
    return [f"{Decimal(text) + amount:f}" for text in bounds]


def beside(path):
    """Bounds of a number of the orbit, three widths higher, or a thousandth where they have no width."""
    def change(orbit):
        *folders, last = path
        for key in folders:
            orbit = orbit[key]
        low, high = map(Decimal, orbit[last])
        orbit[last] = moved(orbit[last], 3 * (high - low) or Decimal("0.001"))
    return change


def other(key, values):
    return lambda orbit: orbit.update({key: values[orbit[key]]})


def without_last(orbit):
    del orbit["impacts"][-1]


def from_the_next(orbit):
    orbit["impacts"].append(orbit["impacts"].pop(0))


def exchanged_walls(orbit):
    for impact in orbit["impacts"]:
        impact["wall"] = OTHER[impact["wall"]]


def no_lower_eigenvalue(orbit):
    orbit["eigenvalues"][1] = orbit["eigenvalues"][0]


ORBITS = {
    "another phase": beside(("impacts", 1, "phase")), "another first phase": beside(("impacts", 0, "phase")), "another velocity": beside(("impacts", 1, "velocity")),
    "another first velocity": beside(("impacts", 0, "velocity")), "another trace": beside(("trace",)), "another determinant": beside(("determinant",)),
    "another eigenvalue": beside(("eigenvalues", 0, "re")), "another second eigenvalue": beside(("eigenvalues", 1, "re")),
    "another imaginary part": beside(("eigenvalues", 0, "im")), "one eigenvalue twice": no_lower_eigenvalue,
    "other symmetry": other("symmetric", {True: False, False: True}), "other stability": other("stability", OTHER_STABILITY),
    "a virtual orbit": other("physical", {True: False}), "one of several": other("unique", {True: False}), "an impact left out": without_last,
    "from the next impact on": from_the_next, "on the other walls": exchanged_walls, "symmetry not decided": lambda orbit: orbit.update(symmetric=None),
    "stability not decided": lambda orbit: orbit.update(stability="undecided"), "a key of the orbit": lambda orbit: orbit.update(period=1),
}


def other_mapping(head):
    first, *more = head["word"].split(" ")
    head["word"] = " ".join([OTHER_NAME[first], *more])


# Of the object that holds the word: the outcome `attracted`, or the whole document of `periodic`.
HEADS = {
    "another word": other_mapping, "a longer word": lambda head: head.update(word=f"{head['word']} {head['word']}"),
    "more cycles": lambda head: head.update(cycles=head["cycles"] + 1), "no cycles": lambda head: head.update(cycles=0),
}
PERIODIC = {
    "exhaustive": lambda document: document.update(exhaustive=True), "not certified": lambda document: document.update(certified=False),
    "an orbit document": lambda document: document.update(schema="impact-pair/orbit/1"),
    "another amplitude": lambda document: document["scene"]["excitation"].update(amplitude=["1.0001"]),
    "two harmonics": lambda document: document["scene"]["excitation"].update(amplitude=["1", "1"], frequency=["pi", "1"], phase=["0", "0"]),
    "a negative gap": lambda document: document["scene"].update(gap="-1"), "none of the orbits": lambda document: document.update(orbits=[]),
}


def nearest_listed(document):
    """From the next impact of the same wall on, with the word as it is: two impacts a round make it another one only with an odd number."""
    document["outcome"]["from"] += 1


def attracted_changes(document):
    yield "from one impact later", nearest_listed
    yield "from after the last impact", lambda copied: copied["outcome"].update({"from": len(copied["events"]) + 1})
    yield "no orbit", lambda copied: copied["outcome"].pop("orbit")
    for what, change in HEADS.items():
        yield what, lambda copied, change=change: change(copied["outcome"])
    for what, change in ORBITS.items():
        yield what, lambda copied, change=change: change(copied["outcome"]["orbit"])


def periodic_changes(document):
    yield from PERIODIC.items()
    yield from HEADS.items()
    for number, _ in enumerate(document["orbits"]):
        for what, change in ORBITS.items():
            yield f"{what} (orbit {number})", lambda copied, number=number, change=change: change(copied["orbits"][number])


def copies(document):
    """(what, copy) of each change of a document of `periodic`, or of an orbit with an outcome `attracted`."""
    is_attracted = "outcome" in document
    for what, change in attracted_changes(document) if is_attracted else periodic_changes(document):
        copied = copy.deepcopy(document)
        change(copied)
        if is_attracted:
            copied["outcome"]["message"] = ""
        yield what, copied
