"""What the tests measure of a run, in numpy. Rows are instants."""

import numpy as np


def vectors(result, name, components="xyz"):
    """The components of a vector of fmpy's result, as rows."""
    return np.stack([result[f"{name}.{c}"] for c in components], axis=-1)


def distance(a, b):
    """The largest distance between two rows."""
    return np.linalg.norm(a - b, axis=-1).max()
