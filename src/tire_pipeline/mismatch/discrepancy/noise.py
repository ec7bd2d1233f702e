"""Noise of the force channels: size from second differences, colour from their growth with lag."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.mismatch.effects.shared import njit
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray
_MEDIAN_OF_CHI2 = 0.4549
_NOISE_ORDER = 12
_LAGS_IN_SAMPLES = (1, 2, 3, 4, 6, 8, 11)


def white_noise(x: Array) -> float:
    """Size of white noise from second differences, by their median; NaN for fewer than three values."""
    d = np.diff(x, 2)
    return float(np.median(np.abs(d)) / 0.6745 / np.sqrt(6.0)) if d.size else float("nan")


@dataclass(frozen=True)
class ForceNoise:
    """Noise of one output: white and coloured part, with a size that changes with the slopes.

    Parameters
    ----------
    sigma : ndarray, shape (n,)
        Standard deviation at each sample, N.
    share, rho : float
        Coloured share of the variance, and its correlation from one sample to the next.
    """

    sigma: Array
    share: float
    rho: float

    @property
    def floor(self) -> float:
        """Root mean square of the noise, N."""
        return float(np.sqrt(np.mean(self.sigma**2)))

    @cached_property
    def _filter(self) -> tuple[Array, float]:
        """Prediction-error filter of the noise and the size of its error."""
        if self.share <= 0.0 or self.rho <= 0.0:
            return np.ones(1), 1.0
        c = self.share * self.rho ** np.arange(_NOISE_ORDER + 1)
        c[0] = 1.0
        a = scipy.linalg.solve_toeplitz(c[:_NOISE_ORDER], c[1:])
        return np.r_[1.0, -a], float(np.sqrt(max(1.0 - a @ c[1:], 1e-6)))

    def whiten(self, x: Array, start: Array) -> Array:
        """Return ``x`` (n,) or (n, k) with unit white noise where the model of the noise holds."""
        scaled = x / (self.sigma if x.ndim == 1 else self.sigma[:, None])
        taps, size = self._filter
        if taps.size == 1:
            return scaled
        out = _filtered(np.ascontiguousarray(scaled.reshape(scaled.shape[0], -1)), taps / size)
        out = out.reshape(scaled.shape)
        firsts = np.flatnonzero(start)
        heads = (firsts[:, None] + np.arange(_NOISE_ORDER)[None, :]).ravel()
        heads = heads[heads < x.shape[0]]
        out[heads] = 0.0 if firsts.size * _NOISE_ORDER < 0.05 * x.shape[0] else scaled[heads]
        return out


@njit(cache=True)
def _filtered(x: Array, taps: Array) -> Array:
    """Filter the columns of x, shape (n, k), by a finite impulse response that begins at rest."""
    n, k = x.shape
    out = np.empty_like(x)
    for j in range(k):
        column = x[:, j].copy()
        total = taps[0] * column
        for m in range(1, taps.size):
            for i in range(m, n):
                total[i] += taps[m] * column[i - m]
        out[:, j] = total
    return out


def estimate_noise(data: Data, residual: dict[str, Array]) -> dict[str, ForceNoise]:
    """Estimate the noise of each output from second differences of what the model leaves.

    Parameters
    ----------
    data : Data
    residual : dict of ndarray
        Recorded minus simulated, N.

    Returns
    -------
    dict of ForceNoise
        The variance is ``s0^2 + (dF/d slip angle)^2 sa^2 + (dF/d slip ratio)^2 sk^2``: noise of the
        slip channels comes through the slopes of the model. Known standard deviations
        (``fy_std``, ``slip_angle_std``) are added.
    """
    slopes = {n: data.slope(n, h) for n, h in (("slip_angle", 2e-3), ("slip_ratio", 2e-3))}
    out = {}
    for name, r in residual.items():
        parts = [np.ones(data.size), slopes["slip_angle"][name] ** 2, slopes["slip_ratio"][name] ** 2]
        largest = float(np.quantile(np.abs(data.recorded[name]), 0.999))
        if data.time is None or data.size < 200:
            sigma, share, rho = _points(data, r, largest), 0.0, 0.0
        else:
            sigma, share, rho = _series(data, r, parts)
        sigma = np.maximum(sigma, 1e-4 * largest + 1e-9)
        known = _known(data, name, slopes["slip_angle"][name])
        out[name] = ForceNoise(np.sqrt(sigma**2 + known**2), share, rho)
    return out


def _series(data: Data, r: Array, parts: list[Array]) -> tuple[Array, float, float]:
    """Size by least squares on block medians of squared second differences; colour by their lag."""
    length = 50
    count = max(r.size // length, 4)
    block = np.minimum(np.arange(r.size) // length, count - 1)
    sizes = []
    for lag in _LAGS_IN_SAMPLES:
        d, ok = _second_difference(r, data.start, lag)
        sizes.append(_block_median(d**2, ok, block, count) / _MEDIAN_OF_CHI2)
    d1 = sizes[0]
    means = np.column_stack([_block_mean(p, block, count) for p in parts])
    good = np.all(np.isfinite(sizes), axis=0) & (d1 > 0.0)
    if good.sum() < 4:
        return np.full(r.size, max(float(np.std(np.diff(r))) / np.sqrt(2.0), 1e-9)), 0.0, 0.0
    growth = np.array([np.median(s[good] / d1[good]) for s in sizes])
    share, rho = _colour(growth)
    per_variance = _expected(share, rho, 1)
    weight = np.ones(good.sum())
    scale = means[good].max(axis=0)
    scale[scale <= 0.0] = 1.0
    a, b = means[good] / scale, d1[good] / per_variance
    for _ in range(8):
        x, _ = scipy.optimize.nnls(a * weight[:, None], b * weight)
        fit = np.maximum(a @ x, 1e-12 * b.max() + 1e-30)
        weight = 1.0 / fit / (1.0 + np.maximum(b / fit - 1.0, 0.0) ** 2)
    variance = np.column_stack(parts) / scale @ x
    floor = 0.02 * float(np.median(b))
    return np.sqrt(np.maximum(variance, floor)), share, rho


def _expected(share: float, rho: float, lag: int) -> float:
    """Mean square of the second difference at a lag, for noise of unit variance."""
    return 6.0 - 8.0 * share * rho**lag + 2.0 * share * rho ** (2 * lag)


def _colour(growth: Array) -> tuple[float, float]:
    """Coloured share and correlation that let second differences grow with lag as they do."""
    best = (np.inf, 0.0, 0.0)
    weight = 1.0 / np.array(_LAGS_IN_SAMPLES) ** 0.5
    for rho in (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.93):
        for share in np.linspace(0.0, 1.0, 21):
            model = np.array([_expected(share, rho, k) for k in _LAGS_IN_SAMPLES])
            error = float(np.sum(weight * (np.log(growth) - np.log(model / model[0])) ** 2))
            best = min(best, (error, float(share), rho))
    return best[1], best[2]


def _second_difference(x: Array, start: Array, lag: int) -> tuple[Array, Array]:
    d = x[: -2 * lag] - 2.0 * x[lag:-lag] + x[2 * lag :]
    piece = np.cumsum(start)
    return d, piece[2 * lag :] == piece[: -2 * lag]


def _block_median(values: Array, ok: Array, block: Array, count: int) -> Array:
    out = np.full(count, np.nan)
    order = block[: values.size]
    edges = np.searchsorted(order, np.arange(count + 1))
    for k in range(count):
        piece = values[edges[k] : edges[k + 1]][ok[edges[k] : edges[k + 1]]]
        if piece.size >= 10:
            out[k] = np.median(piece)
    return out


def _block_mean(values: Array, block: Array, count: int) -> Array:
    return np.bincount(block, values, count) / np.maximum(np.bincount(block, minlength=count), 1)


def _points(data: Data, r: Array, largest: float) -> Array:
    """Scatter between nearest neighbours of the operating space; at least 0.3% of the largest force."""
    x = np.column_stack([data.get(n) / max(float(np.ptp(data.get(n))), 1e-9) for n in SLIP_AND_LOAD])
    distance = ((x[:, None, :] - x[None, :, :]) ** 2).sum(axis=2) if r.size <= 3000 else None
    if distance is None:
        return np.full(r.size, max(0.003 * largest, float(np.std(np.diff(r))) / np.sqrt(2.0)))
    np.fill_diagonal(distance, np.inf)
    nearest = np.argmin(distance, axis=1)
    close = distance[np.arange(r.size), nearest] < 1e-4
    repeats = (r - r[nearest])[close]
    sigma = 0.003 * largest
    if repeats.size >= 8:
        sigma = max(sigma, float(np.median(np.abs(repeats))) / 0.6745 / np.sqrt(2.0))
    return np.full(r.size, sigma)


def _known(data: Data, name: str, slope: Array) -> Array:
    """Standard deviations that the recording states itself (inverse models, differentiation), N."""
    variance = np.zeros(data.size)
    if f"{name}_std" in data.channels:
        variance = variance + np.nan_to_num(data.get(f"{name}_std")) ** 2
    if "slip_angle_std" in data.channels:
        variance = variance + (slope * np.nan_to_num(data.get("slip_angle_std"))) ** 2
    return np.sqrt(variance)


def refined(data: Data, noise: ForceNoise, calm: Array) -> ForceNoise:
    """Take size and colour from the correlations of a residual that holds nothing but noise.

    Parameters
    ----------
    data : Data
    noise : ForceNoise
        The first estimate, whose dependence on the slopes is kept.
    calm : ndarray, shape (n,)
        A residual without what any model explains, N. What stays correlated over 40 samples is no noise, and
        is taken off the size.
    """
    if data.time is None or calm.size < 500:
        return noise
    x = calm / noise.sigma
    spread = float(np.sqrt(np.median(x**2) / _MEDIAN_OF_CHI2))
    x = np.clip(x, -4.0 * spread, 4.0 * spread)
    variance = float(np.mean(x**2))
    piece = np.cumsum(data.start)

    def correlation(lag: int) -> float:
        same = piece[lag:] == piece[:-lag]
        return float(np.mean((x[lag:] * x[:-lag])[same])) / variance if same.any() else 0.0

    lags = np.array([1, 2, 3, 4, 6, 8, 12, 20, 40])
    seen = np.array([correlation(int(k)) for k in lags])
    best = (np.inf, 0.0, 0.0, 0.0)
    for rho in (0.0, *np.linspace(0.2, 0.95, 26)):
        (share, slow), error = scipy.optimize.nnls(np.column_stack([rho**lags, np.ones(lags.size)]), seen)
        if share + slow <= 1.0:
            best = min(best, (float(error), float(share), float(rho), float(slow)))
    _, share, rho, slow = best
    share, variance = share / max(1.0 - slow, 1e-6), variance * (1.0 - slow)
    scale = float(np.clip(np.sqrt(variance), 0.6, 1.7))
    return ForceNoise(noise.sigma * scale, min(share, 1.0), rho)
