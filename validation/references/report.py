"""Markdown of the measured numbers: the sentence at the head and every table of the report."""
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
ENDS = {"impacts": "stuck: impact after impact at one time", "outside": "the ball has left the box",
        "time": "the end of the time asked for", "budget": "out of budget"}


def table(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def by_figure(rows: Iterable[Sequence[object]]) -> str:
    """A table with a column for each figure."""
    return table(["", *(f"fig {number}" for number in FIGURES)], rows)


def counted(disagreements: list[str]) -> str:
    """The number of disagreements in words."""
    number = len(disagreements)
    return f"**{number} disagreement{'s' * (number > 1)}**" if number else "Zero disagreements"


def refusal(disagreements: list[str]) -> str:
    """The sentence at the head of a report that ends there: answers that are missing are no ground to compare on."""
    listed = "\n".join(f"- {each}" for each in disagreements)
    return f"{counted(disagreements)}: certified answers are missing, so the references were not asked.\n\n{listed}\n"


def verdict(disagreements: list[str], asked: int, earlier: int, true: int) -> str:
    """The sentence at the head of the report, and the disagreements if there are any."""
    listed = "".join(f"\n- {each}" for each in disagreements)
    return (f"{counted(disagreements)}: {asked:,} certified flights were asked for; of {earlier:,} contacts that "
            f"references claim earlier than certified, {true:,} are there.\n{listed}")


def versions() -> str:
    """The packages compared with."""
    return ", ".join(f"{name} {version(name)}" for name in PACKAGES)


def orbits(drifts: list[list[Drift]], impacts: int, narrow: list[tuple[int, int]]) -> str:
    """The table of impacts for which each reference follows an orbit; `narrow`: certified in doubles to 1e-6 periods, and at all."""
    def rows(field: str) -> list[list[object]]:
        values = [[getattr(one, field) for one in line] for line in drifts]
        return [[simulator.name, *("-" if value is None else value for value in line)]
                for simulator, line in zip(SIMULATORS, values)]

    ours = [[f"**{OURS}, interval (doubles)**", *(f"{close} ({every})" for close, every in narrow)],
            [f"**{OURS}, auto**", *([impacts] * len(FIGURES))]]
    own = [[f"{name} ({simulator.tolerance:.0e})", *cells]
           for (name, *cells), simulator in zip(rows("own"), SIMULATORS)]
    return "\n".join([
        f"Impacts in a row on the certified wall and within 1e-6 periods of the certified bracket, of {impacts}; ours: "
        "certified to 1e-6 periods (in all):\n",
        by_figure([*rows("agree"), *ours]),
        "The first impact farther from its bracket than the tolerance asked for (in brackets, in periods):\n",
        by_figure(own),
        "The first impact that is another one: missed, invented, on the wrong wall, or off by a quarter period:\n",
        by_figure(rows("other"))])


def costs(seconds: list[list[float]], ours: list[dict[str, float]]) -> str:
    """Microseconds an impact."""
    def short(value: float) -> str:
        return f"{value:.0f}" if value >= 10 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"

    theirs = [[simulator.name, *(short(1e6 * each) for each in line)] for simulator, line in zip(SIMULATORS, seconds)]
    mine = [[f"**{OURS}, {name}**", *(short(figure[name]) for figure in ours)] for name in ours[0]]
    return by_figure([*theirs, *mine])


def classes(tallies: list[Tally], ours: Sequence[object]) -> str:
    """Right, inexact, missed, invented, unknown; and what became of the earlier contacts."""
    rows = [[simulator.name, *map(one.count, Verdict), one.earlier, one.much_earlier, len(one.proofs)]
            for simulator, one in zip(SIMULATORS, tallies)]
    header = ["", *Verdict, "earlier than certified", "by more than its tolerance", "of these true"]
    return table(header, [*rows, [*ours, "", "", ""]])


def strays(orbits: list[Orbit], tallies: list[Tally]) -> str:
    """The flights that are not even inexact."""
    names = [f"{orbit.name} impact {number}" for orbit in orbits for number in range(1, len(orbit.legs) + 1)]
    lines = []
    for simulator, one in zip(SIMULATORS, tallies):
        wrong = [f"{name} ({verdict})" for name, verdict in zip(names, one.verdicts, strict=True)
                 if verdict not in (Verdict.RIGHT, Verdict.INEXACT)]
        if wrong:
            lines.append(f"- {simulator.name}: {', '.join(wrong)}")
    return "Neither right nor inexact:\n\n" + ("\n".join(lines) or "- none") + "\n"


def families(flown: list[Flown], tallies: list[Tally]) -> str:
    """Right ones of each family, and what the others are."""
    sizes = Counter(one.hard.family for one in flown)

    def cell(family: str, tally: Tally) -> str:
        found = Counter(verdict for one, verdict in zip(flown, tally.verdicts, strict=True)
                        if one.hard.family == family)
        wrong = [f"{found[verdict]} {verdict}" for verdict in Verdict if verdict != Verdict.RIGHT and found[verdict]]
        return f"{found[Verdict.RIGHT]}" + (f" ({', '.join(wrong)})" if wrong else "")

    rows = [[family, size, *(cell(family, tally) for tally in tallies)] for family, size in sizes.items()]
    return table(["", "flights", *(simulator.name for simulator in SIMULATORS)], rows)


def chatter(endings: list[Ending], certified: Certified) -> str:
    """The chatter scene."""
    rows = [[simulator.name, one.listed, one.right, f"{one.last:.13g}", ENDS.get(one.ended, one.ended),
             "yes" if one.after_release else "no"] for simulator, one in zip(SIMULATORS, endings)]
    kinds = {event.kind: event for event in certified.events}
    last = certified.impacts[-1]
    ends = f"rest in {within(kinds['rest'])}, release in {within(kinds['release'])}"
    listed = len(certified.impacts)
    ours = [f"**{OURS}**", listed, listed, f"{float(last.time[0]):.13g}", ends, f"yes, in {within(last)}"]
    header = ["", "impacts listed", "right from the first on", "last one at", "then", "impact after the release"]
    return table(header, [*rows, ours])


def within(event: Event) -> str:
    """The bracket of its time."""
    return f"[{event.time[0]}, {event.time[1]}]"


def controls(refused: int, of: int) -> str:
    """A sentence: an impact is denied, and tried by a reference's right contact."""
    return f"Of {of:,} impacts denied on purpose, {refused:,} are proved by the right contact of a reference.\n"
