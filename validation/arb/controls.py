"""Negative controls: spoiled copies of rows that agree, each of which a comparison must refuse."""
from fractions import Fraction

from simulate import decimals, ends, negated


def decimal_above(ball, tiny):
    """A decimal above all of a ball, by less than about `tiny`."""
    places = len(str(int(1 / tiny)))
    value = ends(ball)[1] + tiny
    units = int(value * 10**places // 1)
    return f"{units}e-{places}"


def spoiled(rows, impacts):
    """(name, copy) pairs; the middle impact is the one that is spoiled."""
    at = len(rows) // 2
    row, impact = rows[at], impacts[at]
    other = {"left": "right", "right": "left"}[row["wall"]]

    def changed(**values):
        return rows[:at] + [row | values] + rows[at + 1 :]

    yield "an impact removed", rows[:at] + rows[at + 1 :]
    yield "an impact removed, the rest numbered anew", [
        kept | {"index": str(index)} for index, kept in enumerate(rows[:at] + rows[at + 1 :], 1)
    ]
    yield "the last impact removed", rows[:-1]
    yield "an impact twice", rows[: at + 1] + rows[at:]
    yield "the other wall", changed(wall=other)
    yield "another mapping", changed(mapping="P1" if row["mapping"] != "P1" else "P3")
    for name in ("time", "velocity"):
        lower, upper = (Fraction(row[f"{name}_{side}"]) for side in ("lower", "upper"))
        tiny = max(upper - lower, Fraction(1, 10**40)) / 10**6
        past = decimal_above(getattr(impact, name), tiny)
        yield f"lower bound of the {name} just above the truth", changed(
            **{f"{name}_lower": past, f"{name}_upper": past if Fraction(past) > upper else row[f"{name}_upper"]}
        )
        yield f"both bounds of the {name} negated", changed(
            **{f"{name}_lower": negated(row[f"{name}_upper"]), f"{name}_upper": negated(row[f"{name}_lower"])}
        )


def check_controls(rows, impacts, compare, refusal):
    """Number of corrupted copies refused; all must be."""
    count = 0
    for name, copy in spoiled(rows, impacts):
        try:
            compare(copy, impacts)
        except refusal:
            count += 1
        else:
            raise refusal(f"negative control: a copy with {name} was not refused")
    return count


def printed(impacts, width, places=40):
    """The impacts as rows with bounds that stand away from each ball by about `width` on both sides."""
    for impact in impacts:
        row = {"event": "impact", "index": str(impact.index), "mapping": impact.mapping or "", "wall": impact.wall}
        for name in ("time", "velocity"):
            ball = getattr(impact, name)
            row[f"{name}_lower"] = decimals(ball - width, places)[0]
            row[f"{name}_upper"] = decimals(ball + width, places)[1]
        yield row
