"""Corrupted copies of an orbit document: each claims something that is false, or that the theorem does not cover."""
import copy
import random
from decimal import Decimal

NAMES = {("left", "right"): "P2", ("right", "left"): "P1", ("right", "right"): "P3", ("left", "left"): "P4"}
OTHER = {"left": "right", "right": "left"}


def shifted(bounds, widths):
    """The interval, `widths` of its own widths higher."""
    low, high = map(Decimal, bounds)
    return [f"{low + widths * (high - low):f}", f"{high + widths * (high - low):f}"]


def places(document, kind):
    """Numbers of the events of one kind."""
    return [number for number, event in enumerate(document["events"]) if event["event"] == kind]


def renumber(document):
    """Numbers, mappings and count as the walls have them, so that only the motion is wrong."""
    before, index = document["scene"]["start"].get("wall"), 0
    for event in document["events"]:
        if event["event"] == "impact":
            index += 1
            event.update(index=index, mapping=NAMES.get((before, event["wall"])))
        before = event["wall"]
    document["outcome"]["impacts"] = index
    document["outcome"]["message"] = ""


def shift(key, at, widths):
    return lambda document: document["events"][at].update({key: shifted(document["events"][at][key], widths)})


def swap(document):
    document["events"][1], document["events"][2] = document["events"][2], document["events"][1]
    renumber(document)


def drop(document):
    del document["events"][1]
    renumber(document)


def twice(document):
    document["events"].insert(1, copy.deepcopy(document["events"][1]))
    renumber(document)


def wall(document):
    document["events"][2]["wall"] = OTHER[document["events"][2]["wall"]]
    renumber(document)


def set_at(path, value):
    def change(document):
        *folders, last = path
        for key in folders:
            document = document[key]
        document[last] = value(document[last]) if callable(value) else value
    return change


def scaled(text):
    """A number, larger by a thousandth."""
    return f"{text}*1.001"


def until_later(document):
    """All impacts up to a time by which there is another one."""
    last = Decimal(document["events"][-1]["time"][1])
    document["outcome"] = {"kind": "time-reached", "message": "", "impacts": len(places(document, "impact")), "until": f"{last + 100:f}"}


def until_earlier(document):
    """All impacts up to a time before the last one listed."""
    first = Decimal(document["events"][0]["time"][1])
    document["outcome"] = {"kind": "time-reached", "message": "", "impacts": len(places(document, "impact")), "until": f"{first:f}"}


def empty(document):
    """A gap of no value at all."""
    document["scene"]["gap"] = "[10, 9]"


def rest(document):
    document["events"].append({"event": "rest", "wall": "left", "time": ["1000", "1001"], "skipped": "infinite"})


CHANGES = {
    "a time higher": shift("time", 1, 3), "a time lower": shift("time", -1, -3), "a velocity higher": shift("velocity", 2, 3),
    "a velocity lower": shift("velocity", 0, -3), "an impact left out": drop, "an impact twice": twice, "two impacts exchanged": swap,
    "an impact on the other wall": wall, "another mapping": set_at(["events", 1, "mapping"], lambda name: "P4" if name != "P4" else "P3"),
    "no mapping": set_at(["events", 1, "mapping"], None), "another index": set_at(["events", 2, "index"], 7),
    "another restitution": set_at(["scene", "restitution"], scaled), "another gap": set_at(["scene", "gap"], scaled),
    "no gap": empty, "another amplitude": set_at(["scene", "excitation", "amplitude", 0], scaled),
    "another frequency": set_at(["scene", "excitation", "frequency", 0], scaled),
    "another phase": set_at(["scene", "excitation", "phase", 0], lambda text: f"{text}+0.001"),
    "another start": set_at(["scene", "start", "time"], "0.001"), "a start from outside": set_at(["scene", "start", "wall"], "right"),
    "another count": set_at(["outcome", "impacts"], lambda count: count + 1), "another message": set_at(["outcome", "message"], "7 impacts"),
    "another outcome": set_at(["outcome", "kind"], "rests-forever"), "more than is listed": until_later, "less than is listed": until_earlier,
    "a rest": rest, "not certified": set_at(["certified"], False), "a shadowed orbit": set_at(["claim"], "shadowed"),
    "another schema": set_at(["schema"], "impact-pair/periodic/1"), "a period": set_at(["outcome", "period"], {"cycles": 1, "impacts": 2}),
}


def nearer(document):
    """A shadowed orbit whose impacts are a million times nearer to the middles of their bounds."""
    document["outcome"]["epsilon"] = {key: f"{Decimal(value) / 10**6:f}" for key, value in document["outcome"]["epsilon"].items()}
    document["outcome"]["message"] = ""


def start_elsewhere(document):
    """A shadowed orbit whose start is not near the scene's."""
    start = document["outcome"]["start"]
    start.update({key: shifted(bounds, 3) for key, bounds in start.items()})


SHADOWED = {
    "nearer impacts": nearer, "a start elsewhere": start_elsewhere, "of the exact start": set_at(["claim"], "exact start"),
    "no start": lambda document: document["outcome"].pop("start"), "no epsilon": lambda document: document["outcome"].pop("epsilon"),
}


def of(kind, change):
    """A change of the first event of one kind."""
    return lambda document: change(document, document["events"][places(document, kind)[0]])


