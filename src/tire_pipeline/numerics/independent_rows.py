"""How many rows of a coloured residual count as one."""

from __future__ import annotations

import numpy as np


def rows_of_one(residuals: np.ndarray) -> float:
    """Return how many rows carry as much information as one independent row.

    The sum of the autocorrelation, as far as pairs of lags stay positive (Geyer's initial sequence).
    """
    centred = residuals - residuals.mean()
    size = centred.size
    spectrum = np.fft.rfft(centred, 2 * size)
    correlation = np.fft.irfft(spectrum * spectrum.conj())[:size]
    if correlation[0] <= 0.0:
        return 1.0
    correlation /= correlation[0]
    pairs = correlation[1 : size - (size - 1) % 2].reshape(-1, 2).sum(axis=1)
    stop = int(np.argmax(pairs <= 0.0)) if (pairs <= 0.0).any() else pairs.size
    return float(np.clip(1.0 + 2.0 * pairs[:stop].sum(), 1.0, max(size / 10.0, 1.0)))
