"""Arguments passed by mistake, or of another type: numbers are taken, and the rest is refused by the package's own errors."""

import json
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


@pytest.mark.parametrize(
    ("changed", "key", "said"),
    [
        ({"e": -0.63}, "pair.restitution", "pair.restitution is -0.63, but"),
        ({"e": np.float64(1.1)}, "pair.restitution", "pair.restitution is 1.1, but"),
        ({"e": "-0.63"}, "pair.restitution", "pair.restitution is -0.63, but"),
        ({"e": [0.5, 0.6]}, "pair.restitution", r"pair.restitution is \[0.5, 0.6\], but must be a single number"),
        ({"e": (0.7, 0.6)}, "pair.restitution", r"pair.restitution is \(0.7, 0.6\), but"),
        ({"A": b"1"}, "excitation.amplitude", "excitation.amplitude is b'1', but"),
        ({"wall": -1}, "start.wall", 'start.wall is -1, but must be "left" or "right"'),
        ({"wall": "left", "y0": 0}, "start.position", "but start.wall is given too: a start has one or the other"),
        ({"digits": 10**10}, "digits", "digits is 10000000000, but must be at most"),
        ({"impacts": 2**70}, "impacts", "impacts is 1180591620717411303424, but must be at most"),
        ({"arithmetic": "fast"}, "arithmetic", "fast"),
    ],
)
def test_r35_values_are_printed_as_they_were_typed(changed, key, said):
    with pytest.raises(impact_pair.Error, match=said) as caught:
        impact_pair.solve(**PARAMETERS | changed)
    assert caught.value.key == key
    assert isinstance(caught.value, ValueError)
    assert len(str(caught.value.value)) < 30


def test_r35_long_doubles_and_arrays_of_harmonics_are_exact():
    third = np.longdouble(1) / 3
    found = impact_pair.solve(**PARAMETERS | {"A": third, "arithmetic": 64.0}, impacts=2)
    assert Fraction(found.scene["excitation"]["amplitude"][0]) == Fraction(*third.as_integer_ratio())
    two = PARAMETERS | {"A": np.array([1.0, 0.25]), "W": np.array([1, 3]), "tau": np.zeros(2)}
    assert impact_pair.solve(**two, impacts=2).scene["excitation"]["amplitude"] == ["1", "0.25"]


SCENE = Scene.named("figure-12")
NOT_ASKED = {
    "no dict": lambda: SCENE.sweep([1, 2]),
    "three keys": lambda: SCENE.sweep({"gap": (1, 2, 2), "restitution": (0, 1, 2), "amplitude": (1, 2, 2)}),
    "downwards": lambda: SCENE.sweep({"gap": np.linspace(8, 7, 5)}),
    "a list that is no grid": lambda: SCENE.sweep({"gap": [7.0, 7.4, 8.0]}),
    "no such key": lambda: SCENE.sweep({"e": (0, 1, 3)}),
    "no number of points": lambda: SCENE.manifold({"frequency": (1, 2)}),
    "half a point": lambda: SCENE.manifold({"frequency": (1, 2, 2.5)}),
    "a tuple too long": lambda: SCENE.bifurcations("RL", 1, {"gap": (1, 2, 3)}),
    "no key": lambda: SCENE.bifurcations("RL", 1, {}),
    "no range": lambda: SCENE.bifurcations("RL", 1, {"gap": 3}),
    "small letters": lambda: SCENE.periodic("rl", 1),
    "no word": lambda: SCENE.periodic(12, 1),
    "finer": lambda: SCENE.trap(finer=-1),
    "depth": lambda: SCENE.chaos(depth=-1),
    "over": lambda: SCENE.chaos(over={"gap": (2, 1)}),
    "cells": lambda: SCENE.chaos_cells({"gap": (1, 2, -3)}),
    "halvings": lambda: SCENE.chaos_cells({"gap": (1, 2, 3)}, halvings=-1),
    "digits": lambda: SCENE.two_impact(1, digits=-3),
    "panels": lambda: SCENE.plot("z"),
    "shapes": lambda: SCENE.flights([0.0, 1.0], [1.0, 2.0, 3.0], -1),
    "letters": lambda: SCENE.flights(["a"], [1.0], -1),
    "a wrong side": lambda: SCENE.flights([0.0], [1.0], [-1]),
    "boxes": lambda: SCENE.box_map([["a", 2, 3, 4]]),
    "a truth among boxes": lambda: SCENE.box_map([[True, 1, 1, 2]]),
    "a truth among values": lambda: SCENE.sweep({"start.time": [0, True, 2]}),
    "no flights": lambda: SCENE.tangency({"gap": (9, 10)}, word=3),
    "a name": lambda: Scene.named(14),
    "a table": lambda: Scene.from_dict({"excitation": 3}),
    "a value": lambda: SCENE.varied({"e": 0.5}),
    "effort": lambda: impact_pair.check(SCENE.run(impacts=2), effort=-1),
    "times": lambda: SCENE.run(impacts=2)("a"),
    "an executor": lambda: SCENE.sweep({"gap": (7, 8, 2)}, executor=5),
}


