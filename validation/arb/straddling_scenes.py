"""Scenes that start next to where a simulator has to choose: those of `tests/straddle/starts.rs`, as recorded, or as another file has them.

`STRADDLE_RECORD=FILE` with the test `straddle::recorded_starts_are_those_of_the_families` writes one, of `STRADDLE_SEED` and `STRADDLE_CASES`.
"""
import json
import os
import tomllib
from collections import namedtuple
from itertools import islice
from pathlib import Path

# The family of branch boundaries that the start is near, the scene, and the number of impacts requested.
Straddling = namedtuple("Straddling", "family tables impacts")
FILE = Path(os.environ.get("STRADDLE_RECORD", Path(__file__).resolve().parent / "straddling.jsonl"))
IMPACTS = 6
# Data that are intervals have other judges; flights of up to 2^58 periods are too long to be followed part by part.
OTHERS = {"boxes of data", "many turns"}


def straddling_scenes(count):
    """So many scenes, the families in turn."""
    with FILE.open(encoding="utf-8") as file:
        lines = (json.loads(line) for line in file)
        return list(islice((read(line) for line in lines if line["family"] not in OTHERS), count))


def read(line):
    """A line of the file; without drift the second impact is as many forcing periods away as the drift is small."""
    return Straddling(line["family"], tomllib.loads(line["scene"]), 1 if line["family"] == "no drift" else IMPACTS)
