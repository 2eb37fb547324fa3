"""Rotations and what the tests measure of a run, in numpy; independent of the model. SI units.

Rows are instants: a Euler vector is an array of shape (n, 3), an attitude one of shape (n, 3, 3).
"""

import numpy as np


def vectors(result, name, components="xyz"):
    """The components of a vector of fmpy's result, as rows."""
    return np.stack([result[f"{name}.{c}"] for c in components], axis=-1)


def attitude(euler):
    """L(ϑ) by Rodrigues' formula."""
    theta = np.linalg.norm(euler, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(np.asarray(euler), -1, 0)
    o = np.zeros_like(x)
    cross = np.moveaxis(np.array([[o, -z, y], [z, o, -x], [-y, x, o]]), (0, 1), (-2, -1))
    # sin θ/θ and (1 − cos θ)/θ²
    return np.eye(3) + np.sinc(theta / np.pi) * cross + 0.5 * np.sinc(theta / (2 * np.pi)) ** 2 * cross @ cross


def axis(euler):
    """t = L(γ)e."""
    return attitude(euler)[..., 0]


def distance(a, b):
    """The largest distance between two rows."""
    return np.linalg.norm(a - b, axis=-1).max()