@pytest.mark.parametrize("name", NOT_ASKED)
def test_r35_invalid_arguments_are_refused_with_key_and_value(name):
    with pytest.raises(impact_pair.Error) as caught:
        NOT_ASKED[name]()
    assert isinstance(caught.value, ValueError)
    assert caught.value.key
    assert caught.value.value


def test_r43_chaos_takes_its_own_default():
    # Its range was not looked at: the depth that is not given was refused before.
    with pytest.raises(impact_pair.RangeError, match=r"gap=2\.\.1"):
        SCENE.chaos(over={"gap": (2, 1)})
    with pytest.raises(impact_pair.Error, match="harmonics"):
        Scene.named("two-tones").chaos()


def test_r35_lists_and_arrays_are_grids_in_all_verbs():
    by_list = SCENE.sweep({"gap": [9.0, 9.5, 10.0]}, transient=1, impacts=1)
    assert by_list.head["over"] == [{"key": "gap", "from": "9", "to": "10", "count": 3}]
    found = Scene.named("figure-10").manifold({"frequency": np.linspace(5, 60, 12)})
    assert found.document == Scene.named("figure-10").manifold({"frequency": (5, 60, 12)}).document


def test_r35_a_document_may_be_a_dict():
    orbit = SCENE.run(impacts=3)
    assert impact_pair.check(orbit.document)
    assert impact_pair.check(orbit.document).claims == orbit.check().claims


def test_r35_lists_without_a_wall_lead_to_the_keyword():
    with pytest.raises(impact_pair.ListError, match="say which one it is in columns="):
        SCENE.audit({"time": [1.0, 2.0]})


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


@pytest.mark.parametrize(
    "missing", [np.ma.masked, np.ma.array(0.5, mask=True), np.ma.array(3, mask=True), np.ma.array([0.5], mask=[True])[0]]
)
def test_r41_a_value_that_is_masked_is_none(missing):
    with pytest.raises(impact_pair.RangeError, match="restitution"):
        impact_pair.solve(**PARAMETERS | {"e": missing}, impacts=1)
    with pytest.raises(impact_pair.RangeError, match="impacts is"):
        impact_pair.solve(**PARAMETERS, impacts=missing)
    values = np.ma.array([9.0, 9.5, 10.0], mask=[False, True, False])
    with pytest.raises(impact_pair.RangeError, match="masked"):
        Scene.named("figure-14").sweep({"gap": values}, impacts=1)


@pytest.mark.parametrize("wall", [1.9, [1.9], np.array([257]), [257], np.array([255], dtype=np.uint8), [True], [1 + 0j], ["1"]])
def test_r41_a_wall_that_would_become_another_number_is_refused(wall):
    with pytest.raises(impact_pair.RangeError, match="wall"):
        Scene.named("figure-14").flights([0.0], [12.0], wall)


@pytest.mark.parametrize("t", [[2**53 + 1], np.array([2**53 + 1]), ["0.1"], [Decimal("0.1")], [Fraction(1, 3)], np.array([1j]), [10**400]])
def test_r41_a_time_that_is_no_double_is_refused(t):
    with pytest.raises(impact_pair.RangeError, match="t "):
        Scene.named("figure-14").flights(t, [12.0], 1)


