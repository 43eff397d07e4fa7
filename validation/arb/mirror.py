"""Mirror images: left and right changed, in scenes and in what is listed of them."""
from compare import Disagreement, bounds
from listing import stretches
from scene import LEFT, RIGHT
from simulate import negated

OTHER = {LEFT: RIGHT, RIGHT: LEFT}
MIRRORED = {"P1": "P2", "P2": "P1", "P3": "P4", "P4": "P3", "": ""}


def opposite(text):
    """Minus an expression."""
    return f"-({text})"


def half_turned(phase):
    """The phase half a forcing period on."""
    return f"({phase}) + pi"


def mirror(tables):
    """Left and right changed: y and y' negated, and E by tau + pi."""
    excitation, first = dict(tables["excitation"]), dict(tables["start"])
    phase = excitation["phase"]
    excitation["phase"] = [half_turned(each) for each in phase] if isinstance(phase, list) else half_turned(phase)
    for key in ("position", "velocity"):
        if key in first:
            first[key] = opposite(first[key])
    if "wall" in first:
        first["wall"] = OTHER[first["wall"]]
    return {"excitation": excitation, "pair": dict(tables["pair"]), "start": first}


def reflected(rows):
    """Rows of the mirror image as rows of the scene itself."""
    for row in rows:
        lower, upper = row["velocity_lower"], row["velocity_upper"]
        swapped = {"velocity_lower": upper and negated(upper), "velocity_upper": lower and negated(lower)}
        yield row | {"wall": OTHER[row["wall"]], "mapping": MIRRORED[row["mapping"]]} | swapped


def keyed(rows):
    """The times of the rows by key: the number of rests before, the number of impacts since (or the event), and the wall."""
    for number, stretch in enumerate(stretches(rows)):
        for place, row in enumerate(stretch.impacts):
            yield (number, place, row["wall"]), bounds(row, "time")
        for row in (stretch.rest, stretch.release):
            if row is not None:
                yield (number, row["event"], row["wall"]), bounds(row, "time")


def check_overlap(rows, others):
    """Both listings hold the same times, as far as both go; a tie may end a chatter one impact sooner or later."""
    others = dict(keyed(others))
    for key, (lower, upper) in keyed(rows):
        low, high = others.get(key, (lower, upper))
        if high < lower or upper < low:
            raise Disagreement(f"{key}: another time")
