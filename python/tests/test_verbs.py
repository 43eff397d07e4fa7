"""Every other verb against the document of the command line."""

import json
import pickle
from decimal import Decimal

import numpy as np
import pytest
from conftest import ROOT, assert_rounded_outward

import impact_pair
from impact_pair import Scene
from impact_pair.answers import percent


def test_periodic(cli):
    found = Scene.named("figure-13").periodic("RL", 1, all=True)
    from_cli = cli.json("periodic", "scenes/figure-13.toml", "--word", "RL", "--cycles", 1, "--all")
    assert found.document == from_cli
    assert found.complete is found.exhaustive is True
    assert repr(found).startswith("P2 P1 in 1 cycle: 2 orbits, ")
    searched = Scene.named("figure-13").periodic("RL", 1)
    options = ("--word", "RL", "--cycles", 1)
    # The step that helps is the keyword here, and the option there.
    assert searched.status.endswith("others are not excluded (try all=True)")
    assert searched.status.replace("all=True", "--all") in cli.text("periodic", "scenes/figure-13.toml", *options)
    for orbit, said in zip(found, from_cli["orbits"], strict=True):
        assert_rounded_outward(orbit.phase_bounds, [impact["phase"] for impact in said["impacts"]])
        assert_rounded_outward(orbit.v_bounds, [impact["velocity"] for impact in said["impacts"]])
        assert orbit.stability == said["stability"]
        assert orbit.trace.decimals == tuple(said["trace"])
        assert len(orbit.eigenvalues) == 2
    assert len(found.to_pandas()) == sum(len(orbit.walls) for orbit in found)
    assert pickle.loads(pickle.dumps(found)).document == from_cli


def test_two_impact(cli):
    found = Scene.named("even-cycles").two_impact((1, 3), wall="right")
    from_cli = cli.json("two-impact", "scenes/even-cycles.toml", "--cycles", "1..3", "--wall", "right")
    assert [answer.document for answer in found] == from_cli
    one = Scene.named("figure-13").two_impact(solve_for="amplitude")
    assert one.document == cli.json("two-impact", "scenes/figure-13.toml", "--solve-for", "amplitude")


def test_manifold(cli, tmp_path):
    picture = tmp_path / "told.svg"
    requested = ("--manifold", "frequency=5..60:40", "--cycles", "1..3", "--plot", picture)
    from_cli = cli.json("two-impact", "scenes/figure-10.toml", *requested)
    found = Scene.named("figure-10").manifold({"frequency": (5, 60, 40)}, (1, 3), picture=True)
    assert found.document == from_cli
    assert found.svg == picture.read_text()
    assert [curve.cycles for curve in found.curves] == [1, 3]
    assert_rounded_outward(found.curves[0].amplitude_bounds, [point["amplitude"] for point in from_cli["curves"][0]["points"]])


def test_bifurcations(cli):
    found = Scene.named("cascade").bifurcations("RL", 1, {"amplitude": ("0.3", "0.4")}, doublings=1)
    requested = ("--word", "RL", "--cycles", 1, "--over", "amplitude=0.3..0.4", "--doublings", 1)
    from_cli = cli.json("bifurcations", "scenes/cascade.toml", *requested)
    assert found.document == from_cli
    assert [point.kind for point in found] == [point["kind"] for point in from_cli["points"]]
    assert_rounded_outward(found.parameter_bounds, [point["parameter"] for point in from_cli["points"]])


