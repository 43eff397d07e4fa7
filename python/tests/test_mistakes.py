"""Arguments passed by mistake, or of another type: numbers are taken, and the rest is refused by the package's own errors."""

import json
import pickle
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


def test_r35_long_doubles_and_arrays_of_harmonics_are_exact():
    third = np.longdouble(1) / 3
    found = impact_pair.solve(**PARAMETERS | {"A": third, "arithmetic": 64.0}, impacts=2)
    assert Fraction(found.scene["excitation"]["amplitude"][0]) == Fraction(*third.as_integer_ratio())
    two = PARAMETERS | {"A": np.array([1.0, 0.25]), "W": np.array([1, 3]), "tau": np.zeros(2)}
    assert impact_pair.solve(**two, impacts=2).scene["excitation"]["amplitude"] == ["1", "0.25"]


SCENE = Scene.named("figure-12")
LISTED = {"time": [1.0], "wall": ["right"]}
# Each with the part of the message that names what is wrong, or what is accepted.
NOT_ASKED = {
    "no dict": (lambda: SCENE.sweep([1, 2]), ""),
    "three keys": (lambda: SCENE.sweep({"gap": (1, 2, 2), "restitution": (0, 1, 2), "amplitude": (1, 2, 2)}), ""),
    "downwards": (lambda: SCENE.sweep({"gap": np.linspace(8, 7, 5)}), ""),
    "a list that is no grid": (lambda: SCENE.sweep({"gap": [7.0, 7.4, 8.0]}), "evenly spaced"),
    "an array that is no grid": (lambda: SCENE.sweep({"gap": np.array([9.0, 9.1, 10.0])}), "evenly spaced"),
    "an array of one": (lambda: SCENE.sweep({"gap": np.array([9.0])}), "evenly spaced"),
    "an array of arrays": (lambda: SCENE.sweep({"gap": np.ones((2, 2))}), "evenly spaced"),
    "a masked value": (lambda: SCENE.sweep({"gap": np.ma.array([9.0, 9.5, 10.0], mask=[False, True, False])}), "masked"),
    "two ends": (lambda: SCENE.sweep({"gap": (9, 10)}), "gap"),
    "one end": (lambda: SCENE.sweep({"gap": 9}), "gap"),
    "half a point of a sweep": (lambda: SCENE.sweep({"gap": (9, 10, 2.5)}), "gap"),
    "fewer than no points": (lambda: SCENE.sweep({"gap": (9, 10, -2)}), "gap"),
    "no such key": (lambda: SCENE.sweep({"r": (0, 1, 3)}), "did you mean `restitution`"),
    "two names of one key": (
        lambda: Scene(A=1, amplitude=2, W="pi", d=9, e="0.5", velocity=-1),
        "excitation.A and excitation.amplitude are one key: give one of them",
    ),
    "no number of points": (lambda: SCENE.manifold({"frequency": (1, 2)}), ""),
    "half a point": (lambda: SCENE.manifold({"frequency": (1, 2, 2.5)}), ""),
    "a tuple too long": (lambda: SCENE.bifurcations("RL", 1, {"gap": (1, 2, 3)}), ""),
    "no key": (lambda: SCENE.bifurcations("RL", 1, {}), ""),
    "no range": (lambda: SCENE.bifurcations("RL", 1, {"gap": 3}), ""),
    "small letters": (lambda: SCENE.periodic("rl", 1), ""),
    "no word": (lambda: SCENE.periodic(12, 1), ""),
    "finer": (lambda: SCENE.trap(effort=0), "a number above 0"),
    "depth": (lambda: SCENE.chaos(depth=-1), ""),
    # The depth that is not given was refused before.
    "over": (lambda: SCENE.chaos(over={"gap": (2, 1)}), r"gap=2\.\.1"),
    "several harmonics": (lambda: Scene.named("two-tones").chaos(), "harmonics"),
    "cells": (lambda: SCENE.chaos_cells({"gap": (1, 2, -3)}), ""),
    "halvings": (lambda: SCENE.chaos_cells({"gap": (1, 2, 3)}, effort="much"), "a number above 0"),
    "digits": (lambda: SCENE.two_impact(1, digits=-3), ""),
    "cycles": (lambda: SCENE.two_impact((1, 2, 3)), r"\(1, 2, 3\)"),
    "numbers of impacts": (lambda: SCENE.cycles((1, 2, 3)), r"\(1, 2, 3\)"),
    "panels": (lambda: SCENE.plot("z"), ""),
    "shapes": (lambda: SCENE.flights([0.0, 1.0], [1.0, 2.0, 3.0], -1), ""),
    "letters": (lambda: SCENE.flights(["a"], [1.0], -1), ""),
    "a wrong side": (lambda: SCENE.flights([0.0], [1.0], [-1]), ""),
    "boxes": (lambda: SCENE.box_map([["a", 2, 3, 4]]), ""),
    "a truth among boxes": (lambda: SCENE.box_map([[True, 1, 1, 2]]), ""),
    "a truth among values": (lambda: SCENE.sweep({"start.time": [0, True, 2]}), ""),
    "no flights": (lambda: SCENE.tangency({"gap": (9, 10)}, word=3), ""),
    "a name": (lambda: Scene.named(14), ""),
    "an unknown name": (lambda: Scene.named("figure14"), "did you mean 'figure-14'"),
    "a table": (lambda: Scene.from_dict({"excitation": 3}), ""),
    "a value": (lambda: SCENE.varied({"r": 0.5}), "did you mean `restitution`"),
    "one value twice": (lambda: SCENE.varied({"restitution": 0.5, "e": 0.5}), "not be given beside restitution"),
    "one keyword twice": (lambda: Scene(A=1, amplitude=1, W=1, d=2, e=0, velocity=-1), "excitation.A and excitation.amplitude"),
    "A/d beside d": (lambda: SCENE.sweep({"A/d": (1, 2, 2), "d": (1, 2, 2)}), "the gap stays"),
    "effort": (lambda: impact_pair.check(SCENE.run(impacts=2), effort=-1), 'the effort is "-1"'),
    "times": (lambda: SCENE.run(impacts=2)("a"), ""),
    "an executor": (lambda: SCENE.sweep({"gap": (7, 8, 2)}, executor=5), ""),
    "a list without a wall": (lambda: SCENE.audit({"time": [1.0, 2.0]}), "say which one it is in columns="),
    "columns of two lengths": (lambda: SCENE.audit({"time": [1.0, 2.0], "wall": ["left"]}), "2, 1 values"),
    "a masked time": (lambda: SCENE.audit(LISTED | {"time": np.ma.array([1.0], mask=[True])}), "masked"),
    **{f"tables {x!r}": (lambda x=x: Scene.from_dict(x), "dict with excitation, pair, start") for x in (None, 3, "excitation", [1])},
    **{f"impacts {x!r}": (lambda x=x: SCENE.audit(x), "must be a path, arrays by name or a DataFrame") for x in (None, 3, [0.5, 1.0])},
    **{f"columns {x!r}": (lambda x=x: SCENE.audit(LISTED, columns=x), "must be three") for x in (None, (1, 2), "twv")},
    **{
        f"{verb} over {key}": (lambda verb=verb, key=key: getattr(SCENE, verb)({key: (1, 2)}), "KEY one of gap, amplitude, .*, A/d$")
        for verb in ("windows", "tangency")
        for key in ("frequency", "phase", "start.velocity")
    },
    # Walls that would become other numbers, and times that are no doubles.
    **{
        f"wall {x!r}": (lambda x=x: SCENE.flights([0.0], [12.0], x), "wall")
        for x in (1.9, [1.9], np.array([257]), [257], np.array([255], dtype=np.uint8), [True], [1 + 0j], ["1"])
    },
    **{
        f"time {x!r:.40}": (lambda x=x: SCENE.flights(x, [12.0], 1), "t ")
        for x in ([2**53 + 1], np.array([2**53 + 1]), ["0.1"], [Decimal("0.1")], [Fraction(1, 3)], np.array([1j]), [10**400])
    },
}