def test_r41_states_that_are_doubles_are_taken_in_any_type():
    scene = Scene.named("figure-14")
    from_cli = scene.flights([0.5], [12.0], 1)
    for t, v, wall in [
        (np.float32([0.5]), np.array([12]), np.int64([1])),
        ([Fraction(1, 2)], [Decimal(12)], 1.0),
        ([np.longdouble(0.5)], (12,), [1]),
    ]:
        found = scene.flights(t, v, wall)
        assert np.array_equal(found.t_bounds, from_cli.t_bounds)


def test_r41_the_ends_of_a_list_are_exact():
    ends = [Fraction(28, 3), Fraction(59, 6), Fraction(31, 3)]
    found = Scene.named("figure-14").sweep({"gap": ends}, transient=0, impacts=1)
    assert [record["values"] for record in found] == [["28/3"], ["59/6"], ["31/3"]]


def test_r51_a_varied_scene_keeps_the_defaults_of_its_run():
    scene = Scene(amplitude=1, frequency="pi", gap="9.42497", restitution="0.5", velocity=-4, impacts=5, until="7/2", digits=20)
    varied = scene.varied({"gap": "9.5"})
    assert varied.run().json() == varied.run(impacts=5, until="7/2", digits=20).json()
    assert varied.document["gap"] == "9.5"
    assert scene.varied({}).run().json() == scene.run().json()


def test_r51_a_masked_impact_is_not_compared_with_the_number_behind_its_mask():
    listed = {"time": np.ma.array([1.0, 2.0], mask=[False, True]), "wall": ["right", "left"]}
    with pytest.raises(impact_pair.ListError, match="masked"):
        Scene.named("figure-12-exact").audit(listed)
    assert Scene.named("figure-12-exact").audit(listed | {"time": np.ma.array([1.0, 2.0])}).agreed


def test_r51_long_doubles_of_a_list_are_not_rounded_to_doubles():
    time = np.array([np.longdouble(1) + np.finfo(np.longdouble).eps])
    found = Scene.named("figure-12-exact").audit({"time": time, "wall": ["right"]})
    listed = Fraction(Decimal(found.events[0]["listed"]["time"]))
    assert listed == Fraction(*time[0].as_integer_ratio())


def test_r51_columns_without_names_are_no_row():
    pandas = pytest.importorskip("pandas")
    listed = pandas.DataFrame([[1.0, "right"], [2.0, "left"]])
    assert Scene.named("figure-12-exact").audit(listed, columns=(1, 2, None)).counts["listed"] == 2
    with pytest.raises(impact_pair.ListError, match="in columns="):
        Scene.named("figure-12-exact").audit(listed)


def test_r51_lists_and_ranges_of_another_length_are_refused_by_the_package():
    with pytest.raises(impact_pair.ListError, match="2, 1 values"):
        SCENE.audit({"time": [1.0, 2.0], "wall": ["left"]})
    for requested in (SCENE.cycles, SCENE.two_impact):
        with pytest.raises(impact_pair.RangeError, match=r"\(1, 2, 3\)"):
            requested((1, 2, 3))


@pytest.mark.parametrize("number", [np.float32(1.5), np.int64(2), np.longdouble(1.25), Decimal("1.5"), np.float16(1)])
def test_r51_a_number_of_any_type_is_in_bounds_or_not(number):
    assert number in impact_pair.Bounds("1", "2")
    assert number not in impact_pair.Bounds("3", "4")


@pytest.mark.parametrize("number", [float("nan"), Decimal("NaN"), np.float64("nan")])
def test_r51_what_is_no_number_is_in_no_bounds(number):
    assert number not in impact_pair.Bounds("1", "2")


@pytest.mark.parametrize("tables", [None, 3, "excitation", [1]])
def test_i58_tables_that_are_no_dict_are_refused(tables):
    with pytest.raises(impact_pair.SceneError, match=r"the tables are .*, but must be a dict with excitation, pair, start") as caught:
        Scene.from_dict(tables)
    assert caught.value.value == repr(tables)


