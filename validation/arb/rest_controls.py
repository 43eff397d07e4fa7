"""Negative controls for listings with rests: spoiled copies that a judgement must refuse."""
from fractions import Fraction

from compare import bounds
from simulate import decimal_below

PLACES = 160
OTHER = {"left": "right", "right": "left"}


def moved(row, by, name="time"):
    """The row with its time later by so much, exactly enough, or another quantity larger."""
    return row | {
        f"{name}_{side}": decimal_below(value + by, PLACES)
        for side, value in zip(("lower", "upper"), bounds(row, name))
    }


def past(row, period):
    """A little more than the width of the row's time, and more than 0."""
    lower, upper = bounds(row, "time")
    return Fraction(101, 100) * (upper - lower) + period / 10**20


def renumbered(rows):
    """The rows with indices that count their impacts."""
    count, copy = 0, []
    for row in rows:
        if row["event"] == "impact":
            count += 1
            row = row | {"index": str(count)}
        copy.append(row)
    return copy


def spoiled(rows, period, limit):
    """(name, copy) pairs; the last rest that has a release is the one that is spoiled."""
    releases = [at for at, row in enumerate(rows) if row["event"] == "release"]
    if not releases:
        return
    at = releases[-1] - 1
    rest, release = rows[at : at + 2]
    other = OTHER[rest["wall"]]

    def changed(*new):
        return rows[:at] + list(new) + rows[at + 2 :]

    for sign, word in ((1, "later"), (-1, "earlier")):
        yield f"a rest {word} by more than its width", changed(
            moved(rest, sign * past(rest, period)), release
        )
        yield f"a release {word} by more than its width", changed(rest, moved(release, sign * past(release, period)))
        yield f"a release one cycle {word}", changed(rest, moved(release, sign * period))
    if rows[at + 2 :]:
        # Otherwise the copy only ends sooner.
        yield "a rest and its release left out", changed()
        yield "a release left out", changed(rest)
    yield "a rest left out", changed(release)
    yield "a rest on the other wall", changed(rest | {"wall": other}, release)
    yield "a release from the other wall", changed(rest, release | {"wall": other})
    yield "a rest with a velocity", changed(rest | {"velocity_lower": "0", "velocity_upper": "0"}, release)
    if at > 0 and rows[at - 1]["event"] == "impact":
        yield from spoiled_chatter(rows, at, limit)


def spoiled_chatter(rows, at, limit):
    """The same for the impacts before the rest in row `at`; a chatter of the length `limit` may end the listing."""
    keep = at
    while keep > 0 and rows[keep - 1]["event"] == "impact":
        keep -= 1
        if keep > 0 and bounds(rows[at], "time")[0] - bounds(rows[keep - 1], "time")[1] > limit:
            yield "the last impacts of a chatter left out", renumbered(rows[:keep] + rows[at:])
            break
    yield "the last impact of a chatter twice", renumbered(rows[:at] + rows[at - 1 :])
    if at > 1 and rows[at - 2]["event"] == "impact":
        yield "an impact of a chatter left out", renumbered(rows[: at - 2] + rows[at - 1 :])


def spoiled_first(rows, period):
    """(name, copy) pairs; the first event, if it is an impact, is the one that is spoiled."""
    if not rows or rows[0]["event"] != "impact":
        return
    row, rest = rows[0], rows[1:]
    yield "the first impact on the other wall", [row | {"wall": OTHER[row["wall"]]}, *rest]
    lower, upper = bounds(row, "velocity")
    for sign, word in ((1, "larger"), (-1, "smaller")):
        by = sign * (Fraction(101, 100) * (upper - lower) + abs(lower) / 10**20)
        yield f"a first velocity {word} by more than its width", [moved(row, by, "velocity"), *rest]
    yield "the first impact earlier by more than its width", [moved(row, -past(row, period)), *rest]
    if not rest:
        yield "the first impact later by more than its width", [moved(row, past(row, period))]
    elif bounds(row, "time")[1] < bounds(rest[0], "time")[0]:
        yield "the first impact left out", renumbered(rest)


def check_first_controls(rows, period, judge, refusal):
    """The same for the first impact."""
    return refused(spoiled_first(rows, period), judge, refusal)


def check_rest_controls(rows, period, limit, judge, refusal):
    """Number of corrupted copies refused; all must be."""
    return refused(spoiled(rows, period, limit), judge, refusal)


def refused(copies, judge, refusal):
    """Number of the copies refused; all must be."""
    count = 0
    for name, copy in copies:
        try:
            judge(copy)
        except refusal:
            count += 1
        else:
            raise refusal(f"negative control: a copy with {name} was not refused")
    return count