@pytest.mark.parametrize("name", NOT_ASKED)
def test_r35_invalid_arguments_are_refused_with_key_and_value(name):
    work, said = NOT_ASKED[name]
    with pytest.raises(impact_pair.Error, match=said or None) as caught:
        work()
    assert isinstance(caught.value, ValueError)
    assert (caught.value.key and caught.value.value) or name in ("several harmonics", "a list without a wall")


@pytest.mark.parametrize(
    ("changed", "kind", "key", "value"),
    [
        ({"e": "1.5"}, impact_pair.RangeError, "pair.restitution", "1.5"),
        ({"e": -0.63}, impact_pair.RangeError, "pair.restitution", "-0.63"),
        ({"e": np.float64(1.1)}, impact_pair.RangeError, "pair.restitution", "1.1"),
        ({"e": [0.5, 0.6]}, impact_pair.Error, "pair.restitution", "[0.5, 0.6]"),
        ({"e": (0.7, 0.6)}, impact_pair.Error, "pair.restitution", "(0.7, 0.6)"),
        ({"e": np.ma.masked}, impact_pair.RangeError, "pair.restitution", "masked"),
        ({"d": "-1"}, impact_pair.RangeError, "pair.gap", "-1"),
        ({"d": "x"}, impact_pair.SceneError, "pair.gap", '"x"'),
        ({"d": (Decimal("NaN"), 1)}, impact_pair.RangeError, "pair.gap", "NaN"),
        ({"v0": 1}, impact_pair.RangeError, "start.velocity", "1"),
        ({"A": float("nan")}, impact_pair.RangeError, "excitation.amplitude", "nan"),
        ({"A": Decimal("sNaN")}, impact_pair.RangeError, "excitation.amplitude", "sNaN"),
        ({"A": b"1"}, impact_pair.Error, "excitation.amplitude", "b'1'"),
        ({"digits": 1000}, impact_pair.RangeError, "digits", "1000"),
        ({"digits": 10**10}, impact_pair.RangeError, "digits", "10000000000"),
        ({"impacts": 2**70}, impact_pair.RangeError, "impacts", "1180591620717411303424"),
        ({"arithmetic": "fast"}, impact_pair.RangeError, "arithmetic", "fast"),
        ({"wall": "up"}, impact_pair.SceneError, "start.wall", '"up"'),
        ({"wall": -1}, impact_pair.Error, "start.wall", "-1"),
        ({"wall": "left", "y0": 0}, impact_pair.Error, "start.position", '"0"'),
    ],
)
def test_errors_have_one_root_and_name_key_and_value(changed, kind, key, value):
    with pytest.raises(kind) as caught:
        impact_pair.solve(**PARAMETERS | {"impacts": 2} | changed)
    assert isinstance(caught.value, impact_pair.Error)
    assert isinstance(caught.value, ValueError)
    assert (caught.value.key, caught.value.value) == (key, value)
    assert value.strip('"') in str(caught.value)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), str(again), again.key) == (type(caught.value), str(caught.value), key)


