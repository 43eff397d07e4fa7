"""The report: the page with its tables, and the pictures."""
from collections import Counter
from pathlib import Path

from mpmath import mp, mpf

import draw
import report
from claims import NEAR, Verdict
from legs import DIGITS
from program import certify, costs
from questions import FIGURES, Flown, Orbit
from results import Results, decided, single
from runs import SIMULATORS
from verdicts import drift, ending, errors

DRAWN = 14  # the figure whose errors are drawn


def widths(program: str, orbit: Orbit, digits: int, arithmetic: str) -> list[float]:
    """Guaranteed widths of the times in periods."""
    found = certify(program, orbit.scene, len(orbit.legs), digits, arithmetic=arithmetic).impacts
    with mp.workdps(DIGITS):
        period = orbit.legs[0].motion.period
        return [float((mpf(event.time[1]) - mpf(event.time[0])) / period) for event in found]


def in_doubles(program: str, orbit: Orbit) -> tuple[int, int]:
    """Number of impacts in a row that doubles certify to NEAR periods, and of all that they certify."""
    found = widths(program, orbit, 6, "interval")
    return next((number for number, width in enumerate(found) if width > NEAR), len(found)), len(found)


def own_classes(flown: list[Flown]) -> dict[str, int]:
    """Hard flights that the program answers, judged right, and those it leaves undecided."""
    return dict(Counter("undecided" if one.leg is None else str(Verdict.RIGHT) for one in flown))


def pictures(folder: Path, program: str, results: Results) -> None:
    """Draws the errors along one figure and the classes of the hard flights."""
    at = FIGURES.index(DRAWN)
    orbit = results.orbits[at]
    shown = {f"{report.OURS} interval (doubles)": widths(program, orbit, 9, "interval"),
             f"{report.OURS} auto, 9 digits": widths(program, orbit, 9, "auto")}
    draw.errors(folder / "references-errors.svg",
                [errors(orbit.legs, parts.orbits[at].listing.contacts) for parts in results.answers], shown,
                f"Figure {DRAWN}: true errors up to the first wrong impact, and guaranteed widths")
    counts = {one.name: {str(verdict): tally.count(verdict) for verdict in Verdict}
              for one, tally in zip(SIMULATORS, results.hard)}
    counts[report.OURS] = own_classes(results.flown)
    draw.bars(folder / "references-flights.svg", counts, f"First contacts of {len(results.flown)} hard flights")


def section(title: str, *parts: str) -> str:
    """A part of the report."""
    return f"## {title}\n\n" + "\n".join(parts)


def orbit_section(program: str, results: Results) -> str:
    """Drift along whole orbits."""
    drifts = [[drift(orbit.legs, reply.listing.contacts, one.tolerance)
               for orbit, reply in zip(results.orbits, parts.orbits)]
              for one, parts in zip(SIMULATORS, results.answers)]
    narrow = [in_doubles(program, orbit) for orbit in results.orbits]
    return section("Whole orbits", report.orbits(drifts, len(results.orbits[0].legs), narrow),
                   f"![True errors along figure {DRAWN} and guaranteed widths](references-errors.svg)\n")


def cost_section(program: str, results: Results) -> str:
    """The section on the time per impact."""
    impacts = len(results.orbits[0].legs)
    ours = [costs(program, orbit.scene, impacts) for orbit in results.orbits]
    seconds = [[reply.seconds / max(1, len(reply.listing.contacts)) for reply in parts.orbits]
               for parts in results.answers]
    return section("Microseconds an impact", report.costs(seconds, ours),
                   f"References: CPU time; {report.OURS}: the orbit step, in wall time, as `trade` measures it.\n")


def written(program: str, results: Results) -> str:
    """The page."""
    flown, none = results.flown, [0] * (len(Verdict) - 1)
    own = own_classes(flown)
    tried = results.tallies
    return "\n".join([
        report.TITLE,
        report.verdict(results.disagreements, results.asked, sum(one.earlier for one in tried),
                       sum(len(one.proofs) for one in tried)),
        f"References: {report.versions()}, each with the scene's data rounded to doubles. How they are used, and what "
        "counts as a disagreement, is said in `validation/references/README.md`.\n",
        orbit_section(program, results),
        cost_section(program, results),
        section("Every flight of the orbits by itself, from the certified state rounded to doubles",
                report.classes(results.flights, [f"**{report.OURS}**", len(single(results.orbits)), *none]),
                report.strays(results.orbits, results.flights)),
        section(f"{len(flown)} first flights made to be hard",
                report.classes(results.hard, [f"**{report.OURS}** (undecided: {own.get('undecided', 0)})",
                                              own.get(str(Verdict.RIGHT), 0), *none]),
                "Right ones of each family, and what the others are:\n",
                report.families(decided(flown), results.hard)),
        "![Classes of the hard flights](references-flights.svg)\n",
        section("Chatter, rest and release",
                report.chatter([ending(results.chatter.legs, parts.chatter.listing) for parts in results.answers],
                               results.chatter.certified)),
        section("Negative controls", report.controls(*results.denied)),
    ])
