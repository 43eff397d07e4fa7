"""Compares the references with the program, writes the report, and fails at any disagreement."""
import argparse
import sys
from collections import Counter
from itertools import chain
from pathlib import Path

from mpmath import mp, mpf

import draw
import report
from claims import NEAR, Verdict, classify
from controls import control
from judge import DIGITS
from program import certify, costs
from questions import (CHATTER_IMPACTS, CHATTER_UNTIL, FIGURES, Flown, Orbit, chatter, figure, hard_flights, hard_question,
                       restarted, whole)
from runs import SIMULATORS, Answer, ask_all
from verdicts import Tally, drift, ending, errors, tally

DRAWN = 14  # the figure whose errors are drawn


def widths(program: str, orbit: Orbit, impacts: int, digits: int, arithmetic: str) -> list[float]:
    """Widths of the certified times in periods."""
    found = certify(program, orbit.scene, impacts, digits, arithmetic=arithmetic).impacts
    with mp.workdps(DIGITS):
        period = orbit.legs[0].motion.period
        return [float((mpf(event.time[1]) - mpf(event.time[0])) / period) for event in found]


def in_doubles(program: str, orbit: Orbit) -> tuple[int, int]:
    """How many impacts in a row doubles certify to 1e-6 periods, and how many at all."""
    found = widths(program, orbit, len(orbit.legs), 6, "interval")
    return next((number for number, width in enumerate(found) if width > NEAR), len(found)), len(found)


def cut(answers: list[Answer], sizes: list[int]) -> list[list[Answer]]:
    """The answers in parts of these sizes."""
    ends = [sum(sizes[:count]) for count in range(len(sizes) + 1)]
    return [answers[first:last] for first, last in zip(ends, ends[1:])]


def refusals(orbits: list[Orbit], flown: list[Flown], impacts: int) -> list[str]:
    """What the judge finds wrong with certified answers, or missing from them."""
    found = [f"{orbit.name}: {problem}" for orbit in orbits for problem in orbit.judged.problems]
    found += [f"{orbit.name}: {len(orbit.certified.impacts)} impacts listed, {impacts} asked for"
              for orbit in orbits if orbit.name != "chatter" and len(orbit.certified.impacts) != impacts]
    return found + [f"{one.hard}: {problem}" for one in flown for problem in one.judged.problems]


def section(title: str, *parts: str) -> str:
    """A part of the report."""
    return f"## {title}\n\n" + "\n".join(parts)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, help="the impact-pair under test")
    parser.add_argument("--scenes", type=Path, required=True)
    parser.add_argument("--report", type=Path, required=True, help="folder for references.md and its pictures")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    impacts = 20 if options.quick else 200
    program = options.program

    orbits = [figure(program, options.scenes, number, impacts) for number in FIGURES]
    rest = chatter(program, options.scenes)
    flown = hard_flights(program, options.quick)
    disagreements = refusals([*orbits, rest], flown, impacts)
    options.report.mkdir(parents=True, exist_ok=True)
    if disagreements:  # what is refused is no ground to compare on
        return publish(options.report, "\n".join([report.TITLE, report.verdict(disagreements, 0, 0, 0)]), disagreements)
    legs = list(chain.from_iterable(orbit.legs for orbit in orbits))
    decided = [one for one in flown if one.leg is not None]
    print(f"{len(legs)} flights of orbits, {len(rest.legs)} of the chatter, {len(decided)} hard ones: judged")

    sizes = [len(orbits), len(legs), len(decided), 1]
    answers = [cut(line, sizes) for line in ask_all([
        *map(whole, orbits), *map(restarted, legs), *map(hard_question, decided),
        rest.question(float(CHATTER_UNTIL), CHATTER_IMPACTS, timed=False)])]
    hard_legs = [one.leg for one in decided]
    again = [tally(one.name, legs, parts[1]) for one, parts in zip(SIMULATORS, answers)]
    hard = [tally(one.name, hard_legs, parts[2]) for one, parts in zip(SIMULATORS, answers)]
    disagreements += chain.from_iterable(one.proofs for one in (*again, *hard))

    spoiled = control(orbits[FIGURES.index(DRAWN)], flown, [
        (leg, reply.listing.contacts[0]) for parts in answers for leg, reply in zip(legs, parts[1])
        if classify(leg, reply.listing) == Verdict.RIGHT])
    for name, (refused, of) in spoiled.items():
        print(f"spoiled on purpose: {name}: {refused} of {of} refused")
        if refused < of:
            disagreements.append(f"control: {name}: {of - refused} of {of} spoiled listings passed")

    pictures(options.report, program, orbits[FIGURES.index(DRAWN)], answers, hard, flown)
    text = written(program, orbits, rest, flown, answers, again, hard, spoiled, disagreements)
    return publish(options.report, text, disagreements)


