"""Pictures by matplotlib show what the command line's do: categories, mirror images, proofs, and cells around their values."""

import math

import numpy as np
import pytest

import impact_pair
from impact_pair import Scene

mpl = pytest.importorskip("matplotlib")
mpl.use("Agg")
from impact_pair import plots  # noqa: E402


@pytest.fixture(scope="module")
def starts():
    over = {"start.phase": (0, "2*pi", 9), "start.velocity": (-6, "-1/2", 7)}
    return Scene.named("cascade").sweep(over, transient=100, impacts=1, summary=True)


@pytest.fixture(autouse=True)
def _closed():
    from matplotlib import pyplot as plt

    yield
    plt.close("all")


def labels(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_r35_basins_tell_mirror_images_apart_as_the_command_line_does(starts):
    ax = plots.basins(starts, header=False)
    assert len(labels(ax)) == 3
    svg = starts.svg()
    for name in labels(ax)[:2]:
        assert name.startswith("LR in 1 cycle, L at")
        assert name in svg
    assert ax.get_title(loc="left") == ""
    assert labels(plots.basins(starts, values="word")) == ["LR in 1 cycle"]


def test_two_pictures_of_one_sweep_have_one_legend(starts, cli, tmp_path):
    over = ("--over", "start.phase=0..2*pi:9", "--over", "start.velocity=-6..-1/2:7")
    files = ("--output", tmp_path / "map.csv", "--plot", tmp_path / "map.svg")
    cli.text("sweep", "scenes/cascade.toml", *over, "--transient", 100, "--impacts", 1, "--summary", *files)
    svg = (tmp_path / "map.svg").read_text()
    ax = plots.basins(starts)
    assert all(name in svg for name in labels(ax))
    assert labels(ax) == sorted(labels(ax), key=svg.index)
    patches = [mpl.colors.to_hex(patch.get_facecolor()).upper() for patch in ax.get_legend().get_patches()]
    assert [f'fill="{colour}"' in svg for colour in patches] == [True, True]
    numbers, colours, _, rings = starts.on_map()
    # The cells of a kind have its colour in both: as many points of each.
    assert sorted(colours[number] for number in set(numbers)) == sorted(patches)
    assert all(f'fill="{colour}" stroke="#000000"' in svg for *_, colour in rings)
    assert len(rings) == 2


def test_r35_cells_are_around_their_values(starts):
    mesh = plots.basins(starts).collections[0]
    edges = mesh.get_coordinates()
    middles = 0.5 * (edges[:-1, :-1] + edges[1:, 1:])
    assert np.allclose(middles[0, :, 0], np.linspace(0, 2 * math.pi, 9))
    assert np.allclose(middles[:, 0, 1], np.linspace(-6, -0.5, 7))
    # Each cell has the colour of its own point, of two keys the second one faster.
    kinds = [round(float(record["period"]["first"]["phase"][0]), 2) for record in starts]
    numbers = mesh.get_array().reshape(7, 9).T.ravel()
    assert len({*zip(kinds, numbers, strict=True)}) == 2
    for values in ("outcome", "exponent"):
        assert plots.basins(starts, values=values).collections[0].get_array().shape == (7, 9)


def test_r35_diagrams_are_coloured_by_proof():
    found = Scene.named("cascade").sweep({"amplitude": ("0.3", "0.9", 7)}, transient=100, impacts=5)
    ax = plots.diagram(found)
    assert ax.get_xlabel() == "amplitude of the box A [length]"
    assert labels(ax) == ["undecided convergence", "proved to converge to a periodic orbit"]
    drawn = sum(len(line.get_xdata()) for line in ax.lines[:2])
    assert drawn == len(found.states["point"])
    assert [text.get_text() for text in ax.get_yticklabels()] == ["0", "π/2", "π", "3π/2", "2π"]
    assert len(ax.lines[1].get_xdata()) == 5 * found.outcomes["attracted"]


def test_r35_manifolds_have_a_legend_and_an_inset():
    found = Scene.named("figure-10").manifold({"frequency": (1, 60, 30)}, (1, 3), picture=True)
    ax = plots.manifold(found, inset=((5, 10), (0, 2)))
    assert ax.get_ylabel() == "amplitude $A_N$ [length]"
    *named, slopes = labels(ax)
    assert named == [
        "admissible and stable",
        "admissible, unstable",
        "a wall is touched earlier",
        "fold",
        "pitchfork",
        "graze of the near wall",
    ]
    assert slopes.startswith("solid: ")
    assert [text.get_text() for text in ax.texts] == ["$d/2$", "$N = 1$", "$N = 3$"]
    # The command line's words.
    assert all(name in found.svg for name in named)
    [part] = ax.child_axes
    assert part.get_xlim() == (5, 10)
    # The magnified part covers neither curves that tend to d/2 nor names, and its frame crosses none.
    ax.figure.canvas.draw()
    part_box = part.get_tightbbox()
    assert part_box.y0 > ax.transData.transform((0, 10))[1]
    frame = ax.patches[0].get_window_extent()
    for text in ax.texts:
        box = text.get_window_extent()
        assert not box.overlaps(part_box)
        assert not box.overlaps(frame)
    marks = [point["mark"] for curve in found.document["curves"] for point in curve["points"]]
    drawn = [line for line in ax.lines if line.get_marker() == "o"]
    assert sum(len(line.get_xdata()) for line in drawn) == marks.count("fold") > 0


def test_r35_curves_of_manifolds_are_those_of_the_document():
    found = Scene.named("figure-11").manifold({"velocity": (-200, -1, 20)}, (1, 3))
    ax = plots.manifold(found)
    solid = [line for line in ax.lines if line.get_linestyle() in ("-", "--") and line.get_color() != "black"]
    pieces = {(x0, x1) for line in solid for x0, x1 in zip(line.get_xdata()[:-1], line.get_xdata()[1:], strict=True)}
    expected = set()
    for curve in found.curves:
        at = curve.at_bounds.mean(axis=1)
        for i, part in enumerate(curve.parts):
            if part is not None:
                expected |= {(at[i], at[i + 1]), (-at[i], -at[i + 1])}
    assert {tuple(np.round(piece, 9)) for piece in pieces} == {tuple(np.round(piece, 9)) for piece in expected}


def test_r35_grazes_rests_and_releases_are_marked():
    ax = plots.displacement(Scene.named("chatter").run(), cycles=12)
    assert labels(ax) == ["rest", "release"]
    ax = plots.phase_plane(Scene.named("graze").run(), cycles=12)
    assert "graze" in labels(ax)


def test_r35_widths_and_headers_are_those_requested():
    orbit = Scene.named("figure-14").run(impacts=30)
    ax = plots.section_left(orbit, width="single")
    assert ax.figure.get_figwidth() == pytest.approx(90 / 25.4)
    assert ax.get_title(loc="left") == "A = 8, Ω = pi, τ = 0, d = 9.42497, e = 0.5\ncertified: 30 impacts"
    assert plots.displacement(orbit, ax, 2) is ax
    # Names of axes are no longer than the axes' sides of the figure.
    ax.figure.canvas.draw()
    assert ax.yaxis.label.get_window_extent().height < ax.figure.bbox.height
    assert plots.panels(orbit, "ag", width=5, header=False)[0, 0].figure.get_figwidth() == 5


def test_r35_a_map_of_something_else_is_refused(starts):
    with pytest.raises(impact_pair.RangeError, match="values is 'colour'"):
        plots.basins(starts, values="colour")
    one = Scene.named("cascade").sweep({"gap": (1, 2, 2)}, transient=1, impacts=1)
    with pytest.raises(impact_pair.RangeError, match="a map is over 2"):
        plots.basins(one)
