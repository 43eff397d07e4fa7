#!/usr/bin/env python3
"""Draws docs/proved.svg, the bifurcation diagram of figure 14 in the colours of what is proved, and writes into docs/howto/chaos.md what it shows,
which stretches are left undecided, and what `check` says of the document.

    docs/proved.py [SECONDS]

After SECONDS no further stretch is checked, and the page says how many were. The document, the picture, what `check` says of each stretch as a
document of its own, and the processor time of each are kept in target/proved: a run that was stopped goes on from there, with the same program. The
program is that of the environment variable IMPACT_PAIR, or target/release/impact-pair. Python 3.11, standard library.
"""
import collections
import json
import math
import os
import resource
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("IMPACT_PAIR") or str(ROOT / "target/release/impact-pair")
KEPT = ROOT / "target/proved"
PAGE, PICTURE = ROOT / "docs/howto/chaos.md", ROOT / "docs/proved.svg"
COMMAND = ["chaos", "scenes/figure-14.toml", "--over", "amplitude=1..10:180", "--depth", "16"]
BEGIN, END = "<!-- docs/proved.py -->\n", "<!-- end of docs/proved.py -->\n"


def timed(arguments, text=""):
    """Runs the program, and returns what it prints, and the seconds of processor time that it takes."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([PROGRAM, *map(str, arguments), "--quiet"], cwd=ROOT, input=text, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{arguments}: exit code {done.returncode}")
    now = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.stdout, now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime


def made(document, picture):
    """Makes the document and the picture, unless they are kept, and returns the seconds of processor time that they took."""
    file = KEPT / "made.json"
    if not file.exists():
        file.write_text(json.dumps({"processor": timed([*COMMAND, "--output", document, "--plot", picture])[1]}))
    return json.loads(file.read_text())["processor"]


def alone(found, stretch):
    """Returns a document of one stretch."""
    over = found["over"] | {"low": stretch["low"], "high": stretch["high"]}
    shares = dict.fromkeys(found["shares"], 0.0) | {stretch["verdict"]: 1.0}
    if stretch.get("entropy"):
        shares |= {"horseshoe": 1.0, "both": float("period" in stretch)}
    return found | {"certified": True, "over": over, "cells": 1, "shares": shares, "stretches": [stretch]}


def scattered(stretches):
    """Returns stretches in an order that does not depend on where they are."""
    count = len(stretches)
    step = next(step for step in range(round(0.618 * count), count) if math.gcd(step, count) == 1)
    return [stretches[step * k % count] for k in range(count)]


def checked(found, end):
    """Has each stretch that has a verdict checked, as a document of its own, until a time comes, and returns what is said of each."""
    file = KEPT / "checked.jsonl"
    done = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    known = {own["low"] for own in done}
    claimed = [own for own in found["stretches"] if own["verdict"] != "undecided"]
    with file.open("a", encoding="utf-8") as kept:
        for stretch in scattered(claimed):
            if stretch["low"] in known or time.monotonic() > end:
                continue
            said, processor = timed(["check", "-", "--format", "json"], json.dumps(alone(found, stretch)))
            own = {"low": stretch["low"], "high": stretch["high"], "of": stretch["verdict"], "processor": processor} | json.loads(said)
            if own["verdict"] == "refuted":
                raise SystemExit(f"`check` refutes the stretch from {own['low']} to {own['high']}: {own['message']}")
            done.append(own)
            kept.write(json.dumps(own) + "\n")
            kept.flush()
    return done, len(claimed)


def percent(part):
    return f"{100 * part:.1f} %"


def share(stretches, verdicts, low, high):
    """Returns which part of the amplitudes between two is in stretches with one of some verdicts, in doubles."""
    ends = [(float(own["low"]), float(own["high"])) for own in stretches if own["verdict"] in verdicts]
    return sum(max(0.0, min(high, end) - max(low, begin)) for begin, end in ends) / (high - low)


def horseshoes(stretches, low, high):
    return share([own | {"verdict": "yes"} for own in stretches if own.get("entropy")], ["yes"], low, high)


def write(found, processor, judged):
    """Writes into the page what the document shows, and what is judged of it."""
    shares, stretches = found["shares"], found["stretches"]
    open_ = sorted((own for own in stretches if own["verdict"] == "undecided"), key=lambda own: float(own["low"]) - float(own["high"]))
    widest = ", ".join(f"{float(own['low']):.4f} to {float(own['high']):.4f}" for own in open_[:6])
    width = sum(float(own["high"]) - float(own["low"]) for own in open_[:6]) / sum(float(own["high"]) - float(own["low"]) for own in open_)
    text = f"""The picture is that of `--over amplitude=1..10:180 --depth 16`: {processor:.0f} s of processor time. At {percent(shares['attracted'])} of all amplitudes from 1 to
10 the scene's orbit is proved to converge to a periodic one, at {percent(shares['stable'])} more a stable periodic orbit is proved to exist, and at
{percent(shares['horseshoe'])} a horseshoe (of the amplitudes from 8 to 10: {percent(horseshoes(stretches, 8, 10))}), at {percent(shares['both'])} both. Nothing is proved at
{percent(shares['undecided'])}: {len(open_)} stretches, of which the six widest, {widest}, are {percent(width)}.
Left undecided are amplitudes near bifurcations, where motions converge slowly, narrow windows, and thin bands of chaos, whose horseshoes have long words. The dots are floating-point
orbits; the colours are theorems about all values of the amplitude.
{judged}"""
    page = PAGE.read_text(encoding="utf-8")
    head, rest = page.split(BEGIN, 1)
    PAGE.write_text(head + BEGIN + text + END + rest.split(END, 1)[1], encoding="utf-8")


def judged(done, count):
    """Returns what `check` says of the stretches, in words."""
    if not done:
        return ""
    taken = [own["processor"] for own in done]
    confirmed = [own for own in done if own["verdict"] == "confirmed"]
    width = lambda some: sum(float(own["high"]) - float(own["low"]) for own in some)
    reasons = collections.Counter(own["message"].split("stretches[0]: ", 1)[-1].rsplit("; ", 1)[0] for own in done if own["verdict"] != "confirmed")
    of = f"these {count} stretches" if len(done) == count else f"{len(done)} of these {count} stretches so far, in a scattered order,"
    text = f"""
`check` of {of} as documents of their own takes {sum(taken):.0f} s of processor time in all, {statistics.median(taken):.1f} s in the median and {max(taken):.0f} s at most.
It confirms {len(confirmed)}, {percent(width(confirmed) / width(done))} of their amplitudes, and refutes none. Of the others it says:
"""
    return text + "".join(f"\n- {reason}: {number}." for reason, number in reasons.most_common()) + "\n"


def main():
    end = time.monotonic() + float(sys.argv[1]) if len(sys.argv) > 1 else math.inf
    KEPT.mkdir(parents=True, exist_ok=True)
    document, picture = KEPT / "document.json", KEPT / "proved.svg"
    processor = made(document, picture)
    shutil.copy(picture, PICTURE)
    found = json.loads(document.read_text())
    write(found, processor, judged(*checked(found, end)))


if __name__ == "__main__":
    main()
