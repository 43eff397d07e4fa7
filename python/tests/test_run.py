"""`run` and `solve` against the orbit JSON of the command line."""

import copy
import json
import pickle
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from conftest import ROOT, SCENES, assert_rounded_outward

import impact_pair
from impact_pair import Scene

NAMES = sorted(path.stem for path in SCENES.glob("*.toml"))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("arithmetic", ["auto", "interval", "float"])
def test_an_orbit_is_the_document_of_the_command_line(cli, name, arithmetic):
    requested = ("run", f"scenes/{name}.toml", "--impacts", 40, "--arithmetic", arithmetic)
    orbit = Scene.from_file(SCENES / f"{name}.toml").run(impacts=40, arithmetic=arithmetic)
    answer = cli.answer(*requested, "--format", "json")
    assert (orbit.json(), orbit.complete) == (answer.stdout, answer.returncode == 0)
    assert orbit.certified == (arithmetic != "float")


def test_scenes_and_defaults_are_those_of_the_repository(cli):
    for name in NAMES:
        path = SCENES / f"{name}.toml"
        assert Scene.named(name).text == path.read_text()
    orbit = Scene.named("figure-14").run()
    assert orbit.json() == cli.text("run", "scenes/figure-14.toml", "--format", "json")
    shadow = Scene.named("figure-14").run(impacts=500, arithmetic="shadow")
    assert shadow.json() == cli.text("run", "scenes/figure-14.toml", "--impacts", 500, "--arithmetic", "shadow", "--format", "json")
    assert shadow.claim == "shadowed"


def test_arrays_hold_what_is_certified_in_more_digits(cli):
    orbit = Scene.named("figure-14").run(impacts=60)
    narrow = cli.json("run", "scenes/figure-14.toml", "--impacts", 60, "--digits", 40)["events"]
    for doubles, key in ((orbit.t_bounds, "time"), (orbit.v_bounds, "velocity")):
        for (low, high), impact in zip(doubles, narrow, strict=True):
            lower, upper = (Fraction(Decimal(end)) for end in impact[key])
            assert Fraction(low) <= lower
            assert upper <= Fraction(high)
            assert high - low < 1e-8


def test_arrays_and_events_are_those_of_the_document(cli):
    orbit = Scene.from_file(SCENES / "chatter.toml").run()
    events = cli.json("run", "scenes/chatter.toml")["events"]
    impacts = [event for event in events if event["event"] == "impact"]
    # Decimals are rounded outward as well: what is read of them holds the doubles.
    again = impact_pair.read_orbit(orbit.json())
    assert_rounded_outward(again.t_bounds, [impact["time"] for impact in impacts])
    assert_rounded_outward(again.v_bounds, [impact["velocity"] for impact in impacts])
    assert (again.t_bounds[:, 0] <= orbit.t_bounds[:, 0]).all()
    assert (again.t_bounds[:, 1] >= orbit.t_bounds[:, 1]).all()
    assert list(orbit.walls) == [impact["wall"] for impact in impacts] == list(orbit.wall)
    assert list(orbit.mappings) == [impact["mapping"] for impact in impacts]
    assert [type(event).__name__.lower() for event in orbit.events] == [event["event"] for event in events]
    assert [event.time.decimals for event in orbit.events] == [tuple(event["time"]) for event in events]
    assert all(low <= t <= high for t, (low, high) in zip(orbit.t, orbit.t_bounds, strict=True))
    far = np.maximum(orbit.t_bounds[:, 1] - orbit.t, orbit.t - orbit.t_bounds[:, 0])
    assert (orbit.t_radii >= far).all()
    assert orbit.outcome.kind == "periodic"
    assert orbit.outcome.fields["period"] == {"cycles": 9, "impacts": 23}


def test_solve_is_the_scene_in_the_letters_of_the_paper(cli):
    sol = impact_pair.solve(A=8, W="pi", d="9.42497", e="0.5", v0="-12.56636", impacts=200)
    from_cli = cli.json("run", "scenes/figure-14.toml", "--impacts", 200)
    assert json.loads(sol.json()) == from_cli
    # Whatever says the same number exactly.
    same = impact_pair.solve(
        A=8.0, W="pi", d=Decimal("9.42497"), e=0.5, v0=Fraction(-1256636, 100000), t0=0, tau=0, wall="left", impacts=200
    )
    assert np.array_equal(same.t_bounds, sol.t_bounds)
    assert np.array_equal(same.v_bounds, sol.v_bounds)


def test_a_float_is_its_exact_binary_value():
    tenth = Scene(amplitude=0.1, frequency=1, gap=1, restitution=0.5, velocity=-1)
    assert tenth.document["excitation"]["amplitude"] == [str(Decimal(0.1))]
    assert Fraction(tenth.document["excitation"]["amplitude"][0]) == Fraction(0.1) != Fraction(1, 10)
    exact = Scene(amplitude="0.1", frequency=np.int64(1), gap=1, restitution=np.float64(0.5), velocity=-1)
    assert exact.document["excitation"]["amplitude"] == ["0.1"]


