"""Judges corner cases with several harmonics that no precision tells."""
from collections import Counter

from corner_check import check_events, check_spoiled, graze_proof
from corners import GOES_ON, GRAZES
from program import listing
from recorded import toml


def judge_untold(corner, binary):
    """A Counter: the listing is what is known of the corner, or stops, undecided, with nothing wrong before."""
    arguments = ["--impacts", str(corner.impacts), "--digits", str(corner.digits), "--max-bits", str(corner.max_bits)]
    rows, outcome = listing(binary, toml(corner.tables), arguments)
    if outcome["kind"] == "undecided":
        known = corner._replace(outcome="undecided", events=corner.events[: len(rows)])
    else:
        known = corner
    check_events(known, rows, outcome["kind"])
    tally = Counter(scenes=1, events=len(known.events))
    if known is corner and corner.proof == GRAZES:
        tally += graze_proof(corner, rows, binary)
    tally["spoiled"] += check_spoiled(known, rows, outcome["kind"])
    tally["undecided" if known is not corner else GOES_ON] += 1
    return tally
