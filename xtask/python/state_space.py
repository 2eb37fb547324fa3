"""A state-space model in JSON as a MATLAB file beside it, with the same names: python state_space.py state_space.json"""

import json
import sys
from pathlib import Path

import numpy as np
import scipy.io

# Rows and columns are those of these vectors; without inputs a matrix has no columns.
MATRICES = {"A": ("x0", "x0"), "B": ("x0", "u0"), "C": ("y0", "x0"), "D": ("y0", "u0")}
LISTS = [f"{of}_{words}" for of in ("state", "input", "output") for words in ("names", "safe_names", "units")]


def cells(words):
    """A column of words as MATLAB's cell array."""
    column = np.empty((len(words), 1), dtype=object)
    column[:, 0] = words
    return column


def converted(model):
    """The values of the model by name, as SciPy writes them."""
    matrices = {
        name: np.array(model[name], dtype=float).reshape(len(model[rows]), len(model[columns]))
        for name, (rows, columns) in MATRICES.items()
    }
    vectors = {name: np.array(model[name], dtype=float).reshape(-1, 1) for name in ("x0", "u0", "y0")}
    return model | matrices | vectors | {name: cells(model[name]) for name in LISTS}


if __name__ == "__main__":
    file = Path(sys.argv[1])
    scipy.io.savemat(file.with_suffix(".mat"), converted(json.loads(file.read_text(encoding="utf-8"))))