def test_r35_a_document_may_be_a_dict():
    orbit = SCENE.run(impacts=3)
    assert impact_pair.check(orbit.document)
    assert impact_pair.check(orbit.document).claims == orbit.check().claims


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
    assert scene.sweep({"gap": [9.0, 9.5, 10.0]}, **how).head["over"] == [{"key": "gap", "from": "9", "to": "10", "count": 3}]
    found = Scene.named("figure-10").manifold({"frequency": np.linspace(5, 60, 12)})
    assert found.document == Scene.named("figure-10").manifold({"frequency": (5, 60, 12)}).document
    # The ends of a list are exact.
    found = scene.sweep({"gap": [Fraction(28, 3), Fraction(59, 6), Fraction(31, 3)]}, **how)
    assert [record["values"] for record in found] == [["28/3"], ["59/6"], ["31/3"]]


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


def test_r51_a_varied_scene_keeps_the_defaults_of_its_run():
    scene = Scene(amplitude=1, frequency="pi", gap="9.42497", restitution="0.5", velocity=-4, impacts=5, until="7/2", digits=20)
    varied = scene.varied({"gap": "9.5"})
    assert varied.run().json() == varied.run(impacts=5, until="7/2", digits=20).json()
    assert varied.document["gap"] == "9.5"
    assert scene.varied({}).run().json() == scene.run().json()


def test_r51_an_array_whose_mask_hides_nothing_is_a_list():
    listed = {"wall": ["right", "left"]}
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


@pytest.mark.parametrize("number", [np.float32(1.5), np.int64(2), np.longdouble(1.25), Decimal("1.5"), np.float16(1)])
def test_r51_a_number_of_any_type_is_in_bounds_or_not(number):
    assert number in impact_pair.Bounds("1", "2")
    assert number not in impact_pair.Bounds("3", "4")
    assert all(none not in impact_pair.Bounds("1", "2") for none in (float("nan"), Decimal("NaN"), np.float64("nan")))


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