def leave_out(*kinds):
    """The first events of these kinds left out; impacts keep their numbers."""
    def change(document):
        for kind in kinds:
            del document["events"][places(document, kind)[0]]
    return change


def move(kind, widths):
    return of(kind, lambda _, event: event.update({"time": shifted(event["time"], widths)}))


def narrowed(kind, shares):
    """The bounds of an event, cut to a part of them."""
    def change(_, event):
        low, high = map(Decimal, event["time"])
        event["time"] = [f"{low + Decimal(share) * (high - low):f}" for share in shares]
    return of(kind, change)


def at_the_wrong_end(document, event):
    """A release half a forcing period late, where the wall begins to press the ball."""
    event["time"] = [f"{Decimal(text) + 1:f}" for text in event["time"]]


def until_in_the_rest(document):
    """All events up to a time before the release that is listed."""
    document["outcome"]["until"] = document["events"][places(document, "rest")[0]]["time"][1]


def cut_short(document):
    """A chatter with the false claim that it ends three impacts earlier, with bounds that hold the impacts left out."""
    at = places(document, "rest")[0]
    document["events"][at]["time"] = document["events"][at - 3]["time"]
    del document["events"][at - 3:at]
    renumber(document)


def on_the_other_wall(_, event):
    event["wall"] = OTHER[event["wall"]]


def other_skip(_, event):
    event["skipped"] = "some"


def other_way(_, event):
    """Infinitely many impacts instead of none, or none instead of infinitely many."""
    if event.pop("skipped", None) is None:
        event["skipped"] = "infinite"


RESTS = {
    "a rest later": move("rest", 3), "a rest earlier": move("rest", -3), "no rest": leave_out("rest"), "no release": leave_out("release"),
    "neither rest nor release": leave_out("rest", "release"), "a rest on the other wall": of("rest", on_the_other_wall),
    "a release from the other wall": of("release", on_the_other_wall), "other impacts before the rest": of("rest", other_way),
    "a rest with other words": of("rest", other_skip), "a release at the wrong end of the rest": of("release", at_the_wrong_end),
    "a release earlier": of("release", lambda _, event: event.update({"time": ["0.99", "0.995"]})),
    "a release before the rest": of("release", lambda _, event: event.update({"time": ["0.1", "0.15"]})),
    "a release just earlier": of("release", lambda _, event: event.update({"time": ["0.99999999", "0.999999999999"]})),
    "a release just later": of("release", lambda _, event: event.update({"time": ["1.000000000001", "1.000000001"]})),
    "a chatter that ends earlier": cut_short, "less of the rest": narrowed("rest", ("0", "0.4")), "the wrong part of the rest": narrowed("rest", ("-3", "0")),
    "a time inside the rest": until_in_the_rest, "a key of an impact": of("release", lambda _, event: event.update({"index": 3})),
    "a velocity of a rest": of("rest", lambda _, event: event.update({"velocity": ["0", "0"]})),
}


def period(**other):
    def change(document):
        document["outcome"]["period"] |= other
        document["outcome"]["message"] = ""
    return change


REPEATS = {
    "more cycles each time": period(cycles=10), "fewer cycles each time": period(cycles=8), "no cycles each time": period(cycles=0),
    "more impacts each time": period(impacts=24), "fewer impacts each time": period(impacts=22), "two times for one": period(impacts=46, cycles=18),
    "no period": lambda document: document["outcome"].pop("period"), "a word": set_at(["outcome", "word"], "P2 P1"),
    "one time not in full": lambda document: (document["events"].__delitem__(slice(places(document, "release")[1], None)), renumber(document)),
    "a period of nothing": lambda document: (document["events"].__delitem__(slice(8, None)), renumber(document)),
    "a key of the period": period(walls=2),
}


def copies(document):
    """(what, copy) of each change."""
    more = {**(SHADOWED if document["claim"] == "shadowed" else {}), **(RESTS if places(document, "rest") else {}),
            **(REPEATS if document["outcome"]["kind"] == "periodic" else {})}
    for what, change in {**CHANGES, **more}.items():
        if (what == "a shadowed orbit" and document["claim"] == "shadowed") or (what == "a period" and document["outcome"]["kind"] == "periodic"):
            continue
        spoiled = copy.deepcopy(document)
        change(spoiled)
        yield what, spoiled


def leaves(value, path=()):
    """Paths of all values that are no lists or objects."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else None
    if items is None:
        yield path
    else:
        for key, item in items:
            yield from leaves(item, (*path, key))


def at_random(document, count):
    """(what, copy) with a digit or word changed at random, from a fixed seed."""
    seeded = random.Random(1995)
    paths = [path for path in leaves(document) if path[0] not in ("program", "arithmetic")]
    for _ in range(count):
        path = seeded.choice(paths)

        def change(value, seeded=seeded):
            if isinstance(value, bool) or value is None:
                return not value
            if isinstance(value, int):
                return value + seeded.choice((-1, 1))
            text = str(value)
            digits = [i for i, letter in enumerate(text) if letter.isdigit()]
            if not digits:
                return seeded.choice(("left", "right", "P1", "P3", "pi", ""))
            at = seeded.choice(digits)
            return type(value)(text[:at] + seeded.choice("0123456789") + text[at + 1:])

        spoiled = copy.deepcopy(document)
        set_at(list(path), change)(spoiled)
        yield f"{'.'.join(map(str, path))} changed", spoiled
