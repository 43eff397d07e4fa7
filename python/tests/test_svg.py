"""Words of SVG pictures stand at the same places in two renderers that share no code: CairoSVG and librsvg."""

import io
import re
import subprocess
import xml.etree.ElementTree as ET

import cairosvg
import matplotlib.image
import numpy as np
import pytest

from impact_pair import Scene

NAMESPACE = "{http://www.w3.org/2000/svg}"
#: Pixels that the ink of words may differ by at their edges, of pictures 900 and more wide.
APART = 4


@pytest.fixture(scope="module")
def pictures():
    over = {"frequency": (5, 60, 20)}
    grid = {"start.phase": (0, "2*pi", 3), "start.velocity": (-6, "-1/2", 3)}
    return {
        "plot": Scene.named("figure-13").plot("ace", cycles=2, orbit_cycles=2, impacts=20).svg,
        "manifold": Scene.named("figure-10").manifold(over, (1, 3), picture=True).svg,
        "basins": Scene.named("cascade").sweep(grid, transient=20, impacts=1, summary=True).svg(),
    }


def by_cairo(svg):
    return matplotlib.image.imread(io.BytesIO(cairosvg.svg2png(svg.encode())))


def by_rsvg(svg):
    return matplotlib.image.imread(io.BytesIO(subprocess.run(["rsvg-convert"], input=svg.encode(), capture_output=True, check=True).stdout))


def alone(root, text):
    """A picture of one of its texts alone, on white."""
    box = root.attrib["viewBox"].split()
    head = " ".join(f'{key}="{root.attrib[key]}"' for key in ("width", "height", "viewBox"))
    words = re.sub(r"\s*xmlns:?\w*=\"[^\"]*\"", "", ET.tostring(text, encoding="unicode").rstrip().replace("ns0:", ""))
    ground = f'<rect width="{box[2]}" height="{box[3]}" fill="#FFFFFF"/>'
    return f'<svg {head} xmlns="http://www.w3.org/2000/svg" xml:space="preserve">{ground}{words}</svg>'


def ink(image):
    """Left, right, top and bottom of what is not white [pixels]."""
    dark = image[..., :3].min(axis=-1) < 0.7
    across, down = np.flatnonzero(dark.any(axis=0)), np.flatnonzero(dark.any(axis=1))
    return np.array([across[0], across[-1], down[0], down[-1]])


@pytest.mark.parametrize("name", [pytest.param("plot", marks=pytest.mark.deep), "manifold", "basins"])
def test_r35_words_stand_where_they_stand_in_another_renderer(pictures, name):
    root = ET.fromstring(pictures[name])
    # All of several runs, whose middles and ends renderers see differently, and some others.
    texts = [text for text in root.iter(f"{NAMESPACE}text") if "".join(text.itertext()).strip()]
    mixed = [text for text in texts if len(text)]
    assert len(mixed) > 3
    for text in mixed[:12] + [text for text in texts if not len(text)][::6][:6]:
        svg = alone(root, text)
        places = [ink(by_cairo(svg)), ink(by_rsvg(svg))]
        length = len("".join(text.itertext()))
        # Hinted letters differ in width by parts of a pixel each.
        assert abs(places[0] - places[1]).max() <= APART + 0.12 * length, ("".join(text.itertext()), places)
