"""Sensor noise off the model's inputs: local polynomials as wide as the signal allows.

Noise of a slip channel goes through the model into the residual and, worse, into the columns of
dynamic effects: a delay of the wrong sign would explain some of it (errors in variables). Each
sample takes the widest window whose estimate agrees with all narrower ones (intersection of
confidence intervals: Katkovnik 1999, IEEE Trans. Signal Processing 47). Each window is twice as wide
as the last.
"""

from __future__ import annotations

import numpy as np
import scipy

from tire_pipeline.mismatch.model.channels import white_noise

Array = np.ndarray
_INTERVAL = 2.0
"""Half of a confidence interval in standard errors: 95%."""
_ORDER = 2
"""Of the local polynomials."""


def denoise(x: Array, start: Array) -> Array:
    """Return the channel without its sensor noise.

    Parameters
    ----------
    x : ndarray, shape (n,)
    start : ndarray of bool, shape (n,)
        First samples of uninterrupted pieces.

    Returns
    -------
    ndarray, shape (n,)
        Unchanged if the channel has no noise: a set point, or a channel held at a slower rate.
    """
    sigma = white_noise(x)
    if not sigma > np.finfo(np.float32).eps * float(np.ptp(x)):
        return x
    firsts = np.flatnonzero(start)
    return np.concatenate([_piece(piece, sigma) for piece in np.split(x, firsts[firsts > 0])])


def _piece(x: Array, sigma: float) -> Array:
    """Smooth an uninterrupted piece; windows grow until they are half of it, or agree nowhere."""
    out = x.copy()
    low, high = x - _INTERVAL * sigma, x + _INTERVAL * sigma
    alive = np.ones(x.size, bool)
    half = _ORDER
    while alive.any() and 2 * half + 1 <= x.size // 2:
        value, spread = _polynomial(x, half)
        low = np.maximum(low, value - _INTERVAL * sigma * spread)
        high = np.minimum(high, value + _INTERVAL * sigma * spread)
        alive &= low <= high
        out = np.where(alive, value, out)
        half *= 2
    return out


def _polynomial(x: Array, half: int) -> tuple[Array, float]:
    """Return the values of local polynomials and their standard deviation for noise of unit variance."""
    c = scipy.signal.savgol_coeffs(2 * half + 1, _ORDER)
    padded = np.pad(x, half, mode="reflect", reflect_type="odd")
    return scipy.signal.oaconvolve(padded, c, mode="valid"), float(np.linalg.norm(c))
