#!/usr/bin/env python3
"""Has `impact-pair check` judge certificates of `impact-pair run`: right ones are confirmed, spoiled ones are not.

Run: suite.py --program PATH [--checker PATH] [--report DIR] [--quick]
"""
import argparse
import json
import re
import subprocess
import sys
import time
from decimal import getcontext
from pathlib import Path

import edits

getcontext().prec = 200
# Seconds that no answer may take.
TIMEOUT = 60
# The last have several harmonics.
FOLDERS = [Path("scenes"), Path("validation/certificates/scenes")]
# Of these all events are spoiled, one by one; digits for the truth beside them.
SPOILED = ["figure-13", "figure-14", "figure-17", "chatter", "incommensurate", "square-wave", "quasi-periodic-rests"]
SPOILED_IMPACTS, FINE_DIGITS = 12, 60
CONFIRMED = re.compile(r"confirmed: (\d+) events and the outcome, in (\d+) bits")


def run(program, scene, impacts, digits=None):
    """The orbit JSON of a scene."""
    options = ["--impacts", str(impacts), "--format", "json", "--quiet"]
    if digits:
        options += ["--digits", str(digits)]
    try:
        done = subprocess.run([program, "run", scene, *options], capture_output=True, text=True, check=False, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        raise SystemExit(f"error: {scene}: no orbit in {TIMEOUT} s") from None
    if done.returncode == 2 or not done.stdout:
        raise SystemExit(f"error: {scene}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def check(program, document):
    """(exit code, what it says, seconds)."""
    start = time.perf_counter()
    command = [program, "check", "-", "--quiet"]
    try:
        done = subprocess.run(command, input=json.dumps(document), capture_output=True, text=True, check=False, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        return 2, f"no verdict in {TIMEOUT} s", TIMEOUT
    return done.returncode, (done.stdout or done.stderr).strip(), time.perf_counter() - start


def right(arguments, failures):
    """Rows of the table of certificates as they are."""
    rows = []
    for scene in [scene for folder in FOLDERS for scene in sorted(folder.glob("*.toml"))]:
        impacts = 60 if arguments.quick else 200
        counts = [impacts] + ([2000] if scene.stem == "figure-14" and not arguments.quick else [])
        for count in counts:
            document = run(arguments.program, scene, count)
            code, said, seconds = check(arguments.checker, document)
            found = CONFIRMED.match(said)
            if code != 0 or not found:
                failures.append(f"{scene.stem}, {count} impacts: {said}")
                continue
            rows.append(f"| {scene.stem} | {found[1]} | {document['outcome']['kind']} | {found[2]} | {seconds:.2f} |")
    return rows


def wrong(arguments, failures):
    """(rows, count) of spoiled certificates."""
    rows, total = [], 0
    for name in SPOILED:
        scene = next(scene for folder in FOLDERS if (scene := folder / f"{name}.toml").exists())
        document = run(arguments.program, scene, SPOILED_IMPACTS)
        fine = run(arguments.program, scene, SPOILED_IMPACTS, FINE_DIGITS)
        same = len(fine["events"]) == len(document["events"])
        for kind, spoiled in [
            ("a bound moved past the truth by a unit of its last place", edits.bounds(document, fine) if same else ()),
            ("an impact left out, twice, or on the other wall", edits.impacts(document)),
            ("a rest or release left out or late", edits.others(document)),
        ]:
            refused = 0
            for what, copy in spoiled:
                code, said, _ = check(arguments.checker, copy)
                if code == 1:
                    refused += 1
                else:
                    failures.append(f"{name}, {what}: {said}")
            total += refused
            if refused:
                rows.append(f"| {name} | {kind} | {refused} |")
    return rows, total


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--checker")
    parser.add_argument("--report", default="validation/report")
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    arguments.checker = arguments.checker or arguments.program
    failures = []
    confirmed = right(arguments, failures)
    refused, total = wrong(arguments, failures)
    verdict = f"{len(confirmed)} certificates confirmed, {total} spoiled ones refused; {len(failures)} disagreements."
    lines = [
        "# Certificates checked again", "", verdict, "",
        "`impact-pair check` follows every flight anew from a certificate's own numbers, by another route "
        "(`docs/proofs/checking.md`).", "",
        "| scene | events | outcome | bits | seconds |", "|---|---|---|---|---|", *confirmed, "",
        "Spoiled on purpose, all refused:", "", "| scene | what | refused |", "|---|---|---|", *refused,
    ]
    if failures:
        lines += ["", "## Disagreements", "", *(f"- {failure}" for failure in failures)]
    folder = Path(arguments.report)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "certificates.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(verdict)
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
