"""Curves as compact JSON."""

import numpy as np

LEVELS = 20_000
"""A curve is rounded to this part of its range, a tenth of a pixel and less."""
BUCKETS = 700
"""A curve is cut into so many pieces, about a pixel wide; the extremes of each are kept."""


def packed(values, step=None):
    """Whole steps from the least of `values`; what is not a number becomes null. The page unpacks them."""
    values = np.asarray(values, dtype=float)
    finite = values[np.isfinite(values)]
    least = float(finite.min()) if finite.size else 0.0
    step = step or (float(np.ptp(finite)) / LEVELS if finite.size else 0.0) or 1.0
    whole = np.round((values - least) / step)
    return {"from": least, "step": step, "whole": [int(w) if np.isfinite(w) else None for w in whole]}


def extremes(*curves):
    """The rows at which any of these curves is largest or least within its piece, with the ends, ascending."""
    count = len(curves[0])
    if count <= 2 * BUCKETS:
        return np.arange(count)
    pieces = np.array_split(np.arange(count), BUCKETS)
    kept = {0, count - 1}
    for curve in curves:
        filled = np.nan_to_num(np.asarray(curve, dtype=float))
        for piece in pieces:
            kept |= {piece[filled[piece].argmin()], piece[filled[piece].argmax()]}
    return np.array(sorted(kept))
