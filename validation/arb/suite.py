#!/usr/bin/env python3
"""Judges all parts of `parts.py` with two processes; prints what was found, and writes a report if asked to.

At any disagreement the scene is printed and the exit code is 1. What could not be proved is counted, and too much of
it is a disagreement.

Run: suite.py --binary PATH [--quick] [--report DIR] [--seed S] [--part NAME ...] [--scenes N] [--show]
"""
import argparse
import sys
import time
from collections import Counter
from multiprocessing import Pool

from compare import Disagreement
from flight import Undecided
from parts import FULL, PARTS, QUICK, SEVERAL, STRADDLING, jobs
from report import write_report

PROCESSES = 2
# Least share of the resting scenes with small e or small A/d that come to rest; with fewer the scenes are badly drawn.
RESTING = 0.6
# Greatest share of scenes that may end before all was compared: undecided, in doubles above all, or beyond this proof. Of
# the straddling scenes about a third do: most offsets of 10^-17 to 10^-60 vanish in 64 bits, and without drift no impact comes.
CUT_SHORT = {"resting scenes": 0.2, "extreme scenes": 0.1, SEVERAL: 0.1, STRADDLING: 0.4}
# Greatest share of the scenes that `auto` runs, in 1,024 bits, that may be undecided.
STRADDLING_AUTO = 0.3
# Least share of the scenes with several harmonics that come to rest.
SEVERAL_RESTING = 0.3


def judge_job(task):
    """(number, Counter, remark, failure or None) of one job."""
    number, job, binary = task
    try:
        tally, remark = job.judge(*job.arguments, binary)
        return number, tally, remark, None
    except (Disagreement, Undecided, OSError, ValueError) as error:
        return number, Counter(), "", f"{job.name}: {error}\n{job.scene}"


def judge_all(todo, binary, show):
    """({part: Counter}, [(part, job, remark)], failures) of all jobs."""
    totals, remarks, failures = {job.part: Counter() for job in todo}, [], []
    with Pool(PROCESSES) as pool:
        tasks = [(number, job, binary) for number, job in enumerate(todo)]
        for number, tally, remark, failure in pool.imap(judge_job, tasks, chunksize=1):
            job = todo[number]
            totals[job.part] += tally
            if remark:
                remarks.append((job.part, job.name, remark))
            if failure:
                failures.append(failure)
                print(f"DISAGREEMENT: {failure}", file=sys.stderr, flush=True)
            if show or job.part == "figures":
                print(f"{job.name}: {remark or dict(tally)}", flush=True)
    return totals, remarks, failures


def check_shares(totals):
    """The reasons why a comparison has too few decided cases to mean anything."""
    for part, share in CUT_SHORT.items():
        total = totals.get(part, Counter())
        short = total["undecided"] + total["beyond"]
        if short > max(1, share * total["scenes"]):
            yield f"{part}: {short} of {total['scenes']} are undecided or beyond this proof"
    calm = totals.get("resting scenes", Counter())
    if calm["calm_resting"] < RESTING * calm["calm"]:
        yield f"only {calm['calm_resting']} of {calm['calm']} scenes of small A/d or e come to rest"
    straddling = totals.get(STRADDLING, Counter())
    if straddling["undecided by auto"] > max(1, STRADDLING_AUTO * straddling["by auto"]):
        yield f"{straddling['undecided by auto']} of {straddling['by auto']} straddling scenes are undecided by auto"
    several = totals.get(SEVERAL, Counter())
    if several["resting"] < SEVERAL_RESTING * several["scenes"]:
        yield f"only {several['resting']} of {several['scenes']} scenes with several harmonics come to rest"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", required=True, help="the program under test")
    parser.add_argument("--quick", action="store_true", help="less of everything")
    parser.add_argument("--report", metavar="DIR", help="write DIR/arb.md")
    parser.add_argument("--seed", type=int, default=1995, help="of the scenes with intervals")
    parser.add_argument("--scenes", type=int, help="how many of the recorded scenes of each kind, and how many with intervals")
    parser.add_argument("--part", action="append", choices=PARTS, help="only this part; may be repeated")
    parser.add_argument("--show", action="store_true", help="a line for each job")
    asked = parser.parse_args()
    amount = QUICK if asked.quick else FULL
    if asked.scenes is not None:
        kinds = ("resting", "extremes", "several", "straddling", "intervals")
        amount = amount._replace(**dict.fromkeys(kinds, asked.scenes))
    began = time.monotonic()
    totals, remarks, failures = judge_all(jobs(amount, asked.seed, asked.part), asked.binary, asked.show)
    for thin in check_shares(totals):
        failures.append(thin)
        print(f"DISAGREEMENT: {thin}", file=sys.stderr)
    for part, total in totals.items():
        print(f"{part}: " + ", ".join(f"{count} {name}" for name, count in sorted(total.items()) if count))
    if asked.report:
        write_report(asked.report, amount, asked.seed, totals, remarks, failures, time.monotonic() - began)
    if failures:
        sys.exit(f"{len(failures)} disagreements")


if __name__ == "__main__":
    main()
