"""The parts of figures 14, 16 and 17 that pictures can show: how long a simulation in doubles follows the true orbit."""
from finding import SEEN, Finding, expect
from program import Run, listed_walls

IMPACTS = 1000


def doubles(quick):
    """The first impact on the wrong wall in plain doubles (`--arithmetic float`)."""
    shown = []
    for figure in (14, 16, 17):
        scene = f"scenes/figure-{figure}.toml"
        true = [wall for wall, _, _ in Run(scene, "--impacts", str(IMPACTS)).impacts]
        plain = listed_walls(scene, "--impacts", str(IMPACTS), "--arithmetic", "float")
        wrong = next((i for i, walls in enumerate(zip(true, plain), 1) if walls[0] != walls[1]), None)
        expect(wrong is not None and wrong > 50, f"figure {figure}: the first wrong wall")
        shown.append(f"figure {figure}: {wrong}")
    return [Finding("a simulation in doubles leaves the true orbit of figures 14, 16, 17", SEEN,
                    "first impact on the wrong wall: " + ", ".join(shown))]


CLAIMS = {"doubles": doubles}
