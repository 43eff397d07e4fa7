#!/usr/bin/env python3
"""Draws docs/proved.svg, the bifurcation diagram of figure 14 in the colours of what is proved, and writes into docs/howto/chaos.md what it shows,
which stretches are left undecided, and what `check` says of the document.

    docs/proved.py

What is done is kept in target/proved: the document, the picture, and what each took. The program is that of the environment variable
IMPACT_PAIR, or target/release/impact-pair. Python 3.11, standard library.
"""
import json
import os
import resource
import shutil
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("IMPACT_PAIR") or str(ROOT / "target/release/impact-pair")
KEPT = ROOT / "target/proved"
PAGE, PICTURE = ROOT / "docs/howto/chaos.md", ROOT / "docs/proved.svg"
COMMAND = ["chaos", "scenes/figure-14.toml", "--over", "amplitude=1..10:180", "--depth", "16"]
BEGIN, END = "<!-- docs/proved.py -->\n", "<!-- end of docs/proved.py -->\n"


def run(name, arguments):
    """Runs the program, unless what it took is kept, and returns that: seconds of processor time, and seconds that passed."""
    file = KEPT / f"{name}.json"
    if not file.exists():
        begin, used = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([PROGRAM, *map(str, arguments), "--quiet"], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode not in (0, 1):
            raise SystemExit(f"{arguments}: exit code {done.returncode}")
        now = resource.getrusage(resource.RUSAGE_CHILDREN)
        processor = now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime
        file.write_text(json.dumps({"processor": processor, "passed": time.monotonic() - begin, "said": done.stdout}))
    return json.loads(file.read_text())


def percent(part):
    return f"{100 * part:.1f} %"


def share(stretches, verdicts, low, high):
    """Returns which part of the amplitudes between two is in stretches with one of some verdicts, in doubles."""
    ends = [(float(own["low"]), float(own["high"])) for own in stretches if own["verdict"] in verdicts]
    return sum(max(0.0, min(high, end) - max(low, begin)) for begin, end in ends) / (high - low)


def horseshoes(stretches, low, high):
    return share([own | {"verdict": "yes"} for own in stretches if own.get("entropy")], ["yes"], low, high)


def write(found, made, judged):
    """Writes into the page what the document shows, and what is judged of it."""
    shares, stretches = found["shares"], found["stretches"]
    open_ = sorted((own for own in stretches if own["verdict"] == "undecided"), key=lambda own: float(own["low"]) - float(own["high"]))
    widest = ", ".join(f"{float(own['low']):.4f} to {float(own['high']):.4f}" for own in open_[:6])
    width = sum(float(own["high"]) - float(own["low"]) for own in open_[:6]) / sum(float(own["high"]) - float(own["low"]) for own in open_)
    text = f"""The picture is that of `--over amplitude=1..10:180 --depth 16`: {made['processor']:.0f} s of processor time. At {percent(shares['attracted'])} of all amplitudes from 1 to
10 the scene's orbit is proved to converge to a periodic one, at {percent(shares['stable'])} more a stable periodic orbit is proved to exist, and at
{percent(shares['horseshoe'])} a horseshoe (of the amplitudes from 8 to 10: {percent(horseshoes(stretches, 8, 10))}), at {percent(shares['both'])} both. Nothing is proved at
{percent(shares['undecided'])}: {len(open_)} stretches, of which the six widest, {widest}, are {percent(width)}.
Left undecided are amplitudes near bifurcations, where motions converge slowly, narrow windows, and thin bands of chaos, whose horseshoes have long words. The dots are floating-point
orbits; the colours are theorems about all values of the amplitude.
{judged}"""
    page = PAGE.read_text(encoding="utf-8")
    head, rest = page.split(BEGIN, 1)
    PAGE.write_text(head + BEGIN + text + END + rest.split(END, 1)[1], encoding="utf-8")


def main():
    KEPT.mkdir(parents=True, exist_ok=True)
    document, picture = KEPT / "document.json", KEPT / "proved.svg"
    made = run("made", [*COMMAND, "--output", document, "--plot", picture])
    shutil.copy(picture, PICTURE)
    found = json.loads(document.read_text())
    # The check takes as long again: without it the page is right as well.
    write(found, made, "")
    checked = run("checked", ["check", document, "--format", "json"])
    claimed = sum(own["verdict"] != "undecided" for own in found["stretches"])
    verdict, said = (json.loads(checked["said"])[key] for key in ("verdict", "message"))
    if verdict == "refuted":
        raise SystemExit(f"`check` refutes {document}: {said}")
    write(found, made, f"\n`check` of this document, {claimed} stretches with a verdict, takes {checked['processor']:.0f} s of processor time: {said}.\n")


if __name__ == "__main__":
    main()
