"""Beyond the paper: a completed chatter ends in rest, and a second release from one wall makes the motion periodic."""
import random

from flint import arb

from finding import PROVED, SEEN, Finding, expect
from program import Run, bounds, scene


def rest():
    """The run of scenes/chatter.toml."""
    run = Run("scenes/chatter.toml")
    period = run.outcome.get("period", {})
    expect(run.outcome["kind"] == "periodic" and period == {"cycles": 9, "impacts": 23}, "9 cycles, 23 impacts")
    skipped = [event for event in run.events if event.get("skipped") == "infinite"]
    expect(len(skipped) == run.count("rest") > 1, "every rest ends infinitely many impacts")
    for event in run.events:
        if event["event"] == "release":
            # th is a whole number of forcing periods (left) or half a forcing period more (right): the acceleration turns inward.
            th = run.frequency * bounds(event["time"]) + arb.pi()
            turns = (th - arb.pi() * (event["wall"] == "right")) / (2 * arb.pi())
            expect(turns.unique_fmpz() is not None and event["time"][0] == event["time"][1], "an exact phase")
    return [Finding("a completed chatter ends in rest; after two releases from one wall all is periodic", PROVED,
                    f"{run.count('rest')} rests after infinitely many impacts, released at exact phases; 23 impacts "
                    "every 9 cycles for ever")]


def recurrent():
    """Random starts that come to rest again and again, at some `A/d` and `e`, and none within 500 impacts at others."""
    chance, shown = random.Random(181), []
    for e, ratio, rests in (("0", "0.2", True), ("0", "0.3", False), ("0", "0.4", True), ("0.3", "1.2", False),
                            ("0.3", "1.42", True), ("0.5", "2.7", False), ("0.5", "3.3", True)):
        for _ in range(4):
            start = scene("1", e, f"-{chance.uniform(0.1, 3):.3f}*{ratio}", f"{chance.uniform(0, 6):.3f}", ratio)
            run = Run(start, "--impacts", "500")
            expect((run.outcome["kind"] == "periodic") == rests, f"e = {e}, A/d = {ratio}")
        shown.append(f"({e}, {ratio}) {'all' if rests else 'none'}")
    return Finding("rest again and again is what random starts come to at large A/d, for e = 0 at small A/d too",
                   SEEN, "4 random starts each at (e, A/d): " + ", ".join(shown))


CLAIMS = {"rest": lambda quick: [*rest(), recurrent()]}
