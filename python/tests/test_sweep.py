"""Sweeps by any executor, killed and resumed: the bytes of `impact-pair sweep` in one process."""

import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context

import numpy as np
import pandas as pd
import pytest
from conftest import assert_rounded_outward

import impact_pair
from impact_pair import Scene
from impact_pair._grid import Question, Rate, compute, question

OVER = {"amplitude": ("1", "10", 40)}
ASKED = {"transient": 50, "impacts": 20}


def from_cli(cli, path, *more):
    cli.text(
        "sweep", "scenes/figure-14.toml", "--over", "amplitude=1..10:40", "--transient", 50, "--impacts", 20,
        "--output", path, "--quiet", *more,
    )  # fmt: skip
    return path.read_bytes()


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    from conftest import Cli

    folder = tmp_path_factory.mktemp("told")
    return {ending: from_cli(Cli(), folder / f"told.{ending}", "--format", ending) for ending in ("jsonl", "csv")}


def saved(found, tmp_path, ending):
    found.save(tmp_path / f"found.{ending}")
    return (tmp_path / f"found.{ending}").read_bytes()


def test_in_this_process(cli, files, tmp_path):
    found = Scene.named("figure-14").sweep(OVER, **ASKED)
    for ending in ("jsonl", "csv"):
        assert saved(found, tmp_path, ending) == files[ending]
    picture = tmp_path / "told.svg"
    from_cli(cli, tmp_path / "again.csv", "--plot", picture, "--arithmetic", "auto")
    assert found.svg() == picture.read_text()
    assert found.complete
    assert sum(found.outcomes.values()) == found.points == len(found) == 40


def test_arrays_are_rounded_outward(files):
    found = Scene.named("figure-14").sweep(OVER, **ASKED)
    records = [json.loads(line) for line in files["jsonl"].decode().splitlines()[1:]]
    states = [state for record in records for state in record["states"]]
    assert_rounded_outward(found.states["phase"], [state["phase"] for state in states])
    assert_rounded_outward(found.states["velocity"], [state["velocity"] for state in states])
    frame = found.to_pandas()
    assert len(frame) == len(states) + len(records)
    assert list(frame["outcome"].dropna()) == [record["outcome"] for record in records]
    assert found.to_arrow().num_rows == len(frame)


def test_points_and_states_are_tables_of_their_own(cli, tmp_path):
    found = Scene.named("figure-14").sweep(OVER, **ASKED)
    found.save(tmp_path / "points.csv", states=tmp_path / "states.csv")
    points = from_cli(cli, tmp_path / "told.csv", "--states", tmp_path / "told-states.csv")
    assert (tmp_path / "points.csv").read_bytes() == points
    assert (tmp_path / "states.csv").read_bytes() == (tmp_path / "told-states.csv").read_bytes()
    mixed = found.to_pandas()
    for rows, record, more in (("points", "point", {"index"}), ("states", "state", {"outcome", "exponent_lower", "word"})):
        frame, of_kind = found.to_pandas(rows), mixed[mixed["record"] == record].reset_index(drop=True)
        assert len(frame) > 0
        pd.testing.assert_frame_equal(frame, of_kind[frame.columns], check_dtype=False)
        left = of_kind.drop(columns=[*frame.columns, "record"])
        assert more <= set(left.columns)
        assert left.isna().all(axis=None)
        assert found.to_arrow(rows).column_names == list(frame.columns)
    with pytest.raises(impact_pair.RangeError, match="rows is both"):
        found.to_pandas("both")


@pytest.mark.parametrize(
    ("path", "states", "said"),
    [
        ("a.jsonl", "b.csv", "a.jsonl, but points and states are two tables in .csv or .parquet"),
        ("a.csv", "b.svg", "b.svg, but points and states are two tables in .csv or .parquet"),
        ("a.csv", "../kept/a.csv", "path and states name the same file"),
    ],
)
def test_states_that_are_no_table_are_refused(tmp_path, path, states, said):
    folder = tmp_path / "kept"
    folder.mkdir()
    found = Scene.named("figure-14").sweep({"amplitude": (1, 2, 2)}, transient=20, impacts=2)
    with pytest.raises(impact_pair.Error, match=said):
        found.save(folder / path, states=folder / states)
    found = Scene.named("figure-14").sweep({"amplitude": (1, 2, 2)}, transient=20, impacts=2, summary=True)
    with pytest.raises(impact_pair.Error, match="a sweep with summary has none"):
        found.save(folder / "a.csv", states=folder / "b.csv")
    assert not list(folder.iterdir())


