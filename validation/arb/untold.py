"""Continuations of a graze that the precision does not distinguish from a miss: the proof decides, and the rows are compared with it.

Such a graze is listed in place of an impact or of nothing, and what follows encloses both continuations. The proved
orbit says which: the graze is replaced by the proved impact, or left out, and the rows are those of a plain listing.
"""
from flint import arb, ctx

from compare import bounds
from controls import printed
from listing import stretches
from simulate import ends

# Decimal places of the impact that stands for a graze.
PLACES = 100


def merged(rows, timeline):
    """The rows without grazes, as far as the proof goes: from a graze on that it does not tell they are cut off."""
    while True:
        at = next((at for at, row in enumerate(rows) if row["event"] == "graze"), None)
        if at is None:
            return rows
        origin, before = last_leg(rows[:at], timeline)
        if origin is None:
            return rows[: at + 1]
        proved = origin.prove(before + 2, False)
        if len(proved.impacts) <= before and proved.reason is not None:
            return rows[: at + 1]
        listed = sum(row["event"] == "impact" for row in rows[:at])
        hit = [impact_row(origin, proved, before, listed + 1)] if is_hit(rows[at], origin, proved, before) else []
        rows = rows[:at] + hit + list(after(rows[at + 1 :], proved, before, len(hit)))


def last_leg(rows, timeline):
    """(origin, n): the leg that these rows end in, and how many of its impacts are listed; None if it is not proved."""
    origin, impacts = timeline.begin(), 0
    for stretch in stretches(rows):
        impacts = len(stretch.impacts)
        if stretch.rest is not None:
            proved = origin.prove(impacts, True)
            if proved.rest is None:
                return None, 0
            origin, impacts = origin.next(proved.rest), 0
    return origin, impacts


def is_hit(graze, origin, proved, before):
    """True if the next proved impact is the touch that the graze may be."""
    if len(proved.impacts) <= before:
        return False
    impact = proved.impacts[before]
    low, high = ends(origin.shifted(impact.time, proved.bits))
    lower, upper = bounds(graze, "time")
    return impact.wall == graze["wall"] and lower <= high and low <= upper


def impact_row(origin, proved, before, index):
    """A proved impact as a row."""
    impact = proved.impacts[before]
    with ctx.workprec(proved.bits):
        placed = impact._replace(index=index, time=origin.shifted(impact.time, proved.bits))
        return next(iter(printed([placed], arb(0), PLACES)))


def after(rows, proved, before, hit):
    """The rows after a graze, counted with it; the mapping that leads away from one is judged where it is named."""
    is_next = True
    for row in rows:
        if row["event"] == "impact":
            row = row | {"index": str(int(row["index"]) + hit)}
            if is_next and len(proved.impacts) > before + hit:
                row["mapping"] = row["mapping"] or proved.impacts[before + hit].mapping or ""
        is_next = False
        yield row
