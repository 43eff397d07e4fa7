"""Markdown of the measured numbers: every table of the report."""
from collections import Counter
from collections.abc import Iterable, Sequence
from importlib.metadata import version

from claims import Verdict
from program import Certified, Event
from questions import FIGURES, Flown, Orbit
from runs import SIMULATORS
from verdicts import Drift, Ending, Tally

TITLE = "# Reference simulators beside certified brackets\n"
OURS = "impact-pair"
PACKAGES = ("scipy", "heyoka", "mpmath", "numpy")


def table(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def by_figure(rows: Iterable[Sequence[object]]) -> str:
    """A table with a column for each figure."""
    return table(["", *(f"fig {number}" for number in FIGURES)], rows)


def verdict(disagreements: list[str], judged: int, earlier: int, outside: int) -> str:
    """The sentence at the head of the report, and the disagreements if there are any."""
    counted = "Zero disagreements" if not disagreements else f"**{len(disagreements)} disagreements**"
    bad = "".join(f"\n- {each}" for each in disagreements)
    return (f"{counted}: {judged:,} certified flights retraced by mpmath, and {earlier:,} contacts that references claim "
            f"earlier than certified tried, of which {outside:,} stand.\n{bad}")


def versions() -> str:
    """The packages compared with."""
    return ", ".join(f"{name} {version(name)}" for name in PACKAGES)


def orbits(drifts: list[list[Drift]], impacts: int, narrow: list[tuple[int, int]]) -> str:
    """How long each reference follows a whole orbit; `narrow`: in doubles, impacts certified to 1e-6 periods, and all."""
    def first(value: int | None) -> object:
        return "-" if value is None else value

    def rows(field: str) -> list[list[object]]:
        return [[simulator.name, *(first(getattr(one, field)) for one in line)]
                for simulator, line in zip(SIMULATORS, drifts)]

    agreeing = [[simulator.name, *(one.agree for one in line)] for simulator, line in zip(SIMULATORS, drifts)]
    ours = [[f"**{OURS}, certified: interval (doubles)**", 
             *(f"{close} ({every})" for close, every in narrow)],
            [f"**{OURS}, certified: auto**", *([impacts] * len(FIGURES))]]
    own = [[f"{row[0]} ({simulator.tolerance:.0e})", *row[1:]] for simulator, row in zip(SIMULATORS, rows("own"))]
    return (f"Impacts in a row on the certified wall and within 1e-6 periods of the certified bracket, of {impacts}; ours: with a "
            "guaranteed width of at most 1e-6 periods (with any width):\n\n"
            + by_figure([*agreeing, *ours])
            + "\nThe first impact farther from its bracket than the tolerance asked for (in brackets, in periods):\n\n"
            + by_figure(own)
            + "\nThe first impact that is another one (missed, invented, wrong wall, or off by a quarter period):\n\n"
            + by_figure(rows("other")))


def costs(seconds: list[list[float]], ours: dict[int, dict[str, tuple[int, float, float]]]) -> str:
    """Microseconds an impact."""
    def short(value: float) -> str:
        return f"{value:.0f}" if value >= 10 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"

    references = [[simulator.name, *(short(1e6 * each) for each in line)] for simulator, line in zip(SIMULATORS, seconds)]
    mine = [[f"**{OURS}, {name}**", *(short(ours[number][name][1]) for number in FIGURES)]
            for name in ("float", "interval", "auto, 9 digits")]
    return by_figure([*references, *mine])


def classes(tallies: list[Tally], own: Sequence[object], first: str) -> str:
    """Right, inexact, missed, invented, unknown; and what became of the earlier contacts."""
    rows = [[simulator.name, *(one.classes[verdict] for verdict in Verdict), one.earlier, len(one.proofs)]
            for simulator, one in zip(SIMULATORS, tallies)]
    header = [first, *Verdict, "claimed earlier", "of these true"]
    return table(header, [*rows, own])


def strays(orbits: list[Orbit], found: list[list[Verdict]]) -> str:
    """The flights that are not even inexact."""
    names = [f"{orbit.name} impact {number}" for orbit in orbits for number in range(1, len(orbit.legs) + 1)]
    lines = []
    for simulator, verdicts in zip(SIMULATORS, found):
        wrong = [f"{name} ({verdict})" for name, verdict in zip(names, verdicts, strict=True)
                 if verdict not in (Verdict.RIGHT, Verdict.INEXACT)]
        if wrong:
            lines.append(f"- {simulator.name}: {', '.join(wrong)}")
    return "Neither right nor inexact:\n\n" + ("\n".join(lines) or "- none") + "\n"


def families(flown: list[Flown], found: list[list[Verdict]]) -> str:
    """Right ones of each family, and what the others are."""
    names = list(dict.fromkeys(one.hard.family for one in flown))

    def cell(name: str, verdicts: list[Verdict]) -> str:
        counted = Counter(verdict for one, verdict in zip(flown, verdicts, strict=True) if one.hard.family == name)
        wrong = ", ".join(f"{counted[verdict]} {verdict}" for verdict in Verdict if verdict != Verdict.RIGHT and counted[verdict])
        return str(counted[Verdict.RIGHT]) + (f" ({wrong})" if wrong else "")

    rows = [[name, sum(one.hard.family == name for one in flown), *(cell(name, verdicts) for verdicts in found)]
            for name in names]
    return table(["", "flights", *(simulator.name for simulator in SIMULATORS)], rows)


def chatter(endings: list[Ending], certified: Certified) -> str:
    """The chatter scene."""
    why = {"impacts": "stuck: a new impact at the same time, for ever", "outside": "the ball has left the box",
           "time": "reaches the end", "budget": "out of budget"}
    rows = [[simulator.name, one.listed, one.right, f"{one.last:.13g}", why.get(one.ended, one.ended),
             "yes" if one.after_release else "no"] for simulator, one in zip(SIMULATORS, endings)]
    kinds = {event.kind: event for event in certified.events}
    last = certified.impacts[-1]
    rows.append([f"**{OURS}**", len(certified.impacts), len(certified.impacts), f"{float(last.time[0]):.13g}",
                 f"rest in {within(kinds['rest'])}, release in {within(kinds['release'])}", f"yes, in {within(last)}"])
    return table(["", "impacts listed", "right from the first on", "last one at", "the list ends", "impact after the release"],
                 rows)


def within(event: Event) -> str:
    """The bracket of its time."""
    return f"[{event.time[0]}, {event.time[1]}]"


def controls(found: dict[str, tuple[int, int]]) -> str:
    """Refused, of how many."""
    return table(["spoiled on purpose", "listings", "refused"], [[name, of, refused] for name, (refused, of) in found.items()])