def test_intervals_and_several_harmonics(cli):
    wide = Scene.from_file(SCENES / "figure-14.toml").varied({"gap": ("9.42", "9.43")})
    found = wide.run(impacts=3)
    lines = (SCENES / "figure-14.toml").read_text().replace("gap = 9.42497", 'gap = "[9.42, 9.43]"')
    assert "[9.42" in lines
    from_cli = json.loads(cli.text("run", "-", "--impacts", 3, "--format", "json", stdin=lines))
    assert json.loads(found.json()) == from_cli
    square = Scene.from_dict(
        {
            "excitation": {"amplitude": [1, "1/3", Fraction(1, 5)], "frequency": ["pi", "3*pi", "5*pi"], "phase": 0},
            "pair": {"gap": 2, "restitution": "0.5"},
            "start": {"time": 0, "wall": "left", "velocity": -1},
        }
    )
    assert square.document["excitation"]["amplitude"] == ["1", "1/3", "1/5"]
    assert len(square.run(impacts=5)) == 5


def test_an_orbit_can_be_pickled_and_read():
    orbit = Scene.named("figure-12").run(impacts=20)
    again = pickle.loads(pickle.dumps(orbit))
    assert again.json() == orbit.json()
    # Decimals are rounded outward, and doubles from them again.
    assert (again.t_bounds[:, 0] <= orbit.t_bounds[:, 0]).all()
    assert (again.t_bounds[:, 1] >= orbit.t_bounds[:, 1]).all()
    # The motion between impacts is that of the first, also after copies.
    times = np.linspace(0, float(orbit.t[-2]), 50)
    for one in (again, copy.copy(orbit), copy.deepcopy(again), pickle.loads(pickle.dumps(again))):
        assert np.array_equal(one(times).y_bounds, orbit(times).y_bounds)
    with pytest.raises(impact_pair.Error, match="was read"):
        impact_pair.read_orbit(orbit.json())(0.5)
    scene = Scene.named("figure-12")
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert eval(repr(scene), {"Scene": Scene}).document == scene.document


def test_errors_say_what_the_command_line_says(cli, tmp_path):
    text = (SCENES / "figure-14.toml").read_text().replace("restitution = 0.5", "restitution = 2")
    (tmp_path / "scene.toml").write_text(text)
    with pytest.raises(impact_pair.RangeError) as caught:
        Scene.from_file(tmp_path / "scene.toml")
    assert str(caught.value) in cli.error("run", tmp_path / "scene.toml")
    assert str(caught.value).startswith("line ")


def test_other_forms_hold_the_same_numbers(tmp_path):
    orbit = Scene.named("figure-14").run(impacts=30)
    frame = orbit.to_pandas()
    assert np.array_equal(frame[["t_lower", "t_upper"]].to_numpy(), orbit.t_bounds)
    assert list(frame["wall"]) == list(orbit.walls)
    arrow = orbit.to_arrow()
    assert np.array_equal(arrow["v_upper"].to_numpy(), orbit.v_bounds[:, 1])
    orbit.savemat(tmp_path / "orbit.mat")
    from scipy.io import loadmat

    from_cli = loadmat(tmp_path / "orbit.mat")
    assert np.array_equal(from_cli["t_lower"].ravel(), orbit.t_bounds[:, 0])
    assert np.array_equal(from_cli["wall"].ravel(), orbit.sides)
    orbit.save(tmp_path / "orbit.json")
    assert (tmp_path / "orbit.json").read_text() == orbit.json()
    assert impact_pair.read_orbit((tmp_path / "orbit.json").read_text()).json() == orbit.json()


def test_balls_of_other_packages_hold_the_bounds():
    from flint import arb, ctx, fmpq
    from mpmath import iv

    ctx.prec = iv.prec = 100
    for impact in Scene.named("figure-14").run(impacts=10):
        lower, upper = impact.time.fractions
        ball, interval = impact.time.arb(), impact.time.iv()
        assert all(ball.contains(arb(fmpq(end.numerator, end.denominator)).mid()) for end in (lower, upper))
        assert interval.a <= iv.mpf(lower.numerator) / lower.denominator
        assert interval.b >= iv.mpf(upper.numerator) / upper.denominator


def test_repr_shows_the_digits_that_are_certain(cli):
    shown = repr(Scene.named("figure-14").run(impacts=5))
    from_cli = cli.text("run", "scenes/figure-14.toml", "--impacts", 5)
    assert shown.splitlines()[1:6] == from_cli.splitlines()[6:11]
    html = Scene.named("chatter").run()._repr_html_()
    assert html.startswith("<table>")
    assert "certified: 40 impacts" in html


def test_readme_is_true(monkeypatch):
    """The Python examples of both READMEs and of pages of the manual run."""
    import doctest

    monkeypatch.chdir(ROOT)

    for page in ("README.md", "python/README.md", "docs/howto/boxes.md", "docs/howto/exponents.md", "docs/guide/own-system.md"):
        found = doctest.testfile(str(ROOT / page), module_relative=False, optionflags=doctest.ELLIPSIS)
        assert found.attempted > 4
        assert not found.failed
    for module in (impact_pair, impact_pair.bounds, impact_pair.scene):
        assert not doctest.testmod(module, optionflags=doctest.ELLIPSIS).failed


def test_the_last_line_names_keywords():
    orbit = Scene.named("figure-14").run(impacts=500, max_bits=64)
    assert not orbit.complete
    assert repr(orbit).endswith("; try fewer digits or more max_bits")
