"""Morse sets of an impact pair by CMGDB, from certified images of boxes.

Run: python python/examples/morse_sets.py [SUBDIVISIONS]

The boxes are those of CMGDB's grid, phases modulo a forcing period and speeds below a bound; ``box_map`` encloses their images. A box in
which a ball may come to rest is sent to all boxes. So each recurrent motion below the bound is in one of the Morse sets.
"""

import sys

import CMGDB
import numpy as np

from impact_pair import Scene

scene = Scene(amplitude="2.3", frequency=5, gap="7.1", restitution="0.63", velocity=-1)
subdivisions = int(sys.argv[1]) if __name__ == "__main__" and sys.argv[1:] else 14
#: In periods of the forcing, and over A W: no impact is faster for ever than 2/(1 - e), as each adds 2 A W at most.
LOWEST, HIGHEST = [0.0, 0.0], [1.0, 6.0]


def images(rects):
    """Return the enclosures of the images of boxes, all states where nothing is proved."""
    found = scene.box_map(rects)
    return np.where(found.decided[:, None], found.rects, [*LOWEST, *HIGHEST])


model = CMGDB.Model(subdivisions, subdivisions, LOWEST, HIGHEST, [True, False], lambda rect: list(images([rect])[0]))
model.set_batch_map(images)
morse_graph, map_graph = CMGDB.ComputeMorseGraph(model)
for vertex in morse_graph.vertices():
    boxes = np.array(morse_graph.morse_set_boxes(vertex))
    leads = morse_graph.adjacencies(vertex)
    ends = f"phases {boxes[:, 0].min():.3f} to {boxes[:, 2].max():.3f}, speeds {boxes[:, 1].min():.3f} to {boxes[:, 3].max():.3f}"
    print(f"Morse set {vertex}: {len(boxes)} boxes, {ends}; leads to {leads or 'none: an attractor'}")
