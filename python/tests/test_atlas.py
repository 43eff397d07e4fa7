"""Atlases: the rows of the command line, on any executor, on Dask with a worker killed, and the page in a browser."""

import json
import os
import re
import shutil
import signal
import subprocess
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction

import pytest

import impact_pair
from impact_pair import Scene

PLANE = {"amplitude": ("5", "9", 3), "restitution": ("0.05", "0.2", 2)}
FEW = {"effort": Fraction(1, 150)}
ASKED = ("--over", "amplitude=5..9:3", "--over", "restitution=0.05..0.2:2", "--effort", "1/150")


@pytest.fixture(scope="module")
def lines(cli):
    """The lines of the command line."""
    return cli.text("atlas", "scenes/figure-14.toml", *ASKED, "--format", "jsonl").splitlines()


def untimed(lines):
    return [{key: value for key, value in json.loads(line).items() if key != "seconds"} for line in lines]


def test_an_atlas_is_that_of_the_command_line(lines, tmp_path):
    done = []
    found = Scene.named("figure-14").atlas(PLANE, **FEW, progress=done.append)
    found.save(tmp_path / "found.jsonl")
    assert untimed((tmp_path / "found.jsonl").read_text().splitlines()) == untimed(lines)
    assert (done[-1], len(found), found.interrupted) == (6, 6, False)
    assert found.complete == all(json.loads(line)["class"].startswith("one-") for line in lines[1:])
    table = found.to_pandas()
    names = "point amplitude_lower amplitude_upper restitution_lower restitution_upper class n_attracting n_rest n_saddle"
    assert list(table) == [*names.split(), "n_undecided", "undecided_area", "seconds"]
    assert table["amplitude_lower"].tolist() == [5, 5, 7, 7, 9, 9]
    assert table["seconds"].dtype == float
    assert found.to_arrow().schema.metadata[b"impact-pair/atlas"].decode() == lines[0]
    assert sum(found.classes.values()) == 6
    assert impact_pair.check(tmp_path / "found.jsonl") or "undecided" in found.classes
    found.save(tmp_path / "found.csv")
    assert (tmp_path / "found.csv").read_text().count("\n") == 7
    assert found.html().startswith("<!doctype html>")
    assert found._repr_svg_().startswith("<svg")
    assert repr(found).startswith("<atlas over amplitude=5..9:3 and restitution=0.05..0.2:2: ")


def test_r45_cells_have_their_ends_rounded_inward():
    # The class of a cell is proved between its ends: doubles beyond them are in another cell, or in none.
    found = Scene.named("figure-14").atlas({"gap": ("1/3", "2/3", 2), "restitution": (0.05, 0.1, 2)}, cells=True, effort=0.1)
    table = found.to_pandas()
    assert len(table) >= 4
    low, high = table["gap_low"].min(), table["gap_high"].max()
    assert Fraction(1, 3) <= Fraction(low) < Fraction(1, 3) + Fraction(1, 10**15)
    assert Fraction(2, 3) - Fraction(1, 10**15) < Fraction(high) <= Fraction(2, 3)
    assert list(table)[-2:] == ["n_stable", "entropy"]


def test_workers_and_folders_give_the_same(lines, tmp_path):
    with ProcessPoolExecutor(2) as executor:
        found = Scene.named("figure-14").atlas(PLANE, **FEW, executor=executor, seconds=0.05, resume=tmp_path / "kept")
    assert untimed(b"".join(found.lines()).splitlines()) == untimed(lines[1:])
    again = Scene.named("figure-14").atlas(PLANE, **FEW, resume=tmp_path / "kept")
    # Nothing is computed again: the seconds are those kept.
    assert list(again.lines()) == list(found.lines())


@pytest.mark.deep
def test_on_a_cluster_with_a_worker_killed(lines):
    distributed = pytest.importorskip("distributed")
    killed = []

    def kill_one(done):
        if done >= 2 and not killed:
            killed.append(cluster.workers[0].pid)
            os.kill(killed[0], signal.SIGKILL)

    workers = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with distributed.LocalCluster(**workers) as cluster, distributed.Client(cluster) as client:
        how = {"executor": client.get_executor(), "seconds": 0.05, "progress": kill_one}
        found = Scene.named("figure-14").atlas(PLANE, **FEW, **how)
    assert killed
    assert untimed(b"".join(found.lines()).splitlines()) == untimed(lines[1:])


@pytest.mark.parametrize(
    ("over", "said"),
    [
        ({"gap": (1, 2, 3)}, "accepted are two axes"),
        ({"gap": (1, 2, 3), "start.time": (0, 1, 2)}, "the start is not used"),
        ({"gap": (1, 2, 3), "restitution": (0, 1, 2)}, "must be below 0.99"),
    ],
)
def test_what_is_no_plane_is_refused(over, said):
    with pytest.raises(impact_pair.Error, match=said):
        Scene.named("figure-14").atlas(over)


#: Events of a reader, and what the page then shows, in the title that the browser prints.
READER = """
const said = [];
const note = () => said.push(tip.hidden ? "" : tip.textContent, panel.hidden ? "" : panel.textContent);
const key = (name) => plane.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true }));
const pointer = (name, x, y) => {
  const box = plane.getBoundingClientRect();
  const at = { clientX: box.left + x * box.width, clientY: box.top + y * box.height, bubbles: true };
  plane.dispatchEvent(new PointerEvent(name, { ...at, pointerType: "touch" }));
};
plane.focus(); note();
key("ArrowRight"); key("ArrowUp"); note();
key("Enter"); note();
key("Escape"); note();
pointer("pointermove", 0.99, 0.99); note();
pointer("click", 0.01, 0.01); note();
const shown = document.createElement("pre");
shown.id = "said";
shown.textContent = JSON.stringify(said);
document.body.append(shown);
"""


@pytest.mark.skipif(shutil.which("chromium") is None, reason="there is no Chromium")
def test_the_page_is_read_by_keyboard_pointer_and_touch_in_chromium(tmp_path):
    found = Scene.named("figure-14").atlas(PLANE, **FEW)
    page = found.html().replace("</script>\n</body>", f"{READER}</script>\n</body>")
    (tmp_path / "page.html").write_text(page)
    command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1000,1000", "--virtual-time-budget=2000"]
    done = subprocess.run([*command, "--dump-dom", f"file://{tmp_path}/page.html"], capture_output=True, text=True, check=True, timeout=120)
    said = re.search(r'<pre id="said">(.*?)</pre>', done.stdout, re.DOTALL)
    assert said, done.stdout[-2000:]
    tips, panels = (json.loads(said[1])[i::2] for i in (0, 1))
    rows = found.to_dict()
    places = [f"amplitude = {amplitude}, restitution = {restitution}" for amplitude in (5, 7, 9) for restitution in ("0.05", "0.2")]
    named = [f"{name}: {place}" for name, place in zip(rows["class"], places, strict=True)]
    # The first one has the focus; right and up from it; Enter opens, Escape closes; the lower right corner; a tap on the upper left one.
    assert tips == [named[0], named[3], named[3], "", named[4], named[1]]
    assert [bool(panel) for panel in panels] == [False, False, True, False, False, True]
    assert panels[2].startswith("amplitude = 7, restitution = 0.2")
    assert "impact-pair global - --effort 0.006666666666666667 " in panels[2]
    assert 'pair = { gap = "9.42497", restitution = "0.2" }' in panels[2]
    # It asks for nothing from elsewhere.
    assert not re.search(r'(?:src|href|srcset)="(?!data:)', found.html())
