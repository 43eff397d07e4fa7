"""Checks the paper's claims one by one: `claims.py [--quick] [--report DIR] [CLAIM ...]`, all without a name.

Prints each finding; exits 1 if an expectation fails, 2 for an unknown name. With --report DIR writes DIR/paper.md.
"""
import argparse
import sys
import time
from pathlib import Path

from flint import ctx

import breaking
import chaos
import doubles
import equispaced
import even
import figure15
import horseshoe
import manifolds
import misprints
import models
import regular
import rest
import scaling
import stability
import threshold
from contact import Undecided
from finding import Failed
from periodic import Refused

BITS = 160
MODULES = (models, stability, equispaced, breaking, even, manifolds, threshold, horseshoe, regular, chaos,
           doubles, figure15, scaling, rest, misprints)
CLAIMS = {name: findings for module in MODULES for name, findings in module.CLAIMS.items()}


def check(name, quick):
    """The findings of a claim, and its seconds; an expectation that fails raises Failed, Refused or Undecided."""
    ctx.prec, begin = BITS, time.monotonic()
    return CLAIMS[name](quick), time.monotonic() - begin


def cell(text):
    """Text for a Markdown table."""
    return text.replace("|", "\\|")


def write(directory, rows, failures):
    """DIR/paper.md: the report."""
    verdict = (f"{len(rows)} findings on the paper's claims, all as expected." if not failures
               else f"{len(failures)} claims are not as expected: {'; '.join(failures)}.")
    lines = ["# The paper's claims, checked", "", verdict, "",
             "| claim | verdict | numbers | command |", "|---|---|---|---|"]
    for name, finding in rows:
        lines.append(f"| {cell(finding.statement)} | {finding.verdict} | {cell(finding.numbers)} | "
                     f"`validation/paper/run {name}` |")
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "paper.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    """Runs the requested claims."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer impacts")
    parser.add_argument("--report", type=Path, metavar="DIR", help="write DIR/paper.md")
    parser.add_argument("claims", nargs="*", metavar="CLAIM", help="one of: " + ", ".join(CLAIMS))
    options = parser.parse_args()
    if unknown := [name for name in options.claims if name not in CLAIMS]:
        parser.error(f"unknown claim {unknown[0]}: known are {', '.join(CLAIMS)}")
    rows, failures = [], []
    for name in options.claims or CLAIMS:
        try:
            findings, seconds = check(name, options.quick)
        except (Failed, Refused, Undecided) as reason:
            failures.append(f"{name}: {reason}")
            print(f"{name}: FAILED: {reason}", flush=True)
            continue
        print(f"{name} ({seconds:.1f} s)")
        for finding in findings:
            rows.append((name, finding))
            print(f"  {finding.verdict}: {finding.statement}: {finding.numbers}", flush=True)
    if options.report:
        write(options.report, rows, failures)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
