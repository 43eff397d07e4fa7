"""Asks the program under test: certified events of a scene, and what an impact costs it."""
import json
import subprocess
from dataclasses import dataclass
from typing import NamedTuple

from scene import Scene


class Event(NamedTuple):
    """An event with bounds as decimal texts, rounded outward; `velocity` is y' before an impact, else None."""
    kind: str
    wall: str
    time: tuple[str, str]
    velocity: tuple[str, str] | None


@dataclass(frozen=True)
class Certified:
    """The events that `run` lists, and the outcome."""
    events: list[Event]
    outcome: str

    @property
    def impacts(self) -> list[Event]:
        return [event for event in self.events if event.kind == "impact"]


def ask(program: str, verb: str, scene: Scene, *arguments: str) -> dict:
    """The JSON document that a verb prints; exit code 1 (not all certified) is an answer, 2 is not."""
    command = [program, verb, "-", "--quiet", "--format", "json", *arguments]
    done = subprocess.run(command, input=scene.toml(), capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        said = f"exit code {done.returncode}: {done.stderr.strip()}"
        raise RuntimeError(f"{' '.join(command[1:])}: {said}\n{scene.toml()}")
    return json.loads(done.stdout)


def certify(program: str, scene: Scene, impacts: int, digits: int, until: str | None = None,
            arithmetic: str = "auto") -> Certified:
    """Certified events of the scene, up to `impacts` impacts and to the time `until`."""
    arguments = ["--impacts", str(impacts), "--digits", str(digits), "--arithmetic", arithmetic]
    arguments += ["--until", until] if until else []
    document = ask(program, "run", scene, *arguments)
    events = [Event(event["event"], event["wall"], tuple(event["time"]),
                    tuple(event["velocity"]) if "velocity" in event else None) for event in document["events"]]
    return Certified(events, document["outcome"]["kind"])


def costs(program: str, scene: Scene, impacts: int) -> dict[str, float]:
    """Microseconds an impact of `trade`'s arithmetics float, interval and auto to 9 digits."""
    found = {row["name"]: row for row in ask(program, "trade", scene, "--impacts", str(impacts))["arithmetics"]}
    return {name: found[name]["microseconds_per_impact"]["orbit"] for name in ("float", "interval", "auto, 9 digits")}
