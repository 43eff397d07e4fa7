"""Writes closed-forms.md: what was compared with the closed forms, and what was found."""
from collections import Counter
from pathlib import Path

import mpmath

from checks import EQUISPACED, UNEQUISPACED
from two_impact import DIGITS

COLUMNS = [
    ("orbits", "orbits"), ("physical", "physical"), ("an earlier contact", "earlier"),
    ("enclosures that hold the value", "enclosures"), ("refused, as they must be", "refused"),
]
STABILITY = [
    ("stable", "eigenvalues inside the unit circle, and tan th0 in its range"),
    ("unstable", "eigenvalues outside, and tan th0 out of its range"),
    ("identities", "orbits on which (38), det = e^4 and both forms of the trace hold, and (39) does not"),
    ("derivatives", "orbits on which (A.7) is the derivative, by central differences"),
    ("shrinks", "orbits whose v, changed by 10^-6, comes back by 100 or more, in certified bounds"),
    ("grows", "orbits whose v, changed by 10^-6, leaves by 10 or more, in certified bounds"),
    ("not followed", "physical orbits too near to a graze or to the boundary to be followed"),
    ("half maps", "pairs of impacts in a row that meet after (t + N pi/W, y -> -y)"),
    ("mirrored runs", "motions off the orbit that were run with their half-map image, and meet it throughout"),
]


def verdict(totals, claims, failures):
    """One sentence."""
    if failures:
        return f"**{len(failures)} disagreements**: see below."
    total = sum(totals.values(), Counter())
    return (
        f"No disagreement: {total['enclosures']:,} enclosures hold the {DIGITS}-digit values of {total['orbits']:,} "
        f"closed forms or of the earlier contact that forbids them, {total['refused']:,} wrong ones are refused, and "
        f"{len(claims)} misprints of the paper are decided."
    )


EARLIER = """\
An orbit with an earlier contact is one that its own flight forbids: the program must show that contact instead, at its
place. Refused are listings of such orbits, of N even with e < 1, of v changed by 10^-9 and of the wrong sign of
sin th0.
"""
FIGURE_15 = """\
Text after (53): figure 15 has 2 impacts on the right and 3 on the left a cycle, word P2 P3 P1 P4 P4: m and n count
impacts if the exponents are m - 1 and n - 1.
"""


def write_report(folder, totals, ends, claims, failures, seconds):
    """DIR/closed-forms.md."""
    lines = ["# impact-pair against the closed forms (61)-(73)", "", verdict(totals, claims, failures), ""]
    lines += ["| family | " + " | ".join(name for name, _ in COLUMNS) + " |", "|---" * (len(COLUMNS) + 1) + "|"]
    for part, total in totals.items():
        lines.append(f"| {part} | " + " | ".join(f"{total[key]:,}" for _, key in COLUMNS) + " |")
    equal, unequal = totals[EQUISPACED], totals[UNEQUISPACED]
    lines += ["", EARLIER, "## Equispaced orbits with e < 1", "", "| count | what |", "|---|---|"]
    lines += [f"| {equal[key]:,} | {text} |" for key, text in STABILITY]
    lines += [f"| {ends} | claims at the ends of the stable range: (40), A_pf and A_sn |", ""]
    lines += [f"Of the orbits of (62), (63) {unequal['stable']} are stable and {unequal['unstable']} are not; "
              f"{unequal['even and stable']} are stable, physical and have N even.", ""]
    if claims:
        lines += ["## Misprints", "", "| form | the right one leaves | the printed one leaves |", "|---|---|---|"]
        for claim in claims:
            lines.append(f"| {claim.name} | {mpmath.nstr(claim.right, 2)} | {mpmath.nstr(claim.printed, 2)} |")
        lines += ["", FIGURE_15]
    if failures:
        lines += ["## Disagreements", ""] + [f"```text\n{failure}\n```" for failure in failures] + [""]
    lines.append(f"Made by `validation/closed_forms/run --report` in {seconds:.0f} s with mpmath {mpmath.__version__}.")
    Path(folder).mkdir(parents=True, exist_ok=True)
    (Path(folder) / "closed-forms.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
