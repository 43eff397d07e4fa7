#!/usr/bin/env python3
"""Scores a simulator of the horizontal impact pair against certified impacts.

    data/score.py MODULE[:FUNCTION] [--set flights|chatters|orbits]... [--list]

FUNCTION (`simulate`) of a Python module takes the scene in doubles and the time or the number of impacts up to which it is asked:
`simulate(scene, until, impacts) -> [(time, wall, velocity), ...]`, wall "left" or "right", velocity y' just before the impact. `data/adapters`
has some. Only the standard library is needed; a simulator that raises an error has no impacts.
"""
import argparse
import importlib
import json
import math
import re
import sys
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
SETS = ("flights", "chatters", "orbits")
# Accepted errors of a time, in periods of the fastest harmonic: right up to `NEAR`, the right impact but inexact up to `INEXACT`.
NEAR, INEXACT = 1e-6, 0.25


def number(text):
    """The double nearest to an exact expression, but for the rounding of its operations: decimals, pi, sqrt, + - * / ^ and parentheses."""
    if not re.fullmatch(r"[0-9.eE+\-*/^() ]*", text.replace("pi", "").replace("sqrt", "")):
        raise ValueError(f"{text!r} is no expression of decimals, pi, sqrt, + - * / ^ and parentheses")
    return float(eval(text.replace("^", "**"), {"__builtins__": {}}, {"pi": math.pi, "sqrt": math.sqrt}))


def read(name):
    """The lines of a set."""
    return [json.loads(line) for line in (HERE / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()]


def period(line):
    return 2 * math.pi / max(line["doubles"]["excitation"]["frequency"])


def impacts(line):
    """The certified impacts as (wall, lower and upper bound of the time)."""
    return [(event["wall"], float(event["time"][0]), float(event["time"][1])) for event in line["events"] if event["event"] == "impact"]


def off(claim, certified, unit):
    """How far a claimed impact is from a certified one, in periods; infinite on the other wall."""
    (time, wall, *_), (on, low, high) = claim, certified
    return max(low - time, time - high, 0.0) / unit if wall == on else math.inf


def asked(simulate, line):
    """What a simulator answers, or the name of its error."""
    certified = impacts(line)
    end = number(line["until"]) if "until" in line else certified[-1][2] + 2 * period(line)
    try:
        return list(simulate(line["doubles"], end, len(certified) + 1)), None
    except Exception as error:  # noqa: BLE001 an error is an answer
        return [], type(error).__name__


def judged_flight(simulate, line):
    """right, inexact, missed, invented, or failed: of the first contact."""
    found, error = asked(simulate, line)
    certified = impacts(line)
    if error:
        return "failed"
    if not certified:
        return "invented" if found else "right"
    if not found:
        return "missed"
    distance = off(found[0], certified[0], period(line))
    if distance <= NEAR:
        return "right"
    if distance <= INEXACT:
        return "inexact"
    return "invented" if found[0][0] <= certified[0][2] else "missed"


def judged_chatter(simulate, line):
    """Whether the impact after the release is found, and the rest is not left for others."""
    found, error = asked(simulate, line)
    rest = next(event for event in line["events"] if event["event"] == "rest")
    after = next((impact for impact in impacts(line) if impact[1] > float(rest["time"][1])), None)
    if error:
        return "failed"
    if after is None:
        return "invented" if any(claim[0] > float(rest["time"][1]) + NEAR * period(line) for claim in found) else "right"
    return "right" if any(off(claim, after, period(line)) <= NEAR for claim in found) else "missed"


def judged_orbit(simulate, line):
    """The number of impacts before the first one that is missed, invented or off by more than a millionth of a period."""
    found, _ = asked(simulate, line)
    certified = impacts(line)
    right = 0
    for claim, impact in zip(found, certified):
        if off(claim, impact, period(line)) > NEAR:
            break
        right += 1
    return right, len(certified)


def score(simulate, sets=SETS, each=lambda name, line, verdict: None):
    """The rows of the table: family, what was asked, what was right, and the other verdicts."""
    rows = []
    for name in sets:
        families = {}
        for line in read(name):
            judge = {"flights": judged_flight, "chatters": judged_chatter, "orbits": judged_orbit}[name]
            verdict = judge(simulate, line)
            each(name, line, verdict)
            families.setdefault(line["family"], []).append(verdict)
        for family, verdicts in families.items():
            if name == "orbits":
                rows.append((f"orbits: {family}", sum(of for _, of in verdicts), sum(right for right, _ in verdicts), {}))
            else:
                counts = Counter(verdicts)
                right = counts.pop("right", 0)
                rows.append((f"{name}: {family}", len(verdicts), right, dict(counts)))
    return rows


def main():
    parser = argparse.ArgumentParser(prog="data/score.py", description=__doc__.splitlines()[0])
    parser.add_argument("simulator", metavar="MODULE[:FUNCTION]")
    parser.add_argument("--set", action="append", choices=SETS, help="one set; may be repeated")
    parser.add_argument("--list", action="store_true", help="the verdict on each line")
    options = parser.parse_args()
    module, _, function = options.simulator.partition(":")
    sys.path[:0] = [str(Path.cwd()), str(HERE / "adapters")]
    simulate = getattr(importlib.import_module(module), function or "simulate")
    shown = (lambda name, line, verdict: print(f"{name}: {line['name']}: {verdict}")) if options.list else (lambda *_: None)
    print("| set | asked | right | else |\n|---|---|---|---|")
    for family, of, right, others in score(simulate, options.set or SETS, shown):
        print(f"| {family} | {of} | {right} | {', '.join(f'{count} {verdict}' for verdict, count in others.items())} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
