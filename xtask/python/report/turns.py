"""A run looked at revolution by revolution, by the angle φ instead of the time."""

from dataclasses import dataclass

import numpy as np

PER_TURN = 64
"""Angles of a turn at which it is looked at."""
LEAST_SAMPLES = 6.0
"""Samples that a turn needs; cubics through place and velocity are then right to 0.3 % of a synchronous whirl."""
UNLIKE = 1.0 / 3.0
"""What goes round as many times in each turn differs by less than this part from its mean over some turns."""
SETTLING = 10
"""Turns over which the middle and the parts of a whirl are taken, so that one at a part of the speed goes round within them."""


@dataclass(frozen=True)
class Turns:
    """The offset of a station, turn by turn; a turn begins where φ is a whole multiple of 2π."""

    time: np.ndarray
    """At the middle of each turn [s]."""
    speed: np.ndarray
    """Mean of |dφ/dt| over each turn [rad/s]."""
    offset: np.ndarray
    """y + i z [m], a row a turn; mirrored where the rotor turns backward, so that the spin is always positive."""

    @property
    def whirl(self):
        """The largest distance from the middle in each turn [m], all frequencies together."""
        middle = self.offset.mean(axis=1)
        return np.abs(self.offset - _near(middle, np.ones(min(SETTLING, len(middle))))[:, None]).max(axis=1)

    def order(self, multiple):
        """The part of each turn that goes round `multiple` times in it, complex amplitude [m]; negative: backward."""
        angles = 2.0 * np.pi * np.arange(PER_TURN) / PER_TURN
        return (self.offset * np.exp(-1j * multiple * angles)).mean(axis=1)

    def synchronous(self):
        """`order` 1 and −1, and whether they are like those of the turns around: other whirls pass for them in one turn only."""
        parts = np.array([self.order(1), self.order(-1)])
        window = np.hanning(min(SETTLING, len(self.time)) + 2)[1:-1]
        around = np.array([_near(part, window) for part in parts])
        return *parts, np.abs(parts - around).sum(axis=0) < UNLIKE * np.abs(around).sum(axis=0)


def samples(result):
    """How many samples the fastest turn of a run has."""
    return 2.0 * np.pi / max(np.abs(np.diff(result["phi"])).max(), 1e-300)


def turns(station, result):
    """The turns of the longest part of a run in one sense; None where that has fewer than three, or is sampled too seldom."""
    result = result[_in_one_sense(result["phi"])]
    sense = np.sign(result["phi"][-1] - result["phi"][0])
    angle, time = sense * result["phi"], result["time"]
    if len(angle) < 2 or samples(result) < LEAST_SAMPLES:
        return None
    first, last = np.ceil(angle[0] / (2.0 * np.pi)), np.floor(angle[-1] / (2.0 * np.pi))
    count = int(last - first)
    if count < 3:
        return None
    grid = 2.0 * np.pi * (first + np.arange(count * PER_TURN + 1) / PER_TURN)
    when = np.interp(grid, angle, time)
    starts = when[::PER_TURN]
    offset = _cubic(time, station.offset(result), station.velocity(result), when[:-1])
    offset = offset if sense > 0.0 else offset.conj()
    return Turns(
        (starts[1:] + starts[:-1]) / 2.0, 2.0 * np.pi / np.diff(starts), offset.reshape(count, PER_TURN)
    )


def _near(each, window):
    """The mean about each turn with these weights, at the ends of those that are there."""
    return np.convolve(each, window, "same") / np.convolve(np.ones(len(each)), window, "same")


def _in_one_sense(angle):
    """The rows between two reversals, those over which the angle changes most."""
    sense = np.sign(np.diff(angle))
    ends = np.concatenate([[0], np.flatnonzero(np.diff(sense)) + 1, [len(sense)]])
    longest = np.abs(np.diff(angle[ends])).argmax()
    return slice(ends[longest], ends[longest + 1] + 1)


def _cubic(time, value, rate, when):
    """Values at the times `when`, by the cubics through the values and their rates (Hermite)."""
    left = np.clip(np.searchsorted(time, when, "right") - 1, 0, len(time) - 2)
    step = time[left + 1] - time[left]
    x = (when - time[left]) / step
    a, b = value[left], value[left + 1]
    slopes = x * (1.0 - x) * step * ((1.0 - x) * rate[left] - x * rate[left + 1])
    return a + (b - a) * x * x * (3.0 - 2.0 * x) + slopes
