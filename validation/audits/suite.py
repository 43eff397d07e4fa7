#!/usr/bin/env python3
"""Has `impact-pair audit` judge lists of figure 14 by SciPy and heyoka, spoiled copies of a right one, and a chatter.

Run with validation/references in PYTHONPATH: suite.py --program PATH [--report DIR] [--quick]
"""
import argparse
import json
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

import judge
import lists
from scene import Scene
from spoil import Found, spoil

TOLERANCE = "1e-9"
DIGITS = 20            # of the truth that this judge compares with
LIST_DIGITS = 15       # of the right list that is spoiled
POSITIONS, FEW = 20, 4  # impacts that are spoiled, one by one, in all ways; with --quick
TIMEOUT = 120         # seconds that no answer may take
SCENE = Path("scenes/figure-14.toml")
CHATTER = Path("scenes/chatter.toml")


class Failed(Exception):
    """The program gave no answer."""


def ask(program: str, *arguments: str) -> tuple[int, dict]:
    """The exit code, 0 or 1, and the JSON that the program prints."""
    command = [program, *arguments, "--quiet", "--format", "json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=TIMEOUT)
    if done.returncode not in (0, 1):
        raise Failed(f"{' '.join(arguments)}: exit code {done.returncode}: {done.stderr.strip()}")
    return done.returncode, json.loads(done.stdout)


def audit(program: str, scene: Path, path: Path, *options: str) -> tuple[int, dict]:
    """The exit code and the document of `audit` for a list."""
    return ask(program, "audit", str(scene), str(path), "--tolerance", TOLERANCE, *options)


def disagreements(document: dict) -> list[Found]:
    """The findings that disagree, sorted: missed and outside ones by impact, false ones by row."""
    number = {"missed": lambda event: event["certified"]["index"], "outside": lambda event: event["certified"]["index"],
              "false": lambda event: event["row"]}
    return sorted(Found(event["verdict"], number[event["verdict"]](event)) for event in document["events"]
                  if event["verdict"] in number)


def simulators(program: str, impacts: int, folder: Path, failures: list[str]) -> list[str]:
    """Rows of the table of other simulators."""
    scene = Scene.read(SCENE)
    _, document = ask(program, "run", str(SCENE), "--impacts", str(impacts + 10), "--digits", str(DIGITS))
    truth = judge.bounds(document)
    rows = []
    for simulator in lists.references():
        listed = lists.simulate(simulator, scene, float(truth[-1].time[1]) * 2, impacts)
        code, found = audit(program, SCENE, lists.written(folder, "simulated.csv", lists.csv(listed)))
        own = judge.beginning(listed, truth, scene.motion(), Fraction(TOLERANCE))
        said = judge.Beginning(found["first_disagreement"]["impact"], found["another_orbit"]["impact"])
        if (code, said) != (1, own):
            failures.append(f"{simulator.name}: exit code {code}, {said}, but the judge here finds {own}")
        counts = found["counts"]
        rows.append(f"| {simulator.name} | {len(listed)} | {said.wrong}, {found['first_disagreement']['verdict']} "
                    f"| {said.word} | {counts['inside']} | {counts['outside']} | {counts['missed']} | {counts['false']} |")
    return rows


def spoiled(program: str, impacts: int, positions: int, folder: Path, failures: list[str]) -> list[str]:
    """Rows of the table of spoiled lists."""
    _, document = ask(program, "run", str(SCENE), "--impacts", str(impacts), "--digits", str(LIST_DIGITS))
    rows = lists.certified(document)
    code, found = audit(program, SCENE, lists.written(folder, "right.csv", lists.csv(rows)))
    if code != 0 or disagreements(found):
        failures.append(f"the right list: exit code {code}, {found['message']}")
    caught: dict[str, list[bool]] = {}
    for number in range(2, impacts - 2, max(1, impacts // positions)):
        for copy in spoil(rows, number):
            code, found = audit(program, SCENE, lists.written(folder, "spoiled.csv", lists.csv(copy.rows)))
            is_exact = (code, disagreements(found), found["another_orbit"]) == (1, sorted(copy.expected), None)
            caught.setdefault(copy.name, []).append(is_exact)
            if not is_exact:
                failures.append(f"impact {number} {copy.name}: exit code {code}, {disagreements(found)}, {found['another_orbit']}")
    return [f"| {name} | {sum(exact)} of {len(exact)} |" for name, exact in caught.items()]


def formats(program: str, folder: Path, failures: list[str]) -> list[str]:
    """Rows of the table of formats: the first 50 impacts in each."""
    _, document = ask(program, "run", str(SCENE), "--impacts", "50", "--digits", str(LIST_DIGITS))
    rows = lists.certified(document)
    half = float(Fraction(Scene.read(SCENE).gap)) / 2
    positions = ("--time-column", "t_impact", "--wall-column", "3", "--velocity-column", "vel")
    written = {
        "CSV": (lists.csv(rows), ()),
        "numpy.savetxt": (lists.savetxt(rows), ()),
        "MATLAB text": (lists.matlab(rows), ()),
        "TSV with positions for walls": (lists.tsv_of_positions(rows, half), positions),
        "JSON, array of objects": (lists.objects(rows), ()),
        "JSON, object of arrays": (lists.arrays(rows), ()),
        "orbit JSON": (json.dumps(document), ()),
    }
    table = []
    for name, (text, options) in written.items():
        code, found = audit(program, SCENE, lists.written(folder, "list", text), *options)
        if code != 0 or found["counts"]["inside"] != len(rows):
            failures.append(f"{name}: exit code {code}, {found['message']}")
        table.append(f"| {name} | {found['counts']['inside']} of {len(rows)} |")
    return table


def chatter(program: str, folder: Path, failures: list[str]) -> list[str]:
    """Rows of the table of chatter: lists that go deeper into it than the tolerance."""
    table = []
    for digits in (9, 20, 60):
        _, document = ask(program, "run", str(CHATTER), "--impacts", "100", "--digits", str(digits))
        rows = lists.certified(document)
        code, found = audit(program, CHATTER, lists.written(folder, "chatter.csv", lists.csv(rows)))
        counts = found["counts"]
        if code != 0 or counts["inside"] + counts["chatter"] != len(rows):
            failures.append(f"chatter in {digits} digits: exit code {code}, {found['message']}")
        table.append(f"| {digits} | {len(rows)} | {counts['inside']} | {counts['chatter']} |")
    return table


def page(parts: dict[str, list[str]], impacts: int, verdict: str, failures: list[str]) -> str:
    """The report."""
    lines = [
        "# Audits of other simulators", "", verdict, "",
        f"`impact-pair audit` with a tolerance of {TOLERANCE}; the first disagreement and the first impact of another orbit are compared with "
        "a judge in exact fractions that aligns nothing (`validation/audits/judge.py`).", "",
        f"## {impacts:,} impacts of figure 14 by others", "",
        "| simulator | impacts | first disagreement | another orbit from | inside | outside | missed | false |",
        "|---|---|---|---|---|---|---|---|", *parts["simulators"], "",
        "## One impact spoiled", "", "Exactly what was spoiled must be found, and nothing else.", "",
        "| what | found exactly |", "|---|---|", *parts["spoiled"], "",
        "## Formats", "", "| format | inside |", "|---|---|", *parts["formats"], "",
        "## Chatter", "", "| digits of the list | rows | inside | in the chatter |", "|---|---|---|---|", *parts["chatter"],
    ]
    if failures:
        lines += ["", "## Disagreements", "", *(f"- {failure}" for failure in failures)]
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--report", type=Path, default=Path("validation/report"))
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    impacts = 200 if arguments.quick else 1000
    failures: list[str] = []
    with tempfile.TemporaryDirectory() as temporary:
        folder, program = Path(temporary), arguments.program
        parts = {
            "simulators": simulators(program, impacts, folder, failures),
            "spoiled": spoiled(program, impacts, FEW if arguments.quick else POSITIONS, folder, failures),
            "formats": formats(program, folder, failures),
            "chatter": chatter(program, folder, failures),
        }
    verdict = (f"{len(parts['simulators'])} simulators, {len(parts['spoiled'])} kinds of spoiled lists, "
               f"{len(parts['formats'])} formats and a chatter are judged right; {len(failures)} disagreements.")
    if failures:
        verdict = f"**{len(failures)} disagreements.**"
    arguments.report.mkdir(parents=True, exist_ok=True)
    (arguments.report / "audits.md").write_text(page(parts, impacts, verdict, failures), encoding="utf-8")
    print(verdict)
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
