"""Datasets of xarray, and the files of NetCDF and Zarr: the bounds are those of the answers, and they come back from a file."""

import sys
from fractions import Fraction

import numpy as np
import pytest

import impact_pair
from impact_pair import Scene

xr = pytest.importorskip("xarray")


@pytest.fixture(scope="module")
def orbit():
    return Scene.named("figure-14").run(impacts=20)


@pytest.fixture(scope="module")
def grid():
    # At A = 1 an orbit attracts; the others have other fates.
    return Scene.named("figure-14").sweep({"amplitude": ("1", "10", 3), "gap": (9, 10, 2)}, transient=5, impacts=4)


def opened(path):
    return xr.open_zarr(path) if path.suffix == ".zarr" else xr.open_dataset(path, engine="netcdf4")


@pytest.mark.parametrize("ending", [None, ".nc", ".zarr"])
def test_r35_an_orbit_has_bounds_by_cf(tmp_path, orbit, ending):
    found = orbit.to_xarray()
    if ending:
        for _ in range(2):
            orbit.save(tmp_path / f"orbit{ending}")
        found = opened(tmp_path / f"orbit{ending}")
        assert [path.name for path in tmp_path.iterdir()] == [f"orbit{ending}"]
    assert found.time.attrs["bounds"] == "time_bnds"
    assert np.array_equal(found.time_bnds, orbit.t_bounds)
    assert np.array_equal(np.stack([found.velocity_lower, found.velocity_upper], -1), orbit.v_bounds)
    for i, impact in enumerate(Scene.named("figure-14").run(impacts=20, digits=40)):
        low, high = (Fraction(float(end)) for end in found.time_bnds[i])
        assert all(low <= end <= high for end in impact.time.fractions)
    assert (found.time_bnds[:, 0] <= found.time).all()
    meanings = dict(zip(found.wall.attrs["flag_values"], found.wall.attrs["flag_meanings"].split(), strict=True))
    assert [meanings[int(side)] for side in found.wall] == list(orbit.walls)
    assert found.mapping.attrs["flag_meanings"].split()[int(found.mapping[0])] == orbit.mappings[0]
    assert found.attrs["Conventions"].startswith("CF-")


@pytest.mark.parametrize("ending", [None, ".nc"])
@pytest.mark.parametrize(("name", "kinds"), [("chatter", {"impact", "rest", "release"}), ("graze", {"impact", "graze"})])
def test_r35_grazes_rests_and_releases_are_among_the_events(tmp_path, ending, name, kinds):
    orbit = Scene.named(name).run()
    found = orbit.to_xarray()
    if ending:
        orbit.save(tmp_path / "orbit.nc")
        found = opened(tmp_path / "orbit.nc")
    meanings = found.event_kind.attrs["flag_meanings"].split()
    named = [meanings[int(kind)] for kind in found.event_kind]
    assert named == [type(event).__name__.lower() for event in orbit.events]
    assert kinds <= set(named)
    for i, event in enumerate(orbit.events):
        low, high = (Fraction(float(end)) for end in found.event_time_bnds[i])
        assert low <= event.time.fractions[1]
        assert high >= event.time.fractions[0]
        assert int(found.event_wall[i]) == (-1 if event.wall == "left" else 1)
    assert found.event_time.attrs["bounds"] == "event_time_bnds"
    impacts = found.event_time_bnds[[kind == "impact" for kind in named]]
    assert np.array_equal(impacts, found.time_bnds)


@pytest.mark.parametrize("ending", [None, ".nc", ".zarr"])
def test_r35_a_sweep_has_its_grid(tmp_path, grid, ending):
    found = grid.to_xarray()
    if ending:
        grid.save(tmp_path / f"grid{ending}")
        found = opened(tmp_path / f"grid{ending}")
    assert dict(found.sizes) == {"amplitude": 3, "gap": 2, "state": 4, "bnds": 2}
    assert list(found.amplitude.values) == [1, 5.5, 10]
    assert np.array_equal(found.gap_bnds, [[9, 9], [10, 10]])
    kinds = found.outcome.attrs["flag_meanings"].split()
    for point in grid:
        at = {key: float(Fraction(value)) for key, value in zip(("amplitude", "gap"), point["values"], strict=True)}
        cell = found.sel(**at)
        assert kinds[int(cell.outcome)] == point["outcome"]
        assert Fraction(float(cell.exponent_lower)) <= Fraction(point["exponent"]["per_impact"][0])
        assert Fraction(float(cell.exponent_upper)) >= Fraction(point["exponent"]["per_impact"][1])
        for i, state in enumerate(point["states"]):
            assert Fraction(float(cell.phase_lower[i])) <= Fraction(state["phase"][0])
            assert Fraction(float(cell.velocity_upper[i])) >= Fraction(state["velocity"][1])
            assert int(cell.wall[i]) == (-1 if state["wall"] == "left" else 1)


def test_r35_points_with_fewer_states_have_gaps():
    scene = Scene.named("chatter").sweep({"gap": (9, 10, 2)}, transient=2, impacts=3)
    found = scene.to_xarray()
    assert found.phase.shape == (2, 3)
    assert int(np.isfinite(found.phase).sum()) == len(scene.states["phase"])
    none = Scene.named("figure-12").sweep({"gap": (9, 10, 2)}, transient=2, impacts=3, summary=True).to_xarray()
    assert "phase" not in none


@pytest.mark.parametrize(("package", "ending"), [("xarray", "nc"), ("netCDF4", "nc"), ("zarr", "zarr")])
def test_r35_a_missing_package_is_named(monkeypatch, tmp_path, orbit, package, ending):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(impact_pair.MissingPackageError, match=f"pip install {package}") as caught:
        orbit.save(tmp_path / f"orbit.{ending}")
    assert isinstance(caught.value, ImportError)
    assert caught.value.key == package
    assert not list(tmp_path.iterdir())


def test_r45_an_infinite_exponent_is_a_value():
    # The exponent of a ball at rest is -inf: it was NaN, as where there is none. No number was compared with an infinite bound.
    grid = Scene(amplitude=1, frequency="pi", gap=3, restitution="0.5", velocity=0, time="1.5").sweep(
        {"restitution": ("0.4", "0.5", 2)}, transient=0, impacts=20
    )
    found = grid.to_xarray()
    assert np.array_equal(found.exponent, [-np.inf, -np.inf])
    lower, middle, upper = found.exponent_limit_lower, found.exponent_limit, found.exponent_limit_upper
    assert (lower == -np.inf).all()
    assert np.isnan(middle).all()
    assert (upper < 0).all()
    both, one = impact_pair.Bounds("-inf", "-inf"), impact_pair.Bounds("-inf", "-0.5")
    assert (both.mid, both.rad, one.rad) == (-np.inf, 0, np.inf)
    assert np.isnan(one.mid)
    assert all(number in one for number in (-1e300, -np.inf, Fraction(-1, 2)))
    assert 0 not in one
    assert -1 not in both
