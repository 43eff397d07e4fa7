"""Images of boxes: they hold the next impacts of states in them, which certified flights give."""

import runpy

import numpy as np
import pytest
from conftest import ROOT

import impact_pair
from impact_pair import Scene

SCENES = {
    "figure-14": Scene.named("figure-14"),
    "own": Scene(amplitude="2.3", frequency=5, gap="7.1", restitution="0.63", velocity=-1, phase="0.4"),
    "short": Scene(amplitude=2, frequency=3, gap="0.8", restitution="0.9", velocity=-1),
}


def floats(scene):
    shaken = scene.document["excitation"]
    numbers = [
        *(shaken[key][0] for key in ("amplitude", "frequency", "phase")),
    ]
    return [np.pi if number == "pi" else float(number) for number in numbers]


def landed(scene, states, walls):
    """The next impacts of reduced states, in reduced coordinates, and whether they are on the wall that was left."""
    amplitude, frequency, tau = floats(scene)
    phase, speed = states.T
    turn = phase - np.where(walls > 0, 0.5, 0)
    found = scene.flights((2 * np.pi * (turn + 1) - tau) / frequency, walls * speed * amplitude * frequency, walls)
    known = found.sides != 0
    later = (frequency * found.t_bounds[:, 0] + tau) / (2 * np.pi) + np.where(found.sides > 0, 0.5, 0)
    return known, np.stack([later, np.abs(found.v_bounds[:, 0]) / (amplitude * frequency)], -1), found.sides == walls


def is_in(state, rect, slack=1e-9):
    """True if a state is in a rectangle, its phase modulo 1; bounds in doubles are compared with the slack of theirs."""
    phase = rect[0] - slack + np.mod(state[0] - rect[0] + slack, 1)
    return phase <= rect[2] + slack and rect[1] - slack <= state[1] <= rect[3] + slack


@pytest.mark.parametrize("name", SCENES)
def test_r35_images_hold_the_next_impacts(name):
    scene, random = SCENES[name], np.random.default_rng(35)
    corners = random.uniform([0, 0.3], [1, 3], (150, 2))
    sizes = 10 ** random.uniform(-6, -1, (150, 2))
    images = scene.box_map(np.concatenate([corners, corners + sizes], 1), columns=1024)
    assert images.decided.mean() > 0.7
    states = corners + random.uniform(0, 1, (8, 150, 2)) * sizes
    seen = set()
    for some in states:
        walls = random.choice([-1, 1], 150)
        known, later, are_near = landed(scene, some, walls)
        for i in np.flatnonzero(known & images.decided):
            assert is_in(later[i], images.rects[i])
            assert is_in(later[i], (images.near if are_near[i] else images.far)[i])
            seen.add(bool(are_near[i]))
    assert seen == {True, False}


def test_r35_small_boxes_have_small_images():
    images = Scene.named("figure-12").box_map([[0.0, 4.0, 1e-9, 4.0 + 1e-9]], columns=2**16)
    assert np.isnan(images.near).all()
    assert (images.rects[0, 2:] - images.rects[0, :2] < [1e-4, 1e-6]).all()


@pytest.mark.parametrize("rects", [[[0, 1, 0.1]], [0, 1, 0.1, 2], [[0.1, 1, 0, 2]], [[0, -1, 0.1, 2]], [[0, 1, np.nan, 2]]])
def test_r35_what_is_no_box_is_refused(rects):
    with pytest.raises(impact_pair.RangeError, match="rects"):
        Scene.named("figure-12").box_map(rects)


def test_r35_columns_are_a_power_of_two_and_harmonics_one():
    with pytest.raises(impact_pair.RangeError, match="power of two"):
        Scene.named("figure-12").box_map([[0, 1, 0.1, 2]], columns=1000)
    with pytest.raises(impact_pair.Error, match="harmonic"):
        Scene.named("two-tones").box_map([[0, 1, 0.1, 2]])


def recurrent(images, across, up, highest):
    """The cells of a grid that are on a cycle of their images, by SciPy: those whose interiors meet, phases modulo 1."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    pairs = []
    for cell, (u, w, v, x) in enumerate(images):
        columns = {k % across for k in range(int(np.floor(u * across)), int(np.ceil(v * across)))}
        rows = range(int(np.floor(w * up / highest)), min(int(np.ceil(x * up / highest)), up))
        pairs += [(cell, column * up + row) for column in columns for row in rows]
    edges = np.array(pairs).T
    graph = coo_array((np.ones(len(pairs)), edges), shape=(len(images), len(images)))
    _, labels = connected_components(graph, connection="strong")
    is_alone = np.bincount(labels)[labels] == 1
    loops = set(edges[0][edges[0] == edges[1]])
    return {cell for cell in range(len(images)) if not is_alone[cell] or cell in loops}


@pytest.mark.deep
def test_r35_the_example_finds_all_recurrent_boxes(capsys):
    pytest.importorskip("CMGDB")
    found = runpy.run_path(str(ROOT / "python/examples/morse_sets.py"))
    graph, images = found["morse_graph"], found["images"]
    assert f"```text\n{capsys.readouterr().out}```" in (ROOT / "docs/howto/boxes.md").read_text()
    boxes = np.concatenate([graph.morse_set_boxes(vertex) for vertex in graph.vertices()])
    across, up = 2**7, 2**7
    corners = np.stack(np.meshgrid(np.arange(across) / across, np.arange(up) * 6 / up, indexing="ij"), -1).reshape(-1, 2)
    cells = np.concatenate([corners, np.add(corners, [1 / across, 6 / up])], 1)
    cycled = recurrent(images(cells), across, up, 6)
    listed = {round(u * across) * up + round(w * up / 6) for u, w, _, _ in boxes}
    assert cycled <= listed
    assert len(listed) < 0.25 * across * up
    # The orbit of the scene that attracts is in the attractor.
    attractor = [vertex for vertex in graph.vertices() if not graph.adjacencies(vertex)]
    assert len(attractor) == 1
    orbit = found["scene"].describe().orbit
    for wall, phase, velocity in zip(orbit.walls, orbit.phases, orbit.velocities, strict=True):
        state = [np.mod(phase.mid / (2 * np.pi) + 0.5 * (wall == "right"), 1), abs(velocity.mid) / (2.3 * 5)]
        assert any(is_in(state, box) for box in graph.morse_set_boxes(attractor[0]))
