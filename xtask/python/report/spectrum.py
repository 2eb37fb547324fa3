"""Frequencies in a motion across the axis: y + i z as a sum of whirls, forward ones at positive frequencies."""

import numpy as np

PADDED = 4
"""Times its length that a spectrum is filled up to."""
COLUMNS, ROWS = 240, 161
"""Times and frequencies of a waterfall."""


def full(time, offset):
    """Frequencies [Hz] and amplitudes of the whirls of the second half of a run, `offset` y + i z [m]."""
    half = offset[len(offset) // 2 :]
    window = np.hanning(len(half))
    # Filled up with zeros, so that its peaks are round.
    spectrum = np.fft.fft((half - half.mean()) * window, PADDED * len(half)) / window.sum()
    frequency = np.fft.fftfreq(len(spectrum), time[1] - time[0])
    return np.fft.fftshift(frequency), np.abs(np.fft.fftshift(spectrum))


def waterfall(time, offset, highest, width):
    """The whirls against the time, by windows of `width` [s], up to ±`highest` [Hz].

    Returns times [s], frequencies [Hz] and amplitudes [m], a row a frequency.
    """
    step = time[1] - time[0]
    length = int(np.clip(width / step, 16, len(time) // 4))
    window = np.hanning(length + 1)[:-1]
    starts = np.unique(np.linspace(0, len(time) - length, COLUMNS).astype(int))
    frequencies = np.linspace(-highest, highest, ROWS)
    pieces = np.stack([offset[start : start + length] for start in starts], axis=1)
    pieces = (pieces - pieces.mean(axis=0)) * window[:, None] / window.sum()
    # A frequency a row, as it is drawn; a fast transform would give others.
    waves = np.exp(-2j * np.pi * np.outer(frequencies, step * np.arange(length)))
    return time[starts] + step * length / 2.0, frequencies, np.abs(waves @ pieces)