def publish(folder: Path, text: str, disagreements: list[str]) -> int:
    """Writes the report, says its verdict, and gives the exit code."""
    (folder / "references.md").write_text(text)
    print(text.split("\n\n")[1])
    return 1 if disagreements else 0


def pictures(folder: Path, program: str, orbit: Orbit, answers: list[list[list[Answer]]], hard: list[Tally],
             flown: list[Flown]) -> None:
    """Draws the errors along one figure and the classes of the hard flights."""
    at = FIGURES.index(DRAWN)
    number = len(orbit.legs)
    shown = {f"impact-pair {name}": widths(program, orbit, number, digits, arithmetic)
             for name, digits, arithmetic in (("interval (doubles)", 9, "interval"), ("auto, 9 digits", 9, "auto"))}
    draw.errors(folder / "references-errors.svg",
                [errors(orbit.legs, parts[0][at].listing.contacts) for parts in answers], shown,
                f"Figure {DRAWN}: true errors up to the first wrong impact, and guaranteed widths")
    counts = {one.name: {str(verdict): count for verdict, count in tally.classes.items()}
              for one, tally in zip(SIMULATORS, hard)}
    counts[report.OURS] = own_classes(flown)
    draw.bars(folder / "references-flights.svg", counts, f"First contacts of {len(flown)} hard flights")


def own_classes(flown: list[Flown]) -> dict[str, int]:
    """Hard flights that the program answers, judged right, and those it leaves undecided."""
    return dict(Counter("undecided" if one.leg is None else str(Verdict.RIGHT) for one in flown))


def written(program: str, orbits: list[Orbit], rest: Orbit, flown: list[Flown], answers: list[list[list[Answer]]],
            again: list[Tally], hard: list[Tally], spoiled: dict[str, tuple[int, int]], disagreements: list[str]) -> str:
    """The report."""
    impacts, decided = len(orbits[0].legs), [one for one in flown if one.leg is not None]
    ours = {number: costs(program, orbit.scene, impacts) for number, orbit in zip(FIGURES, orbits)}
    drifts = [[drift(orbit.legs, reply.listing.contacts, one.tolerance) for orbit, reply in zip(orbits, parts[0])]
              for one, parts in zip(SIMULATORS, answers)]
    seconds = [[reply.seconds / max(1, len(reply.listing.contacts)) for reply in parts[0]] for parts in answers]
    legs = list(chain.from_iterable(orbit.legs for orbit in orbits))
    alone = [[classify(leg, reply.listing) for leg, reply in zip(legs, parts[1])] for parts in answers]
    verdicts = [[classify(one.leg, reply.listing) for one, reply in zip(decided, parts[2])] for parts in answers]
    judged = sum(len(orbit.legs) for orbit in (*orbits, rest)) + len(decided)
    tried = [*again, *hard]
    blank = [0] * 4
    right = own_classes(flown)
    return "\n".join([
        report.TITLE,
        report.verdict(disagreements, judged, sum(one.earlier for one in tried), sum(len(one.proofs) for one in tried)),
        f"\nReferences: {report.versions()}. Each gets the scene's data rounded to doubles; `validation/references/README.md` "
        "says how they are used and what counts as a disagreement.\n",
        section("Whole orbits", report.orbits(drifts, impacts, [in_doubles(program, orbit) for orbit in orbits])),
        "![True errors of the references along figure 14 and guaranteed widths](references-errors.svg)\n",
        section("Microseconds an impact (CPU time)", report.costs(seconds, ours)),
        section("Every flight of the orbits by itself, from the certified state rounded to doubles",
                report.classes(again, [f"**{report.OURS}**", len(legs), *blank, "", ""], ""),
                report.strays(orbits, alone)),
        section(f"{len(flown)} first flights made to be hard",
                report.classes(hard, [f"**{report.OURS}**, undecided {right.get('undecided', 0)}", right["right"],
                                      *blank, "", ""], ""),
                "Right ones of each family, and what the others are:\n", report.families(decided, verdicts)),
        "![Classes of the hard flights](references-flights.svg)\n",
        section("Chatter, rest and release", report.chatter(
            [ending(rest.legs, parts[3][0].listing) for parts in answers], rest.certified)),
        section("Negative controls", report.controls(spoiled)),
    ])


if __name__ == "__main__":
    sys.exit(main())
