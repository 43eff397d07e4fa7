"""Certificates spoiled on purpose: each edit makes one claim false, most by a single unit of a printed bound."""
import copy
from decimal import Decimal


def moved(bound, units):
    """The bound, `units` units of its last place higher."""
    sign, digits, exponent = Decimal(bound).as_tuple()
    mantissa = int("".join(map(str, digits))) * (-1 if sign else 1)
    return f"{mantissa + units}e{exponent}"


def units_to(bound, truth):
    """Number of whole units of the bound's last place that lie between it and the truth."""
    number = Decimal(bound)
    return int(abs(truth - number) // Decimal(1).scaleb(number.as_tuple().exponent))


def edited(document, change):
    """A copy with a change; its outcome counts the impacts that are listed, so that only the motion is wrong."""
    spoiled = copy.deepcopy(document)
    change(spoiled["events"])
    spoiled["outcome"]["impacts"] = sum(event["event"] == "impact" for event in spoiled["events"])
    spoiled["outcome"]["message"] = ""
    return spoiled


def bounds(document, fine):
    """(name, copy): each bound of each impact moved inward by the first unit that passes the truth.

    `fine` is the same orbit with many more digits: the middle of its bounds stands for the truth.
    """
    for i, (event, finer) in enumerate(zip(document["events"], fine["events"], strict=True)):
        if event["event"] != "impact":
            continue
        for key in ("time", "velocity"):
            low, high = map(Decimal, finer[key])
            truth = (low + high) / 2
            for end, sign in ((0, 1), (1, -1)):
                bound = event[key][end]
                past = sign * (units_to(bound, truth) + 1)

                def change(events, i=i, key=key, end=end, bound=bound, past=past):
                    events[i][key][end] = moved(bound, past)

                yield f"{key} of impact {event['index']}", edited(document, change)


def impacts(document):
    """(name, copy): an impact left out, listed twice, on the wrong wall."""
    listed = [i for i, event in enumerate(document["events"]) if event["event"] == "impact"]
    for i in listed[1:-1:7]:
        def skip(events, i=i):
            del events[i]
            renumber(events)

        def twice(events, i=i):
            events.insert(i, copy.deepcopy(events[i]))
            renumber(events)

        def other(events, i=i):
            events[i]["wall"] = "left" if events[i]["wall"] == "right" else "right"
            renumber(events)

        yield f"impact {i + 1} left out", edited(document, skip)
        yield f"impact {i + 1} twice", edited(document, twice)
        yield f"impact {i + 1} on the other wall", edited(document, other)


def renumber(events):
    """Numbers and mappings as the walls have them, so that only the motion is wrong."""
    names = {("left", "right"): "P2", ("right", "left"): "P1", ("right", "right"): "P3", ("left", "left"): "P4"}
    index, before = 0, None
    for event in events:
        if event["event"] == "impact":
            index += 1
            event["index"] = index
            if before is not None:
                event["mapping"] = names[before, event["wall"]]
        before = event["wall"]


def others(document):
    """(name, copy): rests and releases left out or moved."""
    for i, event in enumerate(document["events"]):
        if event["event"] in ("rest", "release"):
            def remove(events, i=i):
                del events[i]

            def late(events, i=i):
                events[i]["time"] = [str(Decimal(bound) + 2) for bound in events[i]["time"]]

            yield f"{event['event']} left out", edited(document, remove)
            yield f"{event['event']} late", edited(document, late)
