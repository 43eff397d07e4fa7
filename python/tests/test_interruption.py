"""Ctrl-C, a real signal during long work: it ends the program like any other, and what is proved until then can be had."""

import json
import subprocess
import sys

import numpy as np
import pytest

import impact_pair
from impact_pair import Scene

CHILD = """
import json, os, signal, threading, time
import impact_pair
from impact_pair import Scene

# Whatever started these tests may have left Ctrl-C ignored, as a shell does in the background.
signal.signal(signal.SIGINT, signal.default_int_handler)
begun, sent = threading.Event(), []

def note(done):
    if done >= {least}:
        begun.set()

def send():
    begun.wait()
    sent.append(time.process_time())
    os.kill(os.getpid(), signal.SIGINT)

scene = Scene.named("figure-14")
threading.Thread(target=send, daemon=True).start()
found = {work}
took = time.process_time() - sent[0]
document = found.json() if hasattr(found, "json") else None
print(json.dumps([found.interrupted, getattr(found, "complete", bool(found)), took, document]))
"""

WORKS = {
    "run": "scene.run(impacts=10**6, progress=note, keep_partial=True)",
    "plot": "scene.plot(impacts=10**6, progress=note, keep_partial=True)",
    "bifurcations": """
Scene.named("cascade").bifurcations("RL", 1, {"amplitude": ("0.3", "4")}, doublings=8, progress=note, keep_partial=True)
""".strip(),
    "periodic": 'Scene.named("figure-17").periodic("RLRRLLRRRLLL" * 3, 18, all=True, progress=note, keep_partial=True)',
    "cycles": "scene.cycles((1, 20), progress=note, keep_partial=True)",
    "windows": 'scene.windows({"gap": ("9.42", "9.43")}, impacts=10**9, progress=note, keep_partial=True)',
    "global_analysis": "scene.global_analysis(effort=64, progress=note, keep_partial=True)",
    "tangency": 'scene.tangency({"gap": ("9.42", "9.43")}, longest=30, progress=note, keep_partial=True)',
    "chaos": "scene.chaos(depth=20, progress=note, keep_partial=True)",
    "chaos_cells": 'scene.chaos_cells({"gap": (9, 10, 400)}, progress=note, keep_partial=True)',
    "manifold": 'Scene.named("figure-10").manifold({"frequency": (1, 60, 20000)}, (1, 60), progress=note, keep_partial=True)',
    "two_impact": "scene.two_impact((1, 999), digits=300, progress=note, keep_partial=True)[-1]",
    "describe": "scene.describe(depth=20, progress=note, keep_partial=True)",
    "trade": "scene.trade(impacts=10**6, progress=note, keep_partial=True)",
    "check": "impact_pair.check(scene.run(impacts=4000), progress=note, keep_partial=True)",
    "prove": "impact_pair.prove(scene.run(impacts=800), progress=note, keep_partial=True)",
}


def interrupted(work, least=0):
    """Values from a child that receives a signal once it reports progress of at least ``least``: if it was interrupted and is complete,
    the processor time it took to stop, and the document."""
    code = CHILD.replace("{work}", work).replace("{least}", str(least))
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("work", WORKS)
def test_ctrl_c_keeps_what_is_proved(work):
    is_interrupted, is_complete, took, document = interrupted(WORKS[work], least=50 if work == "run" else 0)
    assert is_interrupted
    assert not is_complete or work == "prove"
    assert took < 10
    if work == "run":
        kept = impact_pair.read_orbit(document)
        assert kept.interrupted
        assert kept.outcome.message.startswith(f"interrupted after impact {len(kept)}")
        whole = Scene.named("figure-14").run(impacts=50)
        assert len(kept) >= 50
        assert not whole.interrupted
        assert np.array_equal(kept.sides[:50], whole.sides)
        assert (kept.t_bounds[:50, 0] <= whole.t_bounds[:, 1]).all()
        assert (whole.t_bounds[:, 0] <= kept.t_bounds[:50, 1]).all()


LOOP = """
import os, signal, threading
import impact_pair

threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    for n in range(1000):
        impact_pair.solve(A=8, W="pi", d="9.42497", e="0.5", v0="-12.56636", impacts=10**6)
except KeyboardInterrupt as stopped:
    print(n, stopped.partial.interrupted, len(stopped.partial) > 0, isinstance(stopped, impact_pair.Stopped))
"""


def test_ctrl_c_ends_a_loop():
    done = subprocess.run([sys.executable, "-c", LOOP], capture_output=True, text=True, check=False, timeout=60)
    assert done.stdout.split() == ["0", "True", "True", "True"], done.stderr


PARTS = """
import json, os, signal, threading
import numpy as np
from impact_pair import Scene

begun = threading.Event()

def note(done):
    if done:
        begun.set()

def send():
    begun.wait()
    os.kill(os.getpid(), signal.SIGINT)

scene = Scene.named("figure-14")
orbit = scene.run(impacts=400)
t = np.linspace(0, 100, 3_000_000)
rects = np.tile([0.0, 3.0, 0.5, 3.5], (400_000, 1))
many = np.ones(3_000_000)
threading.Thread(target=send, daemon=True).start()
found = {work}
kept = np.isfinite({bounds})
print(json.dumps([bool(found.interrupted), int(kept.sum()), len(kept), bool(kept[:100].all())]))
"""


@pytest.mark.parametrize(
    ("work", "bounds"),
    [
        ("orbit(t, progress=note, keep_partial=True)", "found.y"),
        ("scene.flights(many, -many, -1, progress=note, keep_partial=True)", "found.t_bounds[:, 0]"),
        ("scene.box_map(rects, progress=note, keep_partial=True)", "found.rects[:, 0]"),
    ],
)
def test_r35_ctrl_c_keeps_the_first_of_many(work, bounds):
    code = PARTS.replace("{work}", work).replace("{bounds}", bounds)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    is_interrupted, kept, requested, begins = json.loads(done.stdout)
    assert is_interrupted
    assert 0 < kept < requested
    assert begins or work.startswith("scene.box_map")


def test_a_progress_that_raises_stops_the_work_without_a_result():
    def refuse(_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        Scene.named("figure-14").run(impacts=10**6, progress=refuse)
