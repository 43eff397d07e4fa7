"""Writes arb.md: what was compared with the simulator in Arb balls, and what was found."""
from pathlib import Path

import flint

# Columns of the table: a heading, and the counts that are summed in it.
COLUMNS = [
    ("scenes", ["scenes"]), ("impacts", ["impacts"]), ("rests", ["rests"]), ("releases", ["releases"]),
    ("grazes", ["grazes"]), ("untold grazes", ["untold grazes"]), ("enclosures", ["enclosures"]), ("hold all of the Arb ball", ["held"]),
    ("spoiled copies refused", ["spoiled"]),
]
OUTCOMES = [
    ("all asked for", ["impacts-reached"]), ("periodic", ["periodic"]), ("attracted", ["attracted"]), ("rests for ever", ["rests-forever"]),
    ("never impacts", ["never-impacts"]), ("undecided by impact-pair", ["undecided"]),
    ("of these by auto from exact data", ["undecided by auto"]),
    ("beyond this simulator's proof", ["beyond"]),
]
NOTES = """\
An interval scene is judged by the orbits of 6 members; its impacts, rests and enclosures are counted once a member.
Enclosures that do not hold all of the ball overlap it and are not much wider than it. Every listing of a random scene
was also judged in its mirror image. Undecided are listings that impact-pair itself ends early, most of them in doubles
or by the width of the data; all that they list was judged. Beyond this simulator are scenes with an exact graze, with a
flight too long to follow part by part, or that never impact (followed for 100 periods): judged up to there, and not
counted as proved after it. An untold graze is listed where the arithmetic of a straddling scene (doubles, 64, 128 or 256
bits, or auto in at most 1,024) does not tell a touch from a miss: the proof tells, and what follows was judged with it.
A shadowed orbit is that of a start within the listed bounds, found and then proved."""


def table(totals, columns, heading):
    """A Markdown table, a row for each part."""
    lines = [f"| {heading} | " + " | ".join(name for name, _ in columns) + " |", "|---" * (len(columns) + 1) + "|"]
    for part, total in totals.items():
        lines.append(f"| {part} | " + " | ".join(f"{sum(total[key] for key in keys):,}" for _, keys in columns) + " |")
    return lines


def verdict(totals, failures):
    """One sentence."""
    if failures:
        return f"**{len(failures)} disagreements**: see below."
    impacts, rests = (sum(total[key] for total in totals.values()) for key in ("impacts", "rests"))
    held, all_of_them = (sum(total[key] for total in totals.values()) for key in ("held", "enclosures"))
    spoiled = sum(total["spoiled"] for total in totals.values())
    return (
        f"No disagreement: {impacts:,} impacts and {rests:,} rests proved independently are what impact-pair lists, "
        f"{held:,} of {all_of_them:,} enclosures hold all of the Arb ball, and all {spoiled:,} spoiled copies are "
        "refused."
    )


def write_report(folder, amount, seed, totals, remarks, failures, seconds):
    """DIR/arb.md."""
    lines = ["# impact-pair against an independent simulator in Arb balls", "", verdict(totals, failures), ""]
    lines += table(totals, COLUMNS, "part") + [""] + table(totals, OUTCOMES, "how the listings end") + ["", NOTES, ""]
    for part in totals:
        found = [f"| {name} | {remark} |" for where, name, remark in remarks if where == part]
        if found:
            lines += [f"## {part.capitalize()}", "", f"| {part} | found |", "|---|---|", *found, ""]
    if failures:
        lines += ["## Disagreements", ""] + [f"```text\n{failure}\n```" for failure in failures] + [""]
    lines.append(
        f"Made by `validation/arb/run --report` in {seconds:.0f} s with python-flint {flint.__version__}, seed {seed}, "
        f"{amount.extremes} extreme scenes of {amount.extreme_impacts} impacts, {amount.resting} resting ones of "
        f"{amount.resting_impacts}, {amount.several} with several harmonics of {amount.several_impacts}, {amount.straddling} straddling ones."
    )
    Path(folder).mkdir(parents=True, exist_ok=True)
    (Path(folder) / "arb.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
