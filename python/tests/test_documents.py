"""What documents show runs as they show it."""

import matplotlib
import nbformat
import numpy as np
import pytest
from conftest import ROOT, block
from nbclient import NotebookClient

matplotlib.use("Agg")


@pytest.mark.parametrize("document", ["README.md", "docs/python.md", "python/README.md"])
def test_python_lines(document, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "turbo.toml").write_text(block("README.md", "toml"), encoding="utf-8")
    text = (ROOT / document).read_text(encoding="utf-8")
    blocks = [part.split("```")[0] for part in text.split("```python\n")[1:]]
    blocks = [lines for lines in blocks if "split_rotor" in lines or document != "README.md"]
    names = {}
    for lines in blocks:
        exec(lines, names)  # as a reader would
    assert np.abs(names["result"]["probe[1].r.y"]).max() > 1e-6, "it whirls"


def test_the_notebook_runs_through(tmp_path):
    notebook = nbformat.read(ROOT / "examples" / "split_rotor.ipynb", as_version=4)
    NotebookClient(notebook, resources={"metadata": {"path": tmp_path}}).execute()
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    pictures = sum("image/png" in output.get("data", {}) for cell in cells for output in cell.outputs)
    assert pictures == sum("plt.subplots" in cell.source for cell in cells) > 2
    assert (tmp_path / "turbo.fmu").is_file()
