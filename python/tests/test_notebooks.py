"""The notebooks run, and what they assert holds; the executed ones are kept for the manual."""

import json
import os

import pytest
from conftest import ROOT

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

NOTEBOOKS = sorted((ROOT / "python/notebooks").glob("*.ipynb"))
# Those that start a cluster, or draw for seconds; of the others one is enough in small.
SLOW = ("dask", "figures", "how-chaotic", "simulator")
EXECUTED = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "notebooks"


def test_there_are_notebooks():
    assert [path.stem for path in NOTEBOOKS] == ["chaos", "dask", "figures", "how-chaotic", "simulator"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_is_stripped(path):
    """Outputs are the machine's that ran it: not in the repository."""
    code = [cell for cell in json.loads(path.read_text())["cells"] if cell["cell_type"] == "code"]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code)


@pytest.mark.parametrize("path", [pytest.param(path, id=path.stem, marks=[pytest.mark.deep] * (path.stem in SLOW)) for path in NOTEBOOKS])
def test_it_runs(path):
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(path.parent)}}).execute()
    EXECUTED.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, EXECUTED / path.name)