def test_trap_and_chaos(cli):
    found = Scene.named("figure-17").trap()
    assert found.document == cli.json("trap", "scenes/figure-17.toml")
    assert found.complete == (found.entered_at_impact is not None)
    counted = Scene.named("figure-14").trap(words=22)
    assert counted.document == cli.json("trap", "scenes/figure-14.toml", "--words", 22)
    assert counted.complete
    assert counted.words == int(counted.document["words"]["count"])
    assert counted.words_entropy >= float(counted.document["words"]["entropy_at_most"])
    assert found.words is None
    file = ROOT / "docs/bases-figure-14.json"
    found = Scene.named("figure-14").chaos(depth=3, bases=json.loads(file.read_text(encoding="utf-8"))["bases"], hyperbolic=True)
    from_cli = cli.json("chaos", "scenes/figure-14.toml", "--depth", 3, "--bases", file, "--hyperbolic")
    assert found.document == from_cli
    assert (found.entropy > 0) == found.complete
    assert "scene_orbit" in from_cli
    alone = Scene.named("figure-14").chaos(depth=3, bases=from_cli["bases"], no_orbit=True)
    json_alone = cli.json("chaos", "scenes/figure-14.toml", "--depth", 3, "--bases", file, "--no-orbit")
    assert alone.document == json_alone
    assert "scene_orbit" not in json_alone
    again = Scene.named("figure-14").chaos(depth=3, bases=from_cli["bases"], over={"gap": ("9.42496", "9.42498")})
    assert again.document["over"]["key"] == "pair.gap" or again.document["over"]


@pytest.mark.parametrize("words", [(), ("--words", 9)])
def test_graphs_of_a_region(cli, tmp_path, words):
    """NetworkX reads the graphs; its own counts of paths are those of the words."""
    networkx = pytest.importorskip("networkx")
    path = tmp_path / "graph.graphml"
    cli.text("trap", "scenes/figure-14.toml", *words, "--output", path)
    graph = networkx.read_graphml(path, force_multigraph=True)
    flights = {flight for *_, flight in graph.edges(data="flight")}
    assert graph.is_directed()
    assert flights == {"F", "N"}
    assert all(graph.out_degree(node) > 0 for node in graph)
    if not words:
        from_cli = cli.json("trap", "scenes/figure-14.toml")
        boxes = {(column, row) for column, first, last in from_cli["region"] for row in range(first, last + 1)}
        assert {(node["column"], node["row"]) for _, node in graph.nodes(data=True)} == boxes
        return
    paths = {"0": 1}
    for _ in range(9):
        longer: dict[str, int] = {}
        for node, count in paths.items():
            for _, following in graph.out_edges(node):
                longer[following] = longer.get(following, 0) + count
        paths = longer
    from_cli = cli.json("trap", "scenes/figure-14.toml", *words)["words"]
    assert sum(paths.values()) == int(from_cli["count"])
    matrix = networkx.to_numpy_array(graph)
    growth = np.log(np.abs(np.linalg.eigvals(matrix)).max())
    assert 0 <= float(from_cli["entropy_at_most"]) - growth < 1e-6


def test_describe(cli, tmp_path):
    for name, fate in {"figure-13": "attracted", "chatter": "periodic", "two-tones": "undecided"}.items():
        found = Scene.named(name).describe()
        assert found.document == cli.json("describe", f"scenes/{name}.toml")
        assert found.fate == fate
        assert found.complete == found.certified == (fate != "undecided")
        assert found.entropy is found.region is None
        assert pickle.loads(pickle.dumps(found)).lines == found.lines
    found = Scene.named("figure-13").describe(picture=True)
    cli.text("describe", "scenes/figure-13.toml", "--plot", tmp_path / "told.svg")
    assert found.svg == (tmp_path / "told.svg").read_text()
    assert (found.period, found.word, found.orbit.stability) == ((2, 1), "P1 P2", "stable")
    assert found.check().verdict == "confirmed"
    from_cli = found.document["exponent"]["limit"]
    assert found.exponent_limit.decimals == tuple(from_cli)
    assert found.exponent_limit.float64[0] <= np.log(0.5) <= found.exponent_limit.float64[1]
    assert found.message in repr(found)
    assert found._repr_html_().startswith("<table>")
    assert "<svg" in found._repr_html_()
    assert Scene.named("chatter").describe().exponent_finite_time.float64 == (-np.inf, -np.inf)
    elsewhere = tmp_path / "my scene.toml"
    # Chaos under tones with a common period: without one no convergence is asked for.
    elsewhere.write_text(Scene.named("two-tones").text.replace("sqrt(2)", "3/2").replace('[1, "1/10"]', "[8, 1]"))
    [question] = Scene.from_file(elsewhere).describe(impacts=50).undecided
    assert question["command"] == f"impact-pair describe '{elsewhere}' --impacts 500"
    with pytest.raises(impact_pair.RangeError, match="impacts is 0"):
        Scene.named("figure-13").describe(impacts=0)


