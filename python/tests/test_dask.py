"""Sweeps on Dask: a local cluster of two worker processes, one of them killed, and the client killed and resumed."""

import os
import signal
import subprocess
import sys
import time

import pytest

from impact_pair import Scene

distributed = pytest.importorskip("distributed")

ASKED = {"transient": 50, "impacts": 20}
CLIENT = """
import sys
from distributed import Client
from impact_pair import Scene

if __name__ == "__main__":
    with Client(sys.argv[1]) as client:
        print("begun", flush=True)
        reported = lambda done: print(done, flush=True)
        how = {{"executor": client.get_executor(), "seconds": 0.05, "resume": sys.argv[2], "progress": reported}}
        Scene.named("figure-14").sweep({over}, **{requested}, **how)
"""


@pytest.fixture(scope="module")
def cluster():
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        yield cluster


def test_on_a_cluster_with_a_worker_killed(cluster, cli, tmp_path):
    killed = []

    def kill_one(done):
        if done >= 8 and not killed:
            killed.append(cluster.workers[0].pid)
            os.kill(killed[0], signal.SIGKILL)

    over = {"amplitude": ("1", "10", 60)}
    with distributed.Client(cluster) as client:
        found = Scene.named("figure-14").sweep(over, **ASKED, executor=client.get_executor(), seconds=0.05, progress=kill_one)
    assert killed
    found.save(tmp_path / "found.csv")
    requested = ("--over", "amplitude=1..10:60", "--transient", 50, "--impacts", 20, "--output", tmp_path / "reported.csv", "--quiet")
    cli.text("sweep", "scenes/figure-14.toml", *requested)
    assert (tmp_path / "found.csv").read_bytes() == (tmp_path / "reported.csv").read_bytes()


@pytest.mark.deep
def test_a_killed_client_is_resumed(cluster, cli, tmp_path):
    over = {"amplitude": ("1", "10", 200)}
    script = CLIENT.format(over=over, requested=ASKED)
    command = [sys.executable, "-c", script, cluster.scheduler_address, tmp_path / "kept"]
    client = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert client.stdout.readline() == "begun\n"
    while int(client.stdout.readline()) < 20:
        pass
    client.kill()
    client.wait()
    time.sleep(0.5)
    first = []
    with distributed.Client(cluster) as again:
        executor = again.get_executor()
        found = Scene.named("figure-14").sweep(over, **ASKED, executor=executor, resume=tmp_path / "kept", progress=first.append)
    # Finished points are not computed again.
    assert first[0] > 20
    found.save(tmp_path / "found.jsonl")
    requested = ("--over", "amplitude=1..10:200", "--transient", 50, "--impacts", 20, "--format", "jsonl")
    assert (tmp_path / "found.jsonl").read_text() == cli.text("sweep", "scenes/figure-14.toml", *requested, "--quiet")
