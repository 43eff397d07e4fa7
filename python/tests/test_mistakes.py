"""What people pass by mistake, or in another type: numbers are taken, and the rest is refused by the package's own errors."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import impact_pair
from impact_pair import Scene

PARAMETERS = {"A": 8, "W": "pi", "d": "9.42497", "e": "0.5", "v0": "-12.56636"}


@pytest.mark.parametrize("impacts", [5.0, np.int8(5), np.uint64(5), np.float32(5), np.array(5), Decimal(5), Fraction(5)])
def test_r35_whole_numbers_of_any_type_are_taken(impacts):
    assert len(impact_pair.solve(**PARAMETERS, impacts=impacts)) == 5


@pytest.mark.parametrize("impacts", [-5, 5.5, "5", True, float("nan"), float("inf"), None.__class__, np.array([5])])
def test_r35_what_is_no_number_of_impacts_is_refused(impacts):
    with pytest.raises(impact_pair.RangeError, match="impacts is") as caught:
        impact_pair.solve(**PARAMETERS, impacts=impacts)
    assert caught.value.key == "impacts"


@pytest.mark.parametrize("restitution", [np.float64(0.5), np.float32(0.5), np.float16(0.5), np.array(0.5), np.array(Fraction(1, 2))])
def test_r35_numpy_scalars_are_exact_doubles(restitution):
    found = impact_pair.solve(**PARAMETERS | {"e": restitution, "A": np.int32(8)}, impacts=3)
    assert np.array_equal(found.t_bounds, impact_pair.solve(**PARAMETERS, impacts=3).t_bounds)


def test_r35_an_unknown_scene_leads_to_a_known_one():
    with pytest.raises(impact_pair.RangeError, match="did you mean 'figure-14'") as caught:
        Scene.named("figure14")
    assert caught.value.key == "name"
    assert Scene.named("figure-14-sink").run(impacts=45).outcome.kind == "attracted"


@pytest.mark.parametrize("over", [{"gap": (9, 10)}, {"gap": 9}, {"gap": (9, 10, 2.5)}, {"gap": (9, 10, -2)}])
def test_r35_ranges_that_are_none_are_refused(over):
    with pytest.raises(impact_pair.RangeError, match="gap"):
        Scene.named("figure-12").sweep(over, transient=1, impacts=1)


def test_r35_attracted_points_have_the_limit_of_the_exponent():
    over = {"gap": ("9.4248032652", "9.42480326525", 2)}
    found = Scene.named("figure-14-sink").sweep(over, transient=30, impacts=5)
    limits = found.to_dict("points")
    assert (limits["exponent_lower"] > 0.5).all()
    assert (limits["exponent_limit_upper"] < -0.2).all()
    assert (limits["exponent_limit_lower"] > np.log(0.5)).all()
    assert all(float(record["exponent_limit"][0]) < float(record["exponent_limit"][1]) for record in found)


def test_r35_sections_are_at_the_phases_of_the_documents():
    import matplotlib as mpl

    mpl.use("Agg")
    from impact_pair import plots

    orbit = Scene.named("figure-17").run(impacts=30)
    drawn = plots.section_left(orbit).lines[0].get_xdata()
    assert np.allclose(drawn, np.mod(200 * np.pi * orbit.t[orbit.sides < 0] + 1.047196, 2 * np.pi), atol=1e-9)


def test_r35_an_evenly_spaced_array_is_a_grid():
    scene, how = Scene.named("figure-12"), {"transient": 1, "impacts": 1}
    by_array = scene.sweep({"gap": np.linspace(9, 10, 5)}, **how)
    assert by_array.head == scene.sweep({"gap": (9, 10, 5)}, **how).head
    for values in (np.array([9.0, 9.1, 10.0]), np.array([9.0]), np.ones((2, 2))):
        with pytest.raises(impact_pair.RangeError, match="evenly spaced") as caught:
            scene.sweep({"gap": values}, **how)
        assert caught.value.key == "gap"


def test_r35_a_slice_of_an_orbit_is_a_list_of_impacts():
    orbit = Scene.named("chatter").run(impacts=8)
    assert orbit[2:5] == [orbit[2], orbit[3], orbit[4]]
    assert [impact.index for impact in orbit[::-3]] == [8, 5, 2]
    assert orbit[np.int64(1)] == orbit[1]
    assert orbit[20:] == []
