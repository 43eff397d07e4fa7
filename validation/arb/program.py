"""Runs `impact-pair run`, or another verb, on a scene and reads what it lists."""
import json
import subprocess

from compare import Disagreement, read_rows
from simulate import HEADER

# Seconds after which the program under test is stopped.
TIMEOUT = 120


def run(binary, text, arguments, form, verb="run"):
    """The lines that the program under test prints."""
    command = [binary, verb, "-", "--quiet", *arguments, "--format", form]
    try:
        done = subprocess.run(command, input=text, capture_output=True, text=True, check=False, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        raise Disagreement(f"{' '.join(command[1:])}: no end after {TIMEOUT} seconds") from None
    if done.returncode not in (0, 1):
        raise Disagreement(f"{' '.join(command[1:])}: exit code {done.returncode}: {done.stderr.strip()}")
    return done.stdout.splitlines()


def as_row(event):
    """An event of the JSON Lines as a row of the CSV."""
    row = {key: "" if event.get(key) is None else str(event[key]) for key in HEADER[:4]}
    for name in ("time", "velocity"):
        row[f"{name}_lower"], row[f"{name}_upper"] = event.get(name, ("", ""))
    return row


def listing(binary, text, arguments):
    """(rows, outcome): the CSV and, after the same events, the outcome of the JSON Lines."""
    rows = read_rows(run(binary, text, arguments, "csv"))
    _, *events, last = [json.loads(line) for line in run(binary, text, arguments, "jsonl")]
    if [as_row(event) for event in events] != rows:
        raise Disagreement("CSV and JSON Lines list different events")
    return rows, last["outcome"]
