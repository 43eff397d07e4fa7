"""Runs `impact-pair run` on an orbit, as a user would, and reads its events."""
import json
import subprocess
from collections import namedtuple

from mpmath import mpf

OTHER = {"left": "right", "right": "left"}
Event = namedtuple("Event", "kind mapping wall time velocity")
Run = namedtuple("Run", "outcome certified events")


class Disagreement(Exception):
    """The program and the closed form contradict each other."""


def scene(orbit, wall="left", time="0", factor="1", theta_sign=""):
    """The scene file of an orbit; on the right wall its mirror image, tau + pi and -v.

    `factor` on the velocity and a `theta_sign` of "-" spoil it. Data that are intervals are taken as they are.
    """
    texts = orbit.texts
    is_left, phase, speed = wall == "left", texts["theta0"], texts["speed"]
    if not phase.startswith("["):
        phase = f"{theta_sign}({phase}){'' if is_left else ' + pi'} - ({texts['frequency']})*({time})"
    if not speed.startswith("["):
        speed = f"({speed})*({factor})"
    return f"""\
[excitation]
amplitude = "{texts['amplitude']}"
frequency = "{texts['frequency']}"
phase = "{phase}"
[pair]
gap = "{texts['gap']}"
restitution = "{texts['restitution']}"
[start]
time = "{time}"
wall = "{wall}"
velocity = "{negated(speed) if is_left else speed}"
"""


def negated(text):
    """Minus an expression, or minus an interval."""
    if not text.startswith("["):
        return f"-({text})"
    low, high = text[1:-1].split(",")
    return f"[-({high.strip()}), -({low.strip()})]"


def run(binary, text, impacts, digits=9, arithmetic="auto"):
    """A `Run`; bounds as pairs of mpmath numbers."""
    command = [binary, "run", "-", "--quiet", "--impacts", str(impacts), "--digits", str(digits)]
    command += ["--arithmetic", arithmetic, "--format", "json"]
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise Disagreement(f"exit code {done.returncode}: {done.stderr.strip()}\n{text}")
    data = json.loads(done.stdout)
    events = [
        Event(event["event"], event.get("mapping"), event["wall"], pair(event["time"]), pair(event.get("velocity")))
        for event in data["events"]
    ]
    return Run(data["outcome"]["kind"], data["certified"], events)


def pair(bounds):
    return tuple(mpf(bound) for bound in bounds) if bounds else None