@pytest.mark.parametrize("workers", [1, 3])
def test_by_processes(files, tmp_path, workers):
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as executor:
        found = Scene.named("figure-14").sweep(OVER, **ASKED, executor=executor, seconds=0.05)
    for ending in ("jsonl", "csv"):
        assert saved(found, tmp_path, ending) == files[ending]


def test_by_threads(files, tmp_path):
    with ThreadPoolExecutor(2) as executor:
        found = Scene.named("figure-14").sweep(OVER, **ASKED, executor=executor, seconds=0.05)
    assert saved(found, tmp_path, "jsonl") == files["jsonl"]


def test_two_keys_and_summaries(cli, tmp_path):
    over = {"start.time": (0, 2, 5), "start.velocity": (-6, 0, 4)}
    found = Scene.named("cascade").sweep(over, transient=100, impacts=5, summary=True)
    cli.text(
        "sweep", "scenes/cascade.toml", "--over", "start.time=0..2:5", "--over", "start.velocity=-6..0:4",
        "--transient", 100, "--impacts", 5, "--summary", "--output", tmp_path / "told.csv", "--quiet",
    )  # fmt: skip
    assert saved(found, tmp_path, "csv") == (tmp_path / "told.csv").read_bytes()


class Mortal(ThreadPoolExecutor):
    """Dies after some chunks."""

    def __init__(self, chunks):
        super().__init__(1)
        self.left = chunks

    def submit(self, function, /, *args):
        self.left -= 1
        if self.left < 0:
            raise RuntimeError("gone")
        return super().submit(function, *args)


def test_what_is_finished_is_kept_and_gone_on_with(files, tmp_path):
    scene = Scene.named("figure-14")
    with pytest.raises(impact_pair.Interrupted, match="gone"):
        scene.sweep(OVER, **ASKED, executor=Mortal(6), workers=1, seconds=0.02, resume=tmp_path)
    [journal] = tmp_path.iterdir()
    kept = journal.read_bytes()
    # A damaged line is refused; a torn one is forgotten, and its point computed again.
    journal.write_bytes(kept.replace(b'"point":1,', b'"point":2,', 1))
    with pytest.raises(impact_pair.Error, match="it is corrupted"):
        scene.sweep(OVER, **ASKED, resume=tmp_path)
    journal.write_bytes(kept[:-20])
    computed = []
    with ThreadPoolExecutor(1) as executor:
        found = scene.sweep(OVER, **ASKED, executor=executor, seconds=0.02, resume=tmp_path, progress=computed.append)
    assert saved(found, tmp_path, "csv") == files["csv"]
    # Its head, and the torn one.
    assert computed[0] > kept.count(b"\n") - 2
    # Nothing is left to compute; another question has another file.
    assert saved(scene.sweep(OVER, **ASKED, executor=Mortal(0), resume=tmp_path), tmp_path, "jsonl") == files["jsonl"]
    with pytest.raises(impact_pair.Interrupted):
        scene.sweep(OVER, transient=51, impacts=20, executor=Mortal(0), resume=tmp_path)


def test_the_key_is_of_scene_grid_and_question():
    own = question(Scene.named("figure-14").text, "sweep", OVER, ASKED)
    other = replace(own, scene=Scene.named("figure-13").text)
    assert own.key() != other.key()
    # Neither the layout of the file nor how a number is written decides, nor a default that is given.
    again = question(Scene.named("figure-14").text + "\n# a remark\n", "sweep", {"A": (1, 10.0, 40)}, ASKED | {"digits": 6})
    assert own.key() == again.key()
    assert compute(own, 3, 6, own.key())[0] == compute(own, 3, 6, own.key())[0]


def test_r41_a_worker_of_another_version_is_refused(monkeypatch):
    original = Question.key
    # In the process that asks, the first one to make a key, it is that of another version.
    answers = iter(["0" * 32])
    monkeypatch.setattr(Question, "key", lambda question: next(answers, None) or original(question))
    with ThreadPoolExecutor(1) as executor, pytest.raises(impact_pair.Error, match="a worker has another version, impact-pair"):
        Scene.named("figure-14").sweep({"amplitude": (1, 2, 3)}, transient=0, impacts=1, executor=executor)


