"""Corrupted copies of a horseshoe, in documents of `chaos`: each claims something that is false, or that the theorem does not cover, or that is not the canonical form."""
import copy
import re
from fractions import Fraction


def more(text, by="0.001"):
    """A decimal, more by so much."""
    return f"{float(Fraction(text) + Fraction(by)):.12f}"


def moved(base, by):
    """An h-set somewhere else, all that is said of it."""
    for side in base["corners"].values():
        for corner in side:
            corner[0] += by / 6.283185307179586
    base["phase"] = f"{float(base['phase']) + by:.12f}"


def thinner(base):
    """An h-set half as thick, all that is said of it; its ends stay in place."""
    for bottom, top in base["corners"].values():
        for n in (0, 1):
            middle, half = (bottom[n] + top[n]) / 2, (top[n] - bottom[n]) / 4
            bottom[n], top[n] = middle - half, middle + half
    base["contracting"] = [f"{float(length) / 2:.12f}" for length in base["contracting"]]


def changes(document):
    """(what, change): functions that change a copy of the document."""
    def with_entropy(key):
        return lambda copied: copied["entropy"].update({key: more(copied["entropy"][key])})

    for key in ("per_impact", "per_cycle"):
        yield f"entropy {key} too large", with_entropy(key)
    yield "no positive entropy", lambda copied: copied["entropy"].update(per_impact="0", per_cycle="0")
    yield "a word left out", lambda copied: copied["words"].pop(0)
    yield "a word twice", lambda copied: copied["words"].append(copied["words"][0])
    yield "a word from another h-set", lambda copied: copied["words"][0].update({"from": (copied["words"][0]["from"] + 1) % len(copied["bases"])})
    yield "a word into another h-set", lambda copied: copied["words"][0].update(to=(copied["words"][0]["to"] + 1) % len(copied["bases"]))
    yield "a word into no h-set", lambda copied: copied["words"][0].update(to=len(copied["bases"]))
    yield "two half cycles more", lambda copied: copied["words"][0].update(half_cycles=copied["words"][0]["half_cycles"] + 2)
    yield "a half cycle more", lambda copied: copied["words"][0].update(half_cycles=copied["words"][0]["half_cycles"] + 1)
    yield "flights to other walls", lambda copied: copied["words"][0].update(flights=copied["words"][0]["flights"].translate(str.maketrans("NF", "FN")))
    yield "a flight more", lambda copied: copied["words"][0].update(flights=copied["words"][0]["flights"] + "F", impacts=copied["words"][0]["impacts"] + 1)
    yield "impacts that are not the flights", lambda copied: copied["words"][0].update(impacts=copied["words"][0]["impacts"] + 1)
    yield "an h-set somewhere else", lambda copied: moved(copied["bases"][0], 0.1)
    yield "an h-set a forcing period later", lambda copied: moved(copied["bases"][-1], 6.283185307179586)
    yield "an h-set twice", lambda copied: copied["bases"].append(copied["bases"][0])
    yield "an h-set half as thick", lambda copied: thinner(copied["bases"][copied["words"][0]["to"]])
    yield "a middle beside the corners", lambda copied: copied["bases"][0].update(phase=more(copied["bases"][0]["phase"]))
    yield "half vectors beside the corners", lambda copied: copied["bases"][0]["expanding"].reverse()
    yield "corners in another order", lambda copied: copied["bases"][0]["corners"]["left"].reverse()
    yield "an h-set across", lambda copied: copied["bases"][0].update(corners={"left": copied["bases"][0]["corners"]["right"], "right": copied["bases"][0]["corners"]["left"]})
    yield "blocks that are none", lambda copied: copied.update(horseshoe=re.sub(r"(\d+) half cycles", lambda found: f"{int(found[1]) + 2} half cycles", copied["horseshoe"]))
    yield "one block twice", lambda copied: copied.update(horseshoe=twice(copied["horseshoe"]))
    yield "another gap", lambda copied: copied["scene"].update(gap="9.3")
    yield "another restitution", lambda copied: copied["scene"].update(restitution="0.6")
    yield "an amplitude of 0", lambda copied: copied["scene"]["excitation"].update(amplitude=["0"])
    yield "what becomes of the scene's orbit", lambda copied: copied.update(scene_orbit={"attracted": None, "region": {"boxes": 431, "entered_at_impact": 2, "holds_bases": True}})
    yield "not certified", lambda copied: copied.update(certified=False)
    yield "an unknown key", lambda copied: copied.update(chaotic=True)


def twice(sentence):
    """A sentence on two blocks with the first one in both places."""
    before, after = sentence.split(" or ", 1)
    block = before.split("each block is ")[1]
    return f"{before} or {block}{after[after.index(')') + 1:]}"


def copies(document):
    """(what, copy) of all changes."""
    for what, change in changes(document):
        copied = copy.deepcopy(document)
        change(copied)
        yield what, copied
