"""Files: the ending of the name chooses the format, and one that cannot be written is refused."""

import json

import pytest

import impact_pair
from impact_pair import Scene


@pytest.fixture(scope="module")
def orbit():
    return Scene.named("chatter").run(impacts=30)


@pytest.mark.parametrize("ending", ["csv", "json", "JSON"])
def test_r35_an_orbit_is_saved_as_the_command_line_writes_it(cli, tmp_path, orbit, ending):
    orbit.save(tmp_path / f"here.{ending}")
    cli.text("run", "scenes/chatter.toml", "--impacts", 30, "--output", tmp_path / f"there.{ending}")
    assert (tmp_path / f"here.{ending}").read_bytes() == (tmp_path / f"there.{ending}").read_bytes()


def test_r35_json_lines_are_a_certificate(tmp_path, orbit):
    orbit.save(tmp_path / "orbit.jsonl")
    lines = (tmp_path / "orbit.jsonl").read_text().splitlines()
    assert len(lines) == len(orbit.events) + 2
    assert json.loads(lines[-1])["outcome"]["kind"] == orbit.outcome.kind
    assert impact_pair.check(tmp_path / "orbit.jsonl").verdict == "confirmed"


def test_r35_an_orbit_is_saved_for_others(tmp_path, orbit):
    from pyarrow import parquet
    from scipy.io import loadmat

    orbit.save(tmp_path / "orbit.parquet")
    assert parquet.read_table(tmp_path / "orbit.parquet").equals(orbit.to_arrow())
    orbit.save(tmp_path / "orbit.mat")
    assert loadmat(tmp_path / "orbit.mat")["index"].size == len(orbit)


@pytest.mark.parametrize("name", ["o.xlsx", "o.svg", "o.h5", "o"])
def test_r35_another_ending_is_refused(tmp_path, orbit, name):
    scene = Scene.named("figure-12")
    answers = [orbit, orbit.prove(1), scene.two_impact(1), scene.sweep({"gap": (9, 10, 2)}, transient=2, impacts=1)]
    for answer in answers[:3] if name == "o.svg" else answers:
        with pytest.raises(impact_pair.Error, match=f"path is {name}, but accepted is a name that ends in") as caught:
            answer.save(tmp_path / name)
        assert isinstance(caught.value, ValueError)
        assert (caught.value.key, caught.value.value) == ("path", name)
    assert not list(tmp_path.iterdir())


def test_r35_a_sweep_is_saved_as_parquet(tmp_path):
    from pyarrow import parquet

    found = Scene.named("figure-12").sweep({"gap": (9, 10, 2)}, transient=2, impacts=3)
    found.save(tmp_path / "points.parquet", states=tmp_path / "states.parquet")
    assert parquet.read_table(tmp_path / "states.parquet").num_rows == 6
    assert parquet.read_table(tmp_path / "points.parquet").column_names == list(found.to_dict("points"))