def test_a_killed_worker_loses_nothing(files, tmp_path):
    scene = Scene.named("figure-14")
    over = {"amplitude": ("1", "10", 40)}

    def kill_one(done):
        if done >= 3 and not killed:
            killed.append(next(iter(executor._processes)))
            os.kill(killed[0], signal.SIGKILL)

    killed = []
    executor = ProcessPoolExecutor(2, mp_context=get_context("spawn"))
    with pytest.raises(impact_pair.Interrupted), executor:
        scene.sweep(over, **ASKED, executor=executor, seconds=0.01, resume=tmp_path, progress=kill_one)
    assert killed
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as executor:
        found = scene.sweep(over, **ASKED, executor=executor, resume=tmp_path)
    assert saved(found, tmp_path, "csv") == files["csv"]


def test_what_cannot_be_swept_is_refused():
    scene = Scene.named("figure-14")
    for over in ({"amplitude": (10, 1, 4)}, {"mass": (1, 2, 3)}, {"restitution": (0, 2, 3)}, {}):
        with pytest.raises(impact_pair.RangeError):
            scene.sweep(over)
    with pytest.raises(impact_pair.RangeError, match="impacts is 0"):
        scene.sweep(OVER, impacts=0)


def test_chunks_grow_to_the_requested_seconds():
    rate = Rate(10.0, 2)
    assert rate.size(10**9) == 1
    rate.report(1, 0.01)
    assert rate.size(10**9) == 8
    for _ in range(8):
        size = rate.size(10**9)
        rate.report(size, 0.01 * size)
    assert rate.size(10**9) == pytest.approx(1000, rel=0.01)
    assert rate.size(80) == 10


SWEEPING = """
import sys
import impact_pair
scene = impact_pair.Scene.named("figure-14")
print("begun", flush=True)
found = scene.sweep({"amplitude": (1, 10, 10**6)}, transient=50, impacts=20, resume=sys.argv[1] or None, keep_partial=True)
print(found.interrupted, found.complete, len(list(found)), *(record["point"] for record in found if record["point"] < 40))
"""


@pytest.mark.parametrize("is_kept", [False, True])
def test_r35_ctrl_c_keeps_the_finished_points_of_a_sweep(is_kept, tmp_path):
    command = [sys.executable, "-c", SWEEPING, str(tmp_path) if is_kept else ""]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begun\n"
    time.sleep(1.0)
    child.send_signal(signal.SIGINT)
    began = time.monotonic()
    interrupted, complete, points, *first = child.stdout.read().split()
    assert child.wait() == 0
    assert time.monotonic() - began < 10
    assert (interrupted, complete) == ("True", "False")
    assert len(first) <= int(points) < 10**6
    assert first[:8] == [str(point) for point in range(8)]
    if is_kept:
        over = {"amplitude": (1, 10, 10**6)}
        [journal] = tmp_path.iterdir()
        assert journal.name == f"{question(Scene.named('figure-14').text, 'sweep', over, ASKED).key()}.partial"
        assert journal.read_bytes().count(b"\n") == int(points) + 1


class Stopped(ThreadPoolExecutor):
    """A terminal with a person before it, who has seen enough."""

    def submit(self, function, /, first, *args):
        if args[0] > 3:
            raise KeyboardInterrupt
        return super().submit(function, first, *args)


def test_r35_an_interrupted_sweep_has_its_finished_points(files, tmp_path):
    with Stopped(1) as executor:
        found = Scene.named("figure-14").sweep(OVER, **ASKED, executor=executor, workers=1, seconds=0.001, keep_partial=True)
    assert found.interrupted
    assert not found.complete
    assert "interrupted, " in repr(found)
    assert " of 40 points are missing" in repr(found)
    from_cli = [json.loads(line) for line in files["jsonl"].splitlines()[1:]]
    assert list(found) == from_cli[: len(list(found))]
    assert list(pickle.loads(pickle.dumps(found))) == list(found)
    assert sum(found.outcomes.values()) == len(found.to_pandas("points")) < len(found) == 40
    found.save(tmp_path / "found.csv")
    assert files["csv"].startswith((tmp_path / "found.csv").read_bytes())
    for work in (found.to_xarray, lambda: found.save(tmp_path / "a.jsonl"), lambda: found.save(tmp_path / "a.nc")):
        with pytest.raises(impact_pair.Interrupted, match="the sweep was interrupted"):
            work()


def test_long_work_releases_the_gil_and_tells_how_far_it_is():
    from_cli, ticks = [], []
    work = threading.Thread(target=lambda: Scene.named("figure-14").run(impacts=4000, progress=from_cli.append))
    work.start()
    while work.is_alive():
        ticks.append(time.monotonic())
        time.sleep(0.001)
    assert max(np.diff(ticks), default=0) < 0.5
    assert from_cli == sorted(from_cli)
    assert len(from_cli) >= 1