@pytest.mark.deep
def test_a_motion_in_a_region_is_described():
    found = Scene.named("figure-14").describe(depth=3)
    assert (found.fate, found.since, found.region.boxes) == ("stays-in-region", 2, 431)
    # Two blocks of one forcing period each: ln 2.
    assert 0.6931 < found.entropy_per_cycle <= np.log(2)
    assert found.check().verdict == "confirmed"


def test_chaos_cells(cli):
    from_cli = cli.json("chaos", "scenes/figure-14.toml", "--depth", 4, "--over", "amplitude=3.4..4:3", "--effort", "1/32")
    found = Scene.named("figure-14").chaos_cells({"amplitude": ("3.4", "4", 3)}, depth=4, effort="1/32", picture=True)
    assert found.document == from_cli
    assert found.shares == from_cli["shares"]
    assert {stretch["verdict"] for stretch in found.stretches} == {"stable", "undecided"}
    assert not found.complete
    assert found.svg.startswith("<svg")
    with pytest.raises(impact_pair.RangeError):
        Scene.named("figure-14").chaos_cells({"amplitude": ("1", "1.1", 0)})


def test_global_analysis(cli):
    found = Scene.named("figure-12-exact").global_analysis(effort=0.0625, basins=True)
    requested = ("--effort", "0.0625", "--basins")
    assert found.document == cli.json("global", "scenes/figure-12-exact.toml", *requested)
    attractors = [i for i, component in enumerate(found.components) if component.kind in {"attracting", "rest-cycle"}]
    assert [basin.component for basin in found.basins] == attractors
    assert sum(basin.area for basin in found.basins) + float(found.document["basins"]["undecided"]) == pytest.approx(1)
    assert all(found.components[i].closed is False for i, _ in found.order if found.components[i].kind == "saddle")
    attracting = [component for component in found.components if component.kind == "attracting"]
    # The two-impact motion of figure 12: both eigenvalues of the reduced map are e.
    assert [component.reduced_impacts for component in attracting] == [1]
    assert float(attracting[0].spectral_radius.lower) <= 0.5 <= float(attracting[0].spectral_radius.upper)
    assert found.statement in repr(found)


def test_windows(cli):
    requested = ("--over", "gap=9.4247..9.4253", "--impacts", 1000, "--effort", 2, "--most", 1)
    found = Scene.named("figure-14").windows({"gap": ("9.4247", "9.4253")}, impacts=1000, effort=2, most=1)
    assert found.document == cli.json("windows", "scenes/figure-14.toml", *requested)
    assert len(found) == len(found.document["windows"])
    assert "others are not excluded" in repr(found)


def test_tangency(cli):
    word = "FFFFFFFNFFFFFNFFNFFNFFFF"
    found = Scene.named("figure-14").tangency({"gap": ("9.4249", "9.4252")}, word=word)
    assert [tangency.flights for tangency in found] == [word]
    # The constant of an independent computation in balls.
    assert found.tangencies[0].parameter.lower[:25] == "9.42512637688720494843198"
    assert "others are not excluded" in repr(found)
    own, beside = found.tangencies[0], found.tangencies[0].beside
    assert own.states is None
    assert beside is not None
    assert len(beside.states) == len(word) - 1
    few = Scene.named("figure-14").tangency({"gap": ("9.4249", "9.4252")}, effort=Decimal("1e-7"))
    assert few.document == cli.json("tangency", "scenes/figure-14.toml", "--over", "gap=9.4249..9.4252", "--effort", "1e-7")
    assert few.document["limited"]
    assert not few.complete
    assert float(beside.two.upper) < float(own.parameter.lower) < float(beside.none.lower)


