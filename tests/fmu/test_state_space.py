"""`cargo xtask state-space` and `response --from --to`: what is written for control design, read back."""

import json
import re
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import project
import pytest

SCIPY = project.ROOT / "target" / "venv-peers" / "scipy" / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
# Reads the MATLAB file and prints what it holds, words as lists.
READ = """
import json, sys, scipy.io
held = scipy.io.loadmat(sys.argv[1])
words = lambda value: [str(cell[0]) if cell.size else "" for cell in value.ravel()]
known = {name: value for name, value in held.items() if not name.startswith("__")}
print(json.dumps({name: words(value) if value.dtype == object else value.tolist() for name, value in known.items()}))
"""
SPEED = 80.0  # [rad/s]
RESPONSE = 2e-13  # against the matrices, over its size [1], measured 4.5e-14


def at(folder):
    """The model in this folder."""
    return json.loads((folder / "state_space.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def folder(xtask, tmp_path_factory):
    """Where the scene `coupled` was written."""
    folder = tmp_path_factory.mktemp("state_space")
    written = xtask("state-space", "coupled", "--speed", SPEED, "--out", folder)
    assert written.returncode == 0, written.stderr
    return folder


def test_exact_matlab_file_holds_what_the_json_does(folder):
    model = at(folder)
    read = subprocess.run(
        [SCIPY, "-c", READ, folder / "state_space.mat"], capture_output=True, encoding="utf-8", check=True
    )
    held = json.loads(read.stdout)
    assert held.keys() == model.keys()
    for name, value in model.items():
        if name in ("scene", "title"):
            assert held[name] == [value]
        elif name.endswith(("_names", "_units")):
            assert held[name] == value, name
        else:
            assert np.array_equal(np.ravel(held[name]), np.ravel(value)), name
    sizes = [len(model[f"{of}_names"]) for of in ("state", "input", "output")]
    assert sizes == [10, 12, len(model["y0"])]
    assert [np.shape(held[name]) for name in "ABCD"] == [
        (rows, columns) for rows, columns in ((10, 10), (10, 12), (sizes[2], 10), (sizes[2], 12))
    ]


def test_regress_there_is_a_list_of_names_that_python_control_takes(folder):
    model = at(folder)
    for of in ("state", "input", "output"):
        names, safe = model[f"{of}_names"], model[f"{of}_safe_names"]
        assert len(set(safe)) == len(safe) == len(names)
        assert all(re.fullmatch(r"[A-Za-z]\w*", name) for name in safe), safe
    assert dict(zip(model["input_names"], model["input_safe_names"], strict=True))["port[1].f.y"] == "port_1_f_y"


def test_the_lines_of_the_document_make_a_system_of_python_control(folder, monkeypatch):
    # The package is in none of the environments: this stands for what it takes (0.10.2), and refuses what it refuses.
    def ss(*matrices, states, inputs, outputs):
        assert [np.shape(matrix) for matrix in matrices] == [
            (len(rows), len(columns)) for rows in (states, outputs) for columns in (states, inputs)
        ]
        assert not any("." in name for name in [*states, *inputs, *outputs]), "control.ss: ValueError"
        return matrices

    monkeypatch.setitem(sys.modules, "control", SimpleNamespace(ss=ss))
    monkeypatch.chdir(folder)
    (lines,) = re.findall("```python\n(.*?)```", (project.ROOT / "docs" / "linear.md").read_text(encoding="utf-8"), re.DOTALL)
    names = {}
    exec(lines, names)  # as a reader would
    assert np.array_equal(names["system"][0], at(folder)["A"])


def test_exact_frequency_response_is_that_of_the_matrices(folder, xtask):
    model = at(folder)
    ends = ["port[2].m.y", "support.F.z"]
    found = xtask("response", "coupled", "--from", ends[0], "--to", ends[1], "--speed", SPEED, "--steps", 50)
    assert found.returncode == 0, found.stderr
    made = project.ROOT / "target" / "response" / "coupled"
    table = json.loads((made / "frequency.json").read_text(encoding="utf-8"))
    assert (table["unit"], table["speed_rad_s"]) == ("N/(N.m)", SPEED)
    rows = np.genfromtxt(made / "frequency.csv", delimiter=",", names=True)
    a, b, c, d = (np.array(model[name]) for name in "ABCD")
    column, row = model["input_names"].index(ends[0]), model["output_names"].index(ends[1])
    exact = np.array([
        c[row] @ np.linalg.solve(1j * frequency * np.eye(10) - a, b[:, column]) + d[row, column]
        for frequency in rows["frequency_rad_s"]
    ])
    answers = rows["real"] + 1j * rows["imaginary"]
    assert len(answers) > 50
    assert np.max(np.abs(answers / exact - 1)) < RESPONSE
    assert np.allclose(rows["magnitude"] * np.exp(1j * rows["phase_rad"]), answers, rtol=1e-14)


def test_regress_names_that_are_not_there_are_told_with_those_that_are(xtask):
    for words, told in (
        (["--from", "port[1].f.w", "--to", "gamma.y"], "coupled.toml: --from port[1].f.w: no such input (did you mean "),
        (["--from", "port[1].f.y", "--to", "gamma"], "coupled.toml: --to gamma: no such output (did you mean "),
    ):
        refused = xtask("response", "coupled", *words)
        assert refused.returncode != 0
        assert told in refused.stderr


def test_regress_a_scene_without_ports_has_no_inputs(xtask, tmp_path):
    written = xtask("state-space", "jeffcott", "--out", tmp_path)
    assert written.returncode == 0, written.stderr
    assert "no inputs: forces and moments come in at an [[effects.port]]" in written.stdout
    model = at(tmp_path)
    assert (model["speed_rad_s"], model["B"]) == (20.0, [[]] * 10)
