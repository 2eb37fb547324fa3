"""The linear view of a scene: what `cargo xtask campbell` found, read from its JSON."""

import json
from dataclasses import dataclass

import numpy as np

NEITHER = 1e-6
"""A damping ratio of less, of either sign, is one of 0."""
AXIAL, BACKWARD = "axial", "backward"


@dataclass(frozen=True)
class Linear:
    """Modes against the spin."""

    modes: list[dict]
    """A row a mode and speed, as in campbell.csv."""
    critical: list[dict]
    """Where a mode's frequency is the speed itself, ascending; modes along the axis left out, which no unbalance drives."""
    thresholds: list[float]
    """Speeds at which motions begin or cease to grow [rad/s]."""
    floquet: bool
    """Of a body that is not symmetric: exponents of its revolutions in place of modes."""

    def branches(self):
        """Of each mode its number and its rows, ascending speeds; those along the axis and those that never swing left out."""
        for number in sorted({row["mode"] for row in self.modes}):
            rows = [row for row in self.modes if row["mode"] == number]
            if any(row["direction"] != AXIAL and row["frequency_rad_s"] for row in rows):
                yield number, rows

    def least_damped(self, speeds):
        """The row of the least damping ratio from the first to the second of these speeds [rad/s]."""
        grid = np.unique([row["speed_rad_s"] for row in self.modes])
        low, high = (grid[np.abs(grid - speed).argmin()] for speed in speeds)
        rows = (row for row in self.modes if low <= row["speed_rad_s"] <= high and row["direction"] != AXIAL)
        return min(rows, key=lambda row: row["damping_ratio"])

    def growth(self):
        """Speeds [rad/s] and the fastest growth at each [1/s], of a body that is not symmetric."""
        speeds = np.unique([row["speed_rad_s"] for row in self.modes])
        rates = [max(row["growth_rate_1_s"] for row in self.modes if row["speed_rad_s"] == speed) for speed in speeds]
        return speeds, np.array(rates)

    def nearest_growth(self, speed):
        """Of the speed that is nearest to this one, itself and the fastest growth at it."""
        speeds, rates = self.growth()
        nearest = np.abs(speeds - speed).argmin()
        return speeds[nearest], rates[nearest]


def read(file):
    """The linear view in a campbell.json."""
    found = json.loads(file.read_text(encoding="utf-8"))
    crossed = [speed for line in found.get("critical_speeds", []) if line["order"] == 1.0 for speed in line["speeds"]]
    thresholds = [t if isinstance(t, float) else t["speed_rad_s"] for t in found["thresholds"]]
    # A motion that neither swings nor grows has no damping ratio.
    modes = [row | {"damping_ratio": row["damping_ratio"] or 0.0} for row in found["modes"]]
    return Linear(
        modes=modes,
        critical=[crossing for crossing in crossed if crossing["direction"] != AXIAL],
        thresholds=thresholds,
        floquet=found.get("floquet", False),
    )


def decrement(damping_ratio):
    """The logarithmic decrement of a mode; not a number where it does not swing."""
    rest = 1.0 - damping_ratio**2
    return 2.0 * np.pi * damping_ratio / np.sqrt(rest) if rest > 1e-9 else np.nan
