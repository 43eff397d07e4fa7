"""Compares the references with the program, writes the report, and fails at any disagreement."""
import argparse
import sys
from itertools import chain
from pathlib import Path

import page
import report
from claims import Verdict, denied, proves_us_wrong
from questions import (CHATTER_IMPACTS, CHATTER_UNTIL, FIGURES, Flown, Orbit, chatter, figure, hard_flights, hard_question,
                       restarted, whole)
from results import Results, decided, parted, single
from runs import SIMULATORS, ask_all
from verdicts import tally


def refusals(orbits: list[Orbit], impacts: int) -> list[str]:
    """The answers that are missing."""
    return [f"{orbit.name}: {len(orbit.certified.impacts)} impacts listed, {impacts} asked for"
            for orbit in orbits if len(orbit.certified.impacts) != impacts]


def compare(orbits: list[Orbit], rest: Orbit, flown: list[Flown]) -> Results:
    """Asks the references and judges what they say; runs the controls."""
    legs, hard = single(orbits), decided(flown)
    questions = [*map(whole, orbits), *map(restarted, legs), *map(hard_question, hard),
                 rest.question(float(CHATTER_UNTIL), CHATTER_IMPACTS, timed=False)]
    answers = [parted(line, len(legs), len(hard)) for line in ask_all(questions)]
    flights = [tally(one, legs, parts.flights) for one, parts in zip(SIMULATORS, answers)]
    tallies = [tally(one, [each.leg for each in hard], parts.hard) for one, parts in zip(SIMULATORS, answers)]
    right = [(leg, reply.listing.contacts[0]) for one, parts in zip(flights, answers)
             for leg, reply, verdict in zip(legs, parts.flights, one.verdicts) if verdict == Verdict.RIGHT]
    # The control: each right contact must prove wrong who denies it.
    proved = sum(proves_us_wrong(denied(leg), contact) for leg, contact in right)
    passed = [f"control: {len(right) - proved} of {len(right)} denied impacts passed"] if proved < len(right) else []
    proofs = chain.from_iterable(one.proofs for one in (*flights, *tallies))
    return Results(orbits, rest, flown, answers, flights, tallies, (proved, len(right)), [*passed, *proofs])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, help="the impact-pair under test")
    parser.add_argument("--scenes", type=Path, required=True)
    parser.add_argument("--report", type=Path, required=True, help="folder for references.md and its pictures")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    impacts = 10 if options.quick else 200
    options.report.mkdir(parents=True, exist_ok=True)

    orbits = [figure(options.program, options.scenes, number, impacts) for number in FIGURES]
    rest = chatter(options.program, options.scenes)
    flown = hard_flights(options.program, options.quick)
    disagreements = refusals(orbits, impacts)
    if disagreements:
        text = "\n".join([report.TITLE, report.refusal(disagreements)])
    else:
        results = compare(orbits, rest, flown)
        disagreements = results.disagreements
        text = page.written(options.program, results)
        page.pictures(options.report, options.program, results)
    (options.report / "references.md").write_text(text)
    print(text.split("\n\n")[1])
    return 1 if disagreements else 0


if __name__ == "__main__":
    sys.exit(main())
