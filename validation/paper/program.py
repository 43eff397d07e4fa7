"""`impact-pair run` on a scene, its certified bounds as balls in the units of pair.py."""
import json
import os
import re
import subprocess
from pathlib import Path

from flint import arb

from pair import Pair

ROOT = Path(__file__).resolve().parents[2]
BINARY = os.environ.get("IMPACT_PAIR", str(ROOT / "target/release/impact-pair"))


def number(text):
    """The value of a scene's expression as a ball."""
    exact = re.sub(r"\d+\.?\d*", lambda found: f'arb("{found[0]}")', text.replace("^", "**"))
    return arb(eval(exact, {"__builtins__": {}, "arb": arb, "pi": arb.pi(), "sqrt": arb.sqrt}))


def bounds(pair):
    """The ball that holds [lower, upper], two decimal strings."""
    return arb(pair[0]).union(arb(pair[1]))


def document(scene, *options):
    """The JSON of `impact-pair run`; `scene` is a path from the root of the repository, or a scene's text."""
    command = [BINARY, "run", "-" if "\n" in scene else str(ROOT / scene), "--quiet", "--format", "json", *options]
    done = subprocess.run(command, input=scene, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def listed_walls(scene, *options):
    """The walls of the listed impacts, certified or not."""
    return [event["wall"] for event in document(scene, *options)["events"] if event["event"] == "impact"]


class Run:
    """A certified listing: `pair`, `start` and `impacts` as (wall, th, v), `events` as listed, `outcome`."""

    def __init__(self, scene, *options):
        listing = document(scene, *options)
        assert listing["certified"] is True
        self.outcome, self.events, scene = listing["outcome"], listing["events"], listing["scene"]
        amplitude, self.frequency, tau = (number(scene["excitation"][key][0])
                                          for key in ("amplitude", "frequency", "phase"))
        self.pair = Pair(number(scene["gap"]) / amplitude, number(scene["restitution"]))

        def state(wall, time, velocity):
            return wall, self.frequency * time + tau, velocity / (amplitude * self.frequency)

        begin = scene["start"]
        self.start = state(begin["wall"], number(begin["time"]), number(begin["velocity"]))
        self.impacts = [state(event["wall"], bounds(event["time"]), bounds(event["velocity"]))
                        for event in self.events if event["event"] == "impact"]

    def count(self, kind):
        """Number of listed events of a kind."""
        return sum(event["event"] == kind for event in self.events)


def scene(gap, restitution, velocity, phase=0, amplitude=1, frequency=1, wall="left"):
    """The text of a scene that starts at t = 0 on a wall; values are scene expressions."""
    return f"""[excitation]
amplitude = "{amplitude}"
frequency = "{frequency}"
phase = "{phase}"
[pair]
gap = "{gap}"
restitution = "{restitution}"
[start]
time = 0
wall = "{wall}"
velocity = "{velocity}"
"""
