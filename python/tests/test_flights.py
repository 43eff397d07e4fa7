"""Batches of flights against the command line, one by one."""

import json
from decimal import Decimal

import numpy as np
import pytest

import impact_pair
from impact_pair import Scene


@pytest.mark.parametrize("name", ["figure-14", "square-wave"])
def test_each_flight_is_the_first_impact_of_its_own_scene(cli, name):
    scene = Scene.named(name)
    rng = np.random.default_rng(5)
    sides = rng.choice([-1, 1], 25)
    times, speeds = rng.uniform(-3, 50, 25), rng.uniform(0.5, 30, 25)
    found = scene.flights(times, sides * speeds, sides)
    for i, side in enumerate(sides):
        start = {"start.time": float(times[i]), "start.velocity": float(side * speeds[i])}
        tables = {"excitation": scene.document["excitation"]}
        tables["pair"] = {key: scene.document[key] for key in ("gap", "restitution")}
        wall = "left" if side < 0 else "right"
        tables["start"] = {"time": start["start.time"], "velocity": start["start.velocity"], "wall": wall}
        from_cli = json.loads(cli.text("run", "-", "--impacts", 1, "--digits", 20, "--format", "json", stdin=Scene.from_dict(tables).text))[
            "events"
        ][0]
        assert ("left" if found.sides[i] < 0 else "right") == from_cli["wall"]
        assert f"P{found.mappings[i]}" == from_cli["mapping"]
        for bounds, key in ((found.t_bounds[i], "time"), (found.v_bounds[i], "velocity")):
            low, high = map(Decimal, from_cli[key])
            assert Decimal(float(bounds[0])) <= low
            assert high <= Decimal(float(bounds[1]))
            assert bounds[1] - bounds[0] < 1e-9


def test_what_doubles_do_not_decide_is_undecided():
    # At rest where the wall presses: no impact follows.
    found = Scene.named("figure-14").flights([1.25, 1.25], [0.0, -12.0], -1)
    assert found.sides.tolist()[0] == 0
    assert np.isnan(found.t_bounds[0]).all()
    assert found.sides[1] != 0


def test_invalid_arguments_are_refused():
    scene = Scene.named("figure-14")
    for requested in (([0.0], [1.0], [-1]), ([np.nan], [-1.0], [-1]), ([0.0], [-1.0], [0])):
        with pytest.raises(impact_pair.RangeError):
            scene.flights(*requested)
