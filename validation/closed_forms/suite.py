#!/usr/bin/env python3
"""Checks the closed forms (61)-(73) in 50 digits and the program's enclosures of them; fails at any disagreement.

Run: suite.py --binary PATH [--quick] [--report DIR]
"""
import argparse
import sys
import time
from collections import Counter
from multiprocessing import Pool
from pathlib import Path

from checks import check_formulas, jobs
from program import Disagreement
from report import write_report

PROCESSES = 2
# --quick takes every `THIN`-th orbit.
THIN = 20
SCENES = Path(__file__).resolve().parents[2] / "scenes"


def do(task):
    """(part, Counter, failure or None) of one job."""
    job, binary = task
    try:
        return job.part, job.check(job.orbit, binary, job.number), None
    except (Disagreement, ValueError, ArithmeticError) as error:
        return job.part, Counter(), f"{job.part}, number {job.number}: {error}"


def check_orbits(binary, thin):
    """({part: Counter}, failures)."""
    todo = jobs(thin)
    totals, failures = {job.part: Counter() for job in todo}, []
    with Pool(PROCESSES) as pool:
        for part, tally, failure in pool.imap(do, [(job, binary) for job in todo], chunksize=4):
            totals[part] += tally
            if failure:
                failures.append(failure)
                print(f"DISAGREEMENT: {failure}", file=sys.stderr, flush=True)
    return totals, failures


def missing(totals):
    """Kinds of orbits of which there must be some, or the comparison is too thin."""
    total = sum(totals.values(), Counter())
    for kind in ("physical", "earlier", "stable", "unstable", "shrinks", "grows", "solid", "dashed", "even and stable"):
        if not total[kind]:
            yield f"there is no orbit of the kind {kind!r}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", required=True, help="the program under test")
    parser.add_argument("--quick", action="store_true", help="fewer orbits")
    parser.add_argument("--report", metavar="DIR", help="write DIR/closed-forms.md")
    asked = parser.parse_args()
    began = time.monotonic()
    totals, failures = check_orbits(asked.binary, THIN if asked.quick else 1)
    failures += missing(totals)
    try:
        ends, claims = check_formulas(asked.binary, SCENES)
    except Disagreement as error:
        failures.append(str(error))
        ends, claims = 0, []
    for part, total in totals.items():
        print(f"{part}: " + ", ".join(f"{count} {name}" for name, count in total.items() if count))
    print(f"{ends} claims at the ends of the stable range hold; {len(claims)} misprints are decided")
    if asked.report:
        write_report(asked.report, totals, ends, claims, failures, time.monotonic() - began)
    if failures:
        sys.exit("DISAGREEMENT:\n" + "\n".join(failures))


if __name__ == "__main__":
    main()
