"""The rotor of Sorokin and Zhang (2018): what the paper claims, what is exact, what the run found.

The exact values are those of two formulations in quadruple precision and a third code, which agree
to 24 digits.
"""

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from . import measure
from .notation import number, vector

IDENTIFIER = "paper"
SPIN_BOUND = 0.1  # [%]: the change of ω_φ "does not exceed 0.1 %"
SPIN_WINDOWS = (1.0, 5.0, 10.0)  # [s]
ENERGY = 195.3125  # [J], at all times

REFERENCE_TIME = 10.0  # [s]
REFERENCE_R_C = (0.74525064194444117, 0.018132564402519647, -0.13643597127259815)  # [m]
REFERENCE_PHI = 499.97712389629157  # [rad]
REFERENCE_GAMMA = (0.12641251653607321, 0.014515538142784416)  # [rad], along y and z


@dataclass(frozen=True)
class Comparison:
    """A row of the table: what, as the paper or the exact answer has it, as the run has it."""

    what: str
    expected: str
    found: str


def figure(result, number_):
    """What a caption adds of the paper's rotor: in which of its figures the paper shows the same."""
    return f" (the paper’s Figure {number_})" if result.scene.identifier == IDENTIFIER else ""


def comparisons(result):
    """The claims first, then the exact answer at 10 s; each only as far as the run reaches."""
    reached = result["time"][-1]
    yield from (_spin(result, window) for window in SPIN_WINDOWS if window <= reached)
    yield _energy(result)
    at_end = np.flatnonzero(np.isclose(result["time"], REFERENCE_TIME))
    if at_end.size:
        yield from _end(result[at_end[0]])


def _spin(result, window):
    within = result["time"] <= window * (1.0 + 1e-9)
    largest = np.abs(measure.spin_deviation(result[within]).values).max()
    return Comparison(
        Markup(f"largest |ω<sub>φ</sub> − ω₀| / ω₀ in 0 … {window:g} s"),
        f"“does not exceed {SPIN_BOUND:g} %”",
        f"{number(largest, 3)} %",
    )


def _energy(result):
    change = np.abs(result["energy.total"] - ENERGY).max()
    return Comparison("total energy, at its farthest", f"constant; exact: {ENERGY} J", f"{number(change, 2)} J away")


def _end(row):
    vectors = (
        (Markup("r<sub>c</sub>"), REFERENCE_R_C, [row[f"r_c.{c}"] for c in "xyz"], "m"),
        ("φ", (REFERENCE_PHI,), [row["phi"]], "rad"),
        ("γ", REFERENCE_GAMMA, [row[f"gamma.{c}"] for c in "yz"], "rad"),
    )
    for name, reference, found, unit in vectors:
        exact = vector(reference, 6) if len(reference) > 1 else f"{reference[0]:.6f}"
        error = np.linalg.norm(np.subtract(found, reference))
        what = name + f" at {REFERENCE_TIME:g} s"
        yield Comparison(what, f"exact: {exact} {unit}", f"{number(error, 2)} {unit} away")
