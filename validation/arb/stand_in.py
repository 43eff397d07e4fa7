"""A stand-in for the program under test: prints, with this simulator's own proofs, what a correct program would.

It says nothing of the program. It tests the judges: each must accept this listing and refuse every spoiled copy.
"""
import csv
import io
import json
import tomllib

from flint import arb, ctx

from controls import printed
from listing import chatter_limit, judge, remaining
from scene import Scene
from simulate import HEADER, decimals, exact
from timeline import Timeline

# To add the widths with, and to print with.
BITS, PLACES = 512, 90


def listed(scene, digits, impacts):
    """(rows, timeline): what a correct program would list, made from the proved legs."""
    timeline = Timeline(scene, digits)
    origin, count, rows = timeline.begin(), 0, []
    limit, width = chatter_limit(scene, digits), widths(scene, digits)
    while count < impacts:
        # With e near 1 the rest is too many impacts away to be looked for.
        proved = origin.prove(impacts - count, timeline.spare < 1000)
        left = remaining(0, origin, proved)[0] if proved.rest else None
        for impact in proved.impacts:
            if count == impacts or left is not None and left <= limit:
                break
            count += 1
            placed = impact._replace(index=count, time=origin.shifted(impact.time, proved.bits))
            with ctx.workprec(BITS):
                rows += printed([placed], width, PLACES)
            if proved.rest and exact((proved.rest.time - impact.time).mid()) <= limit:
                break
        if count < impacts or proved.rest and not proved.impacts:
            if proved.rest is None:
                break
            rows.append(still("rest", proved.rest.wall, origin.shifted(proved.rest.time, proved.bits), width))
            origin = origin.next(proved.rest)
            rows.append(still("release", origin.wall, origin.time(proved.bits), width))
    return rows, timeline


def widths(scene, digits):
    """Distance of printed bounds from a ball: a ninth of the requested one."""
    motion = scene.motion()
    return min(motion.period().mid(), motion.speed().mid()) * arb(10) ** -digits / 9


def still(kind, wall, time, width):
    """The row of a rest or a release."""
    empty = dict.fromkeys(("index", "mapping", "velocity_lower", "velocity_upper"), "")
    with ctx.workprec(BITS):
        lower, upper = decimals(time + arb(0, width), PLACES)
    return {"event": kind, "wall": wall, "time_lower": lower, "time_upper": upper, **empty}


def outcome(rows, timeline, impacts):
    """The outcome that these rows show."""
    period = judge(rows, timeline).period()
    if period is not None:
        return {"kind": "periodic", "period": dict(zip(("cycles", "impacts"), period))}
    count = sum(row["event"] == "impact" for row in rows)
    return {"kind": "impacts-reached" if count == impacts else "undecided"}


def as_event(row):
    """A row of the CSV as an event of the JSON Lines."""
    event = {key: row[key] or None for key in HEADER[:4]}
    for name in ("time", "velocity"):
        if row[f"{name}_lower"]:
            event[name] = [row[f"{name}_lower"], row[f"{name}_upper"]]
    return event


def run(binary, text, arguments, form):
    """The lines that `program.run` would give; `binary` is not run."""
    asked = dict(zip(arguments[::2], arguments[1::2]))
    impacts = int(asked["--impacts"])
    rows, timeline = listed(Scene(tomllib.loads(text)), int(asked["--digits"]), impacts)
    if form == "jsonl":
        lines = [{"schema": "stand-in"}, *map(as_event, rows), {"outcome": outcome(rows, timeline, impacts)}]
        return [json.dumps(line) for line in lines]
    page = io.StringIO()
    table = csv.DictWriter(page, HEADER, lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    return page.getvalue().splitlines()
