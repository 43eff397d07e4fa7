"""Lists of impacts: what the reference simulators find of a scene, and the formats that people export them in."""
import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from runs import SIMULATORS, Question, answer
from scene import LEFT, Scene, doubles, rounded
from simulator import Simulator

WANTED = ("SciPy RK45, defaults", "SciPy DOP853, 1e-12", "heyoka")


class Row(NamedTuple):
    """A listed impact; numbers as they are written."""
    time: str
    wall: str
    velocity: str


def references() -> list[Simulator]:
    """The simulators that are audited."""
    return [simulator for simulator in SIMULATORS if simulator.name in WANTED]


def simulate(simulator: Simulator, scene: Scene, until: float, limit: int) -> list[Row]:
    """The contacts that a simulator finds; doubles as their shortest decimals."""
    question = Question(doubles(scene.motion()), rounded(scene.start()), until, limit)
    contacts = answer(simulator, question).listing.contacts
    return [Row(repr(float(one.time)), one.wall, repr(float(one.before))) for one in contacts]


def certified(document: dict) -> list[Row]:
    """The impacts of an orbit JSON: a bound of each."""
    impacts = (event for event in document["events"] if event["event"] == "impact")
    return [Row(event["time"][0], event["wall"], event["velocity"][0]) for event in impacts]


def csv(rows: Sequence[Row]) -> str:
    """Columns time,wall,velocity with a header."""
    return "time,wall,velocity\n" + "".join(",".join(row) + "\n" for row in rows)


def savetxt(rows: Sequence[Row]) -> str:
    """As `numpy.savetxt` writes it: blanks, the header in a comment, walls -1 and +1."""
    table = [[float(row.time), -1.0 if row.wall == LEFT else 1.0, float(row.velocity)] for row in rows]
    text = io.StringIO()
    np.savetxt(text, np.array(table), header="t side v")
    return text.getvalue()


def matlab(rows: Sequence[Row]) -> str:
    """As MATLAB's `save -ascii -double` writes it: blanks, no header."""
    table = ([float(row.time), -1.0 if row.wall == LEFT else 1.0, float(row.velocity)] for row in rows)
    return "".join("".join(f"  {value: .16e}" for value in line) + "\n" for line in table)


def tsv_of_positions(rows: Sequence[Row], half: float) -> str:
    """Tabs, columns in another order, and y = -d/2 or +d/2 for the wall."""
    lines = (f"{i}\t{row.velocity}\t{-half if row.wall == LEFT else half!r}\t{row.time}\n" for i, row in enumerate(rows))
    return "n\tvel\ty\tt_impact\n" + "".join(lines)


def objects(rows: Sequence[Row]) -> str:
    """A JSON array of objects."""
    return json.dumps([{"time": float(row.time), "wall": row.wall[0].upper(), "velocity": float(row.velocity)} for row in rows])


def arrays(rows: Sequence[Row]) -> str:
    """A JSON object of arrays."""
    return json.dumps({"time": [float(row.time) for row in rows], "wall": [row.wall for row in rows],
                       "velocity": [float(row.velocity) for row in rows]})


def written(folder: Path, name: str, text: str) -> Path:
    """The file with this text."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path