def test_cycles(cli):
    assert Scene.named("figure-14").cycles(3).document == cli.json("cycles", "scenes/figure-14.toml", "--impacts", 3)
    found = Scene.named("figure-14").cycles((1, 5))
    assert found.document == cli.json("cycles", "scenes/figure-14.toml", "--impacts", "1..5")
    assert found.fixed_points == {1: 1, 2: 1, 3: 4, 4: 1, 5: 11}
    assert found.complete
    assert all(orbit.stability == "unstable" for orbit in found)


def test_audit(cli, tmp_path):
    scene = Scene.named("figure-14")
    orbit = scene.run(impacts=30, arithmetic="float")
    listed = tmp_path / "events.csv"
    rows = zip(orbit.t, orbit.walls, orbit.v, strict=True)
    listed.write_text("time,wall,velocity\n" + "".join(f"{t!r},{wall},{v!r}\n" for t, wall, v in map(plain, rows)))
    from_cli = cli.json("audit", "scenes/figure-14.toml", listed)
    assert scene.audit(listed).document == from_cli
    found = scene.audit({"time": orbit.t, "wall": orbit.walls, "velocity": orbit.v})
    assert found.counts == from_cli["counts"]
    assert found.first_disagreement == from_cli["first_disagreement"]
    assert scene.audit(orbit.to_pandas().rename(columns={"t_lower": "time"})[["time", "wall"]]).agreed in (True, False)
    loose = scene.audit(listed, tolerance="1e-6", until=5, velocities=False)
    assert loose.document == cli.json("audit", "scenes/figure-14.toml", listed, "--tolerance", "1e-6", "--until", 5, "--no-velocity")
    with pytest.raises(impact_pair.ListError):
        scene.audit({"time": ["x"], "wall": ["left"]})


def test_r35_columns_that_are_not_read_are_named():
    scene = Scene.named("figure-14")
    orbit = scene.run(impacts=5)
    listed = {"time": orbit.t, "wall": orbit.walls, "puck_speed": -orbit.v}
    found = scene.audit(listed)
    assert found.agreed
    assert found.unused_columns == ["puck_speed"]
    assert "not read: puck_speed" in found.message
    # The options of the command line are none of Python.
    assert "--" not in found.message
    assert not scene.audit({**listed, "v_minus": -orbit.v}).agreed


def plain(row):
    t, wall, v = row
    return float(t), str(wall), float(v)


def test_check_and_prove(cli, tmp_path):
    orbit = Scene.named("figure-14").run(impacts=10)
    verdict = orbit.check()
    assert verdict
    assert verdict.verdict == "confirmed"
    (tmp_path / "orbit.json").write_text(orbit.json())
    assert verdict.message in cli.text("check", tmp_path / "orbit.json")
    spoiled = orbit.json().replace('"impacts": 10', '"impacts": 11').replace('"impacts":10', '"impacts":11')
    assert spoiled != orbit.json()
    found = impact_pair.check(spoiled)
    assert found.verdict == "refuted"
    assert [claim.path for claim in found.claims if claim.reason] == ["outcome"]
    assert {claim.verdict for claim in verdict.claims} == {"confirmed"}
    assert "events[9].time" in {claim.path for claim in verdict.claims}
    assert verdict.unjudged == ["arithmetic", "program"]
    theorem = orbit.prove(3)
    assert (theorem.impacts, theorem.stop, theorem.left_out) == (3, None, None)
    whole = Scene.named("figure-12").run(impacts=20).prove()
    assert (whole.stop, whole.left_out) == (None, "the outcome `attracted`")
    assert theorem.text == cli.text("prove", tmp_path / "orbit.json", "--impacts", 3)
    with pytest.raises(impact_pair.CertificateError):
        impact_pair.check("{}")


