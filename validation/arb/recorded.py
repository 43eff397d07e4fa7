"""Recorded scenes: random ones of three families, and starts next to where a simulator has to choose; a scene file a line.

`random.jsonl` has those that the generators of commit 6b44b0b7 (`random_scenes.py`, `extreme_scenes.py`, `several_scenes.py` here) drew
with seed 1995: many of the first come to rest. `straddling.jsonl` has those of `tests/straddle/starts.rs`, which writes others into the file
that `STRADDLE_RECORD` names, of `STRADDLE_SEED` and `STRADDLE_CASES`, in the test `straddle::recorded_starts_are_those_of_the_families`.
"""
import json
import os
import tomllib
from collections import namedtuple
from itertools import islice
from pathlib import Path

from expression import evaluate

HERE = Path(__file__).resolve().parent
STRADDLING = Path(os.environ.get("STRADDLE_RECORD", HERE / "straddling.jsonl"))
# The family of branch boundaries that the start is near, the scene, and the number of impacts requested.
Straddling = namedtuple("Straddling", "family tables impacts")
IMPACTS = 6
# Data that are intervals have other judges; flights of up to 2^58 periods are too long to be followed part by part.
OTHERS = {"boxes of data", "many turns"}


def read(path):
    """(family, tables) of each line."""
    with path.open(encoding="utf-8") as file:
        for line in map(json.loads, file):
            yield line["family"], tomllib.loads(line["scene"])


def random_scenes(family, count):
    """The first `count` scenes of a family."""
    return list(islice((tables for name, tables in read(HERE / "random.jsonl") if name == family), count))


def straddling_scenes(count):
    """The first `count` scenes, the families in turn. Without drift one impact is asked: the second one comes too many forcing periods later."""
    found = (Straddling(family, tables, 1 if family == "no drift" else IMPACTS) for family, tables in read(STRADDLING) if family not in OTHERS)
    return list(islice(found, count))


def is_calm(tables):
    """Small e or small A/d: most of these scenes come to rest at least once."""
    ratio = float(tables["excitation"]["amplitude"].partition("*")[0])
    return float(evaluate(tables["pair"]["restitution"])) <= 0.3 or ratio < 0.1


def toml(tables):
    """The scene file."""
    written = lambda value: json.dumps(value if isinstance(value, list) else str(value))
    lines = []
    for table, values in tables.items():
        lines += [f"[{table}]", *(f"{key} = {written(value)}" for key, value in values.items())]
        lines.append("")
    return "\n".join(lines)
