"""Beyond the paper: a completed chatter ends in rest, and a second release from one wall makes the motion periodic."""
from flint import arb

from finding import PROVED, Finding, expect
from program import Run, bounds


def rest(quick):
    """The run of scenes/chatter.toml."""
    run = Run("scenes/chatter.toml")
    period = run.outcome.get("period", {})
    expect(run.outcome["kind"] == "periodic" and (period["cycles"], period["impacts"]) == (9, 23), "9 cycles, 23 impacts")
    skipped = [event for event in run.events if event.get("skipped") == "infinite"]
    expect(len(skipped) == run.count("rest") > 1, "every rest ends infinitely many impacts")
    for event in run.events:
        if event["event"] == "release":
            # Half turns from th = 0 (left) or pi (right): where the box's acceleration turns inward.
            turns = (run.frequency * bounds(event["time"]) + arb.pi()) / (2 * arb.pi()) - (event["wall"] == "right") / arb(2)
            expect(turns.unique_fmpz() is not None and event["time"][0] == event["time"][1], "an exact phase")
    return [Finding("a completed chatter ends in rest; after two releases from one wall all is periodic", PROVED,
                    f"{run.count('rest')} rests after infinitely many impacts, released at exact phases; 23 impacts every "
                    "9 cycles for ever")]


CLAIMS = {"rest": rest}
