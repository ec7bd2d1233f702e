"""What an equation remembers: a lag of first order in steps, as the reader of the sidecar computes it."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.shared import njit

Array = np.ndarray


@njit(cache=True)
def lag(x: Array, gain: Array, start: Array) -> Array:
    """Follow ``x`` with a lag: ``y += gain (x - y)``, and ``y = x`` where a piece starts.

    Parameters
    ----------
    x, gain : ndarray, shape (n,)
        ``gain`` is ``1 - exp(-step / lag)``.
    start : ndarray of bool, shape (n,)
    """
    out = np.empty_like(x)
    y = 0.0
    for i in range(x.size):
        y = x[i] if start[i] else y + gain[i] * (x[i] - y)
        out[i] = y
    return out
