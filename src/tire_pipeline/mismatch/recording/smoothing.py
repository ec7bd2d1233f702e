"""Sensor noise off the model's inputs: local polynomials as wide as the signal allows.

Noise of a slip channel goes through the model into the residual and, worse, into the columns of
dynamic effects: a delay of the wrong sign would explain some of it (errors in variables). Each
sample takes the widest window whose estimate agrees with all narrower ones (intersection of
confidence intervals: Katkovnik 1999, IEEE Trans. Signal Processing 47).
"""

from __future__ import annotations

import numpy as np
import scipy

Array = np.ndarray
_FILTER_WINDOWS = ((9, 4), (15, 4), (25, 4), (35, 4), (61, 2), (121, 2), (241, 2))
"""Samples and order of the polynomials that are tried, from narrow and bent to wide and even."""
_INTERVAL_WIDTH = 1.7
"""Standard deviations to each end of the intervals that have to intersect."""
_AT_SET_POINTS = 0.3
"""Part of second differences that are exactly zero, from which a channel holds its values."""
_NOISE_OF_ROUNDING = 2e-6
"""Noise over the range of a channel below which it is rounding."""
_LEVELS_LOWERED, _LEVELS_AROUND = 30, 21
"""A window is no wider than this percentile of the windows of so many samples about it: one sample that
happens to agree with a wide window does not get it."""
_CALM_STRETCH = 50
"""Samples within which a signal is calm or not."""
_CALM_PART = 0.25
"""Part of such stretches in which the signal itself is calm: sweeps turn, and set points hold."""
_MOST_ALIKE = 0.95
"""Largest correlation from one sample to the next that noise may have: what is more alike moves."""
_NOISE_ONLY = 1.5
"""A channel that spreads no wider than so many times its noise stands still."""


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
        The mean where there is nothing but noise. Unchanged where pieces are shorter than the narrowest
        window, or if the channel has no noise (a set point, or a channel held at a slower rate).
    """
    sigma, rho = _noise(x, start)
    if sigma < 1e-12 or sigma < _NOISE_OF_ROUNDING * float(np.ptp(x)):
        return x
    if np.std(x) < _NOISE_ONLY * sigma:
        return np.full_like(x, np.mean(x))
    firsts = np.flatnonzero(start)
    ends = np.append(firsts[1:], x.size)
    out = x.copy()
    for first, last in zip(firsts, ends, strict=True):
        if last - first > 2 * _FILTER_WINDOWS[0][0]:
            out[first:last] = _piece(x[first:last], sigma, rho)
    return out


def _noise(x: Array, start: Array) -> tuple[float, float]:
    """Size of the noise and its correlation from one sample to the next; zero for a set point."""
    d = x[2:] - 2.0 * x[1:-1] + x[:-2]
    d = d[~(start[2:] | start[1:-1])]
    if d.size < _CALM_STRETCH or np.mean(d == 0.0) > _AT_SET_POINTS:
        return 0.0, 0.0
    rho = _colour(x, start)
    return float(_quiet(np.abs(d)) / scipy.stats.halfnorm.median() / np.sqrt(_bent(rho, 1))), rho


def _bent(rho: float, lag: int) -> float:
    """Variance of second differences at a lag, for noise of unit variance."""
    weights, apart = np.array([1.0, -2.0, 1.0]), lag * scipy.linalg.toeplitz(np.arange(3))
    return float(weights @ rho**apart @ weights)


def _quiet(size: Array) -> float:
    """Lower quartile over stretches of the median: where the signal itself is calm."""
    whole = size[: size.size // _CALM_STRETCH * _CALM_STRETCH].reshape(-1, _CALM_STRETCH)
    return float(np.quantile(np.median(whole if whole.size else size[None], axis=1), _CALM_PART))


def _piece(x: Array, sigma: float, rho: float) -> Array:
    n = x.size
    low = np.full(n, -np.inf)
    high = np.full(n, np.inf)
    level = np.zeros(n, int)
    values = []
    alive = np.ones(n, bool)
    for window, order in ((1, 0), *_FILTER_WINDOWS):
        if window > n // 2:
            break
        value, spread = _polynomial(x, window, order, rho)
        values.append(value)
        half = _INTERVAL_WIDTH * sigma * spread
        low = np.where(alive, np.maximum(low, value - half), low)
        high = np.where(alive, np.minimum(high, value + half), high)
        alive &= low <= high
        level = np.where(alive, len(values) - 1, level)
    level = scipy.ndimage.percentile_filter(level, _LEVELS_LOWERED, _LEVELS_AROUND, mode="nearest")
    return np.choose(level, values)


def _polynomial(x: Array, window: int, order: int, rho: float) -> tuple[Array, float]:
    """Return local polynomial values and their standard deviation for noise of unit variance."""
    if window == 1:
        return x, 1.0
    c = scipy.signal.savgol_coeffs(window, order)
    half = window // 2
    padded = np.concatenate([2.0 * x[0] - x[half:0:-1], x, 2.0 * x[-1] - x[-2 : -half - 2 : -1]])
    value = np.convolve(padded, c[::-1], mode="valid")
    lag = np.abs(np.subtract.outer(np.arange(window), np.arange(window)))
    spread = float(np.sqrt(max(c @ (rho**lag) @ c, 1e-12)))
    return value, spread


def _colour(x: Array, start: Array) -> float:
    """Correlation of neighbours, from second differences at lags 1 and 2."""
    piece = np.cumsum(start)
    sizes = []
    for lag in (1, 2):
        d = x[: -2 * lag] - 2.0 * x[lag:-lag] + x[2 * lag :]
        ok = piece[2 * lag :] == piece[: -2 * lag]
        sizes.append(_quiet(np.abs(d[ok])) ** 2 if ok.any() else 0.0)
    return correlation_from_ratio(sizes[1] / sizes[0]) if sizes[0] > 0.0 else 0.0


def correlation_from_ratio(ratio: float) -> float:
    """Correlation of neighbours from the ratio of squared second differences at lags 2 and 1."""

    def excess(rho: float) -> float:
        return _bent(rho, 2) / _bent(rho, 1) - ratio

    if ratio <= 1.0:
        return 0.0
    most = _MOST_ALIKE
    return most if excess(most) < 0.0 else float(scipy.optimize.brentq(excess, 0.0, most))