@pytest.mark.parametrize("events", [None, 3, [0.5, 1.0]])
def test_i58_a_list_of_impacts_that_is_none_is_refused(events):
    with pytest.raises(impact_pair.ListError, match="but must be a path, arrays by name or a DataFrame"):
        Scene.named("figure-12").audit(events)


@pytest.mark.parametrize("verb", ["windows", "tangency"])
@pytest.mark.parametrize("key", ["frequency", "phase", "start.velocity"])
def test_i58_a_search_names_the_keys_that_it_accepts(verb, key):
    with pytest.raises(impact_pair.RangeError, match=r"KEY one of gap, amplitude, restitution$") as caught:
        getattr(Scene.named("figure-12"), verb)({key: (1, 2)})
    assert (caught.value.key, caught.value.value) == ("over", f"{key}=1..2")


@pytest.mark.parametrize("columns", [None, (1, 2), "twv"])
def test_i58_columns_of_a_list_are_three(columns):
    with pytest.raises(impact_pair.RangeError, match=r"columns is .*, but must be three"):
        Scene.named("figure-12").audit({"time": [0.5], "wall": ["right"]}, columns=columns)


@pytest.mark.parametrize("key", ["a b", "amplitude = 1\nphase", "é", ""])
def test_i58_a_key_of_any_text_is_unknown(key):
    tables = {
        "excitation": {key: 0, "frequency": 1},
        "pair": {"gap": 2, "restitution": 0.5},
        "start": {"time": 0, "wall": "left", "velocity": -1},
    }
    with pytest.raises(impact_pair.SceneError, match=r"is not a key of \[excitation\]"):
        Scene.from_dict(tables)


def test_i58_files_that_are_no_text_raise_the_errors_of_the_package(tmp_path):
    path = tmp_path / "binary"
    path.write_bytes(b"title = \xff")
    scene = Scene.named("figure-12")
    for read, refusal in [
        (Scene.from_file, impact_pair.SceneError),
        (scene.audit, impact_pair.ListError),
        (impact_pair.check, impact_pair.CertificateError),
    ]:
        with pytest.raises(refusal, match="is no text in UTF-8, from byte 8 on") as caught:
            read(path)
        assert caught.value.value == str(path)


@pytest.mark.parametrize("bounds", [("1.7e308", "1.75e308"), ("-1.75e308", "-1.7e308"), ("-1.7e308", "1.7e308")])
def test_r52_bounds_near_the_greatest_doubles_have_a_middle_among_them(bounds):
    found = impact_pair.Bounds(*bounds)
    low, high = found.float64
    assert low <= found.mid <= high
    assert 0 < found.rad < float("inf")
    assert Fraction(found.mid) - Fraction(found.rad) <= Fraction(low) <= Fraction(high) <= Fraction(found.mid) + Fraction(found.rad)


def test_r52_json_lines_begin_with_the_requested_arithmetic(tmp_path):
    for arithmetic, requested in (("auto", {"kind": "auto", "max_bits": 1000000}), ("interval", {"kind": "interval", "bits": 53})):
        orbit = Scene.named("figure-14").run(impacts=5, digits=30 if arithmetic == "auto" else 9, arithmetic=arithmetic)
        orbit.save(tmp_path / "orbit.jsonl")
        lines = [json.loads(line) for line in (tmp_path / "orbit.jsonl").read_text().splitlines()]
        assert lines[0]["arithmetic"] == requested
        assert lines[-1]["arithmetic"] == orbit.arithmetic


def test_r52_a_message_names_no_option_of_the_command_line():
    listed = {"time": [1.0], "wall": ["right"], "puck_speed": [3.0]}
    found = Scene.named("figure-12-exact").audit(listed, until=1)
    assert "not read: puck_speed" in found.message
    assert "--" not in found.message


def test_r52_a_theorem_names_what_it_leaves_out():
    theorem = Scene.named("figure-12").run(impacts=20).prove()
    assert (theorem.stop, theorem.left_out) == (None, "the outcome `attracted`")
    assert Scene.named("figure-14").run(impacts=3).prove().left_out is None
