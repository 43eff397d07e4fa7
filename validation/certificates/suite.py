#!/usr/bin/env python3
"""Has `impact-pair check` judge certificates of `impact-pair run`: all are confirmed. Of false ones `tests/corpus` asks.

Run: suite.py --program PATH [--checker PATH] [--report DIR] [--quick]
"""
import argparse
import json
import re
import subprocess
import sys
import time
from pathlib import Path

# Seconds that no answer may take.
TIMEOUT = 60
# The last have several harmonics.
FOLDERS = [Path("scenes"), Path("validation/certificates/scenes")]
CONFIRMED = re.compile(r"confirmed: (\d+) events and the outcome, in (\d+) bits")


def run(program, scene, impacts):
    """The orbit JSON of a scene."""
    command = [program, "run", scene, "--impacts", str(impacts), "--format", "json", "--quiet"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        raise SystemExit(f"error: {scene}: no orbit in {TIMEOUT} s") from None
    if done.returncode == 2 or not done.stdout:
        raise SystemExit(f"error: {scene}: {done.stderr.strip()}")
    return done.stdout


def check(program, document):
    """(exit code, what it says, seconds)."""
    start = time.perf_counter()
    try:
        done = subprocess.run([program, "check", "-", "--quiet"], input=document, capture_output=True, text=True, check=False, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        return 2, f"no verdict in {TIMEOUT} s", TIMEOUT
    return done.returncode, (done.stdout or done.stderr).strip(), time.perf_counter() - start


def judged(arguments, failures):
    """Rows of the table of certificates."""
    rows = []
    for scene in [scene for folder in FOLDERS for scene in sorted(folder.glob("*.toml"))]:
        impacts = 60 if arguments.quick else 200
        for count in [impacts] + ([2000] if scene.stem == "figure-14" and not arguments.quick else []):
            document = run(arguments.program, scene, count)
            code, said, seconds = check(arguments.checker, document)
            found = CONFIRMED.match(said)
            if code != 0 or not found:
                failures.append(f"{scene.stem}, {count} impacts: {said}")
                continue
            rows.append(f"| {scene.stem} | {found[1]} | {json.loads(document)['outcome']['kind']} | {found[2]} | {seconds:.2f} |")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--checker")
    parser.add_argument("--report", default="validation/report")
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    arguments.checker = arguments.checker or arguments.program
    failures = []
    confirmed = judged(arguments, failures)
    verdict = f"{len(confirmed)} certificates confirmed; {len(failures)} disagreements."
    lines = [
        "# Certificates checked again", "", verdict, "",
        "`impact-pair check` follows every flight anew from a certificate's own numbers, by another route "
        "(`docs/proofs/checking.md`).", "",
        "| scene | events | outcome | bits | seconds |", "|---|---|---|---|---|", *confirmed,
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