def test_trade(cli):
    """Times differ from run to run; what is certified does not."""
    found = Scene.named("figure-12").trade(impacts=9, max_bits=96)
    from_cli = cli.json("trade", "scenes/figure-12.toml", "--impacts", 9, "--max-bits", 96)
    keys = ("arithmetic", "impacts", "widths", "digits", "bits")
    known = [{key: row.get(key) for key in keys} for row in from_cli["arithmetics"]]
    assert [{key: row.get(key) for key in keys} for row in found.arithmetics] == known


def test_plot(cli, tmp_path):
    cli.text("plot", "scenes/figure-13.toml", "--panel", "a", "--panel", "c", "--cycles", 5, "--output", tmp_path / "told.svg")
    found = Scene.named("figure-13").plot("ac", cycles=5)
    assert found.svg == (tmp_path / "told.svg").read_text()
    assert found._repr_svg_() == found.svg
    found.save(tmp_path / "found.svg")
    assert (tmp_path / "found.svg").read_text() == found.svg


def test_every_verb_of_the_command_line_is_there(cli):
    """But those that are about the command line itself."""
    listed = cli.text("help").split("Commands:")[1].split("Options:")[0].splitlines()
    verbs = {line.split()[0].replace("-", "_") for line in listed if line.startswith("  ") and line.strip() and line[2] != " "}
    here = {name for name in dir(Scene) if not name.startswith("_")} | {"check", "prove"}
    # A keyword is no name.
    here |= {"global"} if "global_analysis" in here else set()
    assert verbs - {"help", "man", "completions"} - here == set()
    assert {"run", "sweep", "audit"} <= verbs


def test_defaults_are_those_of_the_command_line(cli):
    import inspect
    import re

    compared = set()
    for verb, method in {
        "run": Scene.run,
        "describe": Scene.describe,
        "sweep": Scene.sweep,
        "bifurcations": Scene.bifurcations,
        "chaos": Scene.chaos,
        "trap": Scene.trap,
        "cycles": Scene.cycles,
        "windows": Scene.windows,
        "global": Scene.global_analysis,
        "atlas": Scene.atlas,
        "tangency": Scene.tangency,
        "trade": Scene.trade,
        "audit": Scene.audit,
        "plot": Scene.plot,
        "periodic": Scene.periodic,
        "two-impact": Scene.two_impact,
    }.items():
        here = {name: str(parameter.default) for name, parameter in inspect.signature(method).parameters.items()}
        # An option is a line of its own; what is said of it, its default at the end, stands below.
        parts = re.split(r"^ {2,6}(?:-\w, )?--([a-z-]+)", cli.text(verb, "--help").split("Options:")[1], flags=re.MULTILINE)
        for name, said in zip(parts[1::2], parts[2::2], strict=True):
            default = re.search(r"\[default: ([^\]\s]+)\]", said)
            key = name.replace("-", "_")
            if default and key in here:
                compared.add((verb, key))
                assert here[key] == default[1], (verb, key)
    assert len(compared) > 15


def test_pictures_by_matplotlib():
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    from impact_pair import plots

    orbit = Scene.named("figure-14").run(impacts=120)
    for panel in plots.PANELS.values():
        _, ax = plt.subplots()
        assert panel(orbit, ax) is ax
    ax = plots.displacement(orbit, cycles=2)
    [curve] = [line for line in ax.lines if len(line.get_xdata()) > 10]
    assert np.allclose(curve.get_ydata(), orbit(curve.get_xdata()).y, equal_nan=True)
    assert plots.figure(12, impacts=50).size == 8
    plt.close("all")


def test_r41_shares_are_rounded_as_they_are_proved():
    assert [percent("attracted", share) for share in (1.0, 0.999999, 0.29, 0.0)] == ["100.00%", "99.99%", "29.00%", "0.00%"]
    assert [percent("undecided", share) for share in (1.0, 0.000001, 0.29, 0.0)] == ["100.00%", "0.01%", "29.00%", "0.00%"]
