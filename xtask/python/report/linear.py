"""The linear view of a scene: what `cargo xtask campbell` found, read from its JSON."""

import json
from dataclasses import dataclass

import numpy as np

NEITHER = 1e-6
"""A damping ratio of less, of either sign, is one of 0."""
AXIAL = "axial"


@dataclass(frozen=True)
class Linear:
    """Modes against the spin."""

    modes: list[dict]
    """A row a mode and speed, as in campbell.csv."""
    critical: list[dict]
    """Where a mode's frequency is the speed itself, ascending; modes along the axis left out, which no unbalance drives."""
    thresholds: list[tuple[float, str, int]]
    """Speeds [rad/s], on which side of them motions grow, "above" or "below", and the mode; "" and 0 where that is not told."""
    floquet: bool
    """Of a body that is not symmetric: exponents of its revolutions in place of modes."""
    growing: tuple[float, ...] = ()
    """Speeds [rad/s] at which small motions of such a body grow."""
    tables: tuple[tuple[str, float, float], ...] = ()
    """Effects with tables, each with the speeds [rad/s] between which it is known: beyond them coefficients are held."""

    def branches(self):
        """Of each mode its number and its rows, ascending speeds; those along the axis and those that never swing left out."""
        for number in sorted({row["mode"] for row in self.modes}):
            rows = [row for row in self.modes if row["mode"] == number]
            if any(row["direction"] != AXIAL and row["frequency_rad_s"] for row in rows):
                yield number, rows

    def between(self, low, high):
        """The rows of all modes from one speed to another [rad/s], both included."""
        for number in {row["mode"] for row in self.modes}:
            rows = [row for row in self.modes if row["mode"] == number]
            yield from (row for row in rows if low < row["speed_rad_s"] < high)
            yield from filter(None, (_between(rows, speed) for speed in (low, high)))

    def least_damped(self, low, high):
        """The row of the least damping ratio from one speed to another [rad/s], modes along the axis left out; None where there are no others."""
        across = [row for row in self.between(low, high) if row["direction"] != AXIAL]
        return min(across, key=lambda row: row["damping_ratio"], default=None)

    def fastest_growing(self, low, high):
        """The row of the fastest growth from one speed to another [rad/s], of any mode; None where none grows."""
        growing = [row for row in self.between(low, high) if row["damping_ratio"] < -NEITHER]
        return max(growing, key=lambda row: row["growth_rate_1_s"], default=None)

    def growth(self):
        """Speeds [rad/s] and the fastest growth at each [1/s], of a body that is not symmetric."""
        speeds = np.unique([row["speed_rad_s"] for row in self.modes])
        rates = [max(row["growth_rate_1_s"] for row in self.modes if row["speed_rad_s"] == speed) for speed in speeds]
        return speeds, np.array(rates)

    def fastest_growth(self, low, high):
        """The fastest growth at the speeds from `low` to `high` [rad/s], or at the one that is nearest to them, and that speed."""
        speeds, rates = self.growth()
        away = np.maximum(np.maximum(low - speeds, speeds - high), 0.0)
        near = np.flatnonzero(away == away.min())
        fastest = near[rates[near].argmax()]
        return speeds[fastest], rates[fastest]


def read(file):
    """The linear view in a campbell.json."""
    found = json.loads(file.read_text(encoding="utf-8"))
    crossed = [speed for line in found.get("critical_speeds", []) if line["order"] == 1.0 for speed in line["speeds"]]
    told = [t if isinstance(t, dict) else {"speed_rad_s": t, "grows": "", "mode": 0} for t in found["thresholds"]]
    thresholds = [(t["speed_rad_s"], t["grows"], t["mode"]) for t in told]
    # A motion that neither swings nor grows has no damping ratio.
    modes = [row | {"damping_ratio": row["damping_ratio"] or 0.0} for row in found["modes"]]
    critical = [crossing for crossing in crossed if crossing["direction"] != AXIAL]
    growing = found.get("growing", [])
    # Speeds are shown by their size. A rotor that runs the other way round is looked at there.
    if all(row["speed_rad_s"] <= 0.0 for row in modes):
        modes = [row | {"speed_rad_s": -row["speed_rad_s"]} for row in reversed(modes)]
        critical = [crossing | {"speed_rad_s": -crossing["speed_rad_s"]} for crossing in reversed(critical)]
        growing = [-speed for speed in growing]
        other = {"above": "below", "below": "above", "": ""}
        thresholds = [(-speed, other[grows], mode) for speed, grows, mode in reversed(thresholds)]
    return Linear(
        modes=modes,
        critical=critical,
        thresholds=thresholds,
        floquet=found.get("floquet", False),
        growing=tuple(growing),
        tables=tuple((t["effect"], t["from_rad_s"], t["to_rad_s"]) for t in found.get("tables", [])),
    )


def _between(rows, speed):
    """A mode at a speed [rad/s] between those of two of its rows; None beyond them."""
    after = next((n for n, row in enumerate(rows) if row["speed_rad_s"] >= speed), None)
    if after is None or (after == 0 and rows[0]["speed_rad_s"] > speed):
        return None
    below, above = rows[max(after - 1, 0)], rows[after]
    width = above["speed_rad_s"] - below["speed_rad_s"]
    part = (speed - below["speed_rad_s"]) / width if width else 1.0
    numbers = ("damping_ratio", "frequency_rad_s", "growth_rate_1_s")
    return above | {"speed_rad_s": speed} | {name: (1.0 - part) * below[name] + part * above[name] for name in numbers}


def decrement(damping_ratio):
    """The logarithmic decrement of a mode; not a number where it does not swing."""
    rest = 1.0 - damping_ratio**2
    return 2.0 * np.pi * damping_ratio / np.sqrt(rest) if rest > 1e-9 else np.nan
