"""Numbers taken from a run. `result` is a structured array, `time` and the outputs, in SI units."""

from dataclasses import dataclass

import numpy as np

BOUND_FACTOR = 10.0
"""How many relative tolerances the energy may be off, of the energy turned over."""
LARGEST_BOUND = 1e-3
"""What it may be off at most, however loose the tolerance."""
ROUNDING = 16.0 * np.finfo(float).eps
"""How far a sum of energies is off by rounding, of the largest."""


@dataclass(frozen=True)
class EnergyBalance:
    """How well the energy ledger closes."""

    residual: float
    """Largest |energy.residual| [J]."""
    turnover: float
    """The energy in play, to which the residual compares [J]."""
    bound: float
    """What the residual may reach [J]."""

    @property
    def holds(self):
        """False, too, where the residual is not a number."""
        return self.residual <= self.bound


def energy_balance(result, relative_tolerance):
    """The ledger total − total(start) − supplied + dissipated against its bound."""
    sizes = {kind: np.abs(result[f"energy.{kind}"]).max() for kind in ("kinetic", "potential", "supplied", "dissipated")}
    # Of the potential, whose zero is anywhere, only the change is in play.
    turnover = sizes["kinetic"] + np.ptp(result["energy.potential"]) + sizes["supplied"] + sizes["dissipated"]
    tolerated = min(BOUND_FACTOR * relative_tolerance, LARGEST_BOUND) * turnover
    return EnergyBalance(
        residual=np.abs(result["energy.residual"]).max(),
        turnover=turnover,
        bound=max(tolerated, ROUNDING * max(sizes.values())),
    )


@dataclass(frozen=True)
class Deviation:
    """The deviation of omega_phi from its start value."""

    values: np.ndarray
    unit: str
    """Per cent (%) of the start value, or rad/s where that is next to nothing."""

    @property
    def extremum(self):
        """Index of the largest deviation, of either sign."""
        return int(np.argmax(np.abs(self.values)))


def spin_deviation(result):
    """How far the axial rate omega_phi strays from its start value."""
    spin = result["omega_phi"]
    difference = spin - spin[0]
    if abs(spin[0]) > 1e-6 * np.abs(spin).max():
        return Deviation(100.0 * difference / abs(spin[0]), "%")
    return Deviation(difference, "rad/s")


SMALL_TILT = 0.2
"""The axis of a machine in its bearings leans by less than this [rad]."""


def around_largest_tilt(result):
    """The slice of the run in which the axis leans by more than a right angle without a break, the largest tilt in it."""
    theta = tilt(result)
    largest = int(theta.argmax())
    upright = np.flatnonzero(theta <= np.pi / 2.0)
    before, after = upright[upright < largest], upright[upright > largest]
    return slice(before[-1] if before.size else 0, after[0] + 1 if after.size else len(theta))


def tilt(result):
    """θ = |γ|, the angle between rotor axis and reference axis [rad]."""
    return np.hypot(result["gamma.y"], result["gamma.z"])
