"""Noise of the force channels: size from differences of neighbours, colour from correlations.

Noise of unit variance has the correlation ``share rho^k`` over k samples: a white part, and one that
follows the sample before (an autoregressive moving average of order 1, 1: Box and Jenkins, Time Series
Analysis, 3.4).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.mismatch.model.channels import largest, white_noise
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray
AS_STORED = 1e-5
"""Noise below this part of the largest force is rounding, of five printed digits. With less, the matrices of
exact simulations would be singular."""


@dataclass(frozen=True)
class ForceNoise:
    """Noise of one output: white and coloured part.

    Parameters
    ----------
    sigma : ndarray, shape (n,)
        Standard deviation at each sample, N.
    share, rho : float
        Coloured share of the variance, and its correlation from one sample to the next.
    """

    sigma: Array
    share: float = 0.0
    rho: float = 0.0

    @property
    def floor(self) -> float:
        """Root mean square of the noise, N."""
        return float(np.sqrt(np.mean(self.sigma**2)))

    @cached_property
    def _filter(self) -> tuple[Array, Array]:
        """Numerator and denominator of the filter that turns the noise into white noise of unit variance.

        The noise less ``rho`` times the noise before is a moving average of order one: ``variance`` and
        ``beside`` are its covariances over no and one sample.
        """
        variance = max(1.0 + self.rho**2 - 2.0 * self.share * self.rho**2, 1e-6)
        beside = self.rho * (1.0 - self.share)
        ratio = 2.0 * beside / variance
        theta = ratio / (1.0 + np.sqrt(1.0 - min(ratio, 1.0) ** 2))
        size = np.sqrt(variance / (1.0 + theta**2))
        return np.array([1.0, -self.rho]) / size, np.array([1.0, -theta])

    def whiten(self, x: Array, start: Array) -> Array:
        """Return ``x`` (n,) or (n, k) with unit white noise where the model of the noise holds."""
        scaled = x / (self.sigma if x.ndim == 1 else self.sigma[:, None])
        if self.share * self.rho == 0.0:
            return scaled
        firsts = np.flatnonzero(start)
        pieces = np.split(scaled, firsts[firsts > 0])
        white = np.concatenate([scipy.signal.lfilter(*self._filter, piece, axis=0) for piece in pieces])
        white[firsts] = scaled[firsts]
        return white


def estimate_noise(data: Data, residual: dict[str, Array], *, stated: bool = True) -> dict[str, ForceNoise]:
    """Estimate the size of the noise of each output from the residual, as if it were white.

    Parameters
    ----------
    data : Data
    residual : dict of ndarray
        Recorded minus simulated, N.
    stated : bool
        Whether standard deviations that the recording states (``fy_std``, ``slip_angle_std``) are added.

    Returns
    -------
    dict of ForceNoise
    """
    out = {}
    for name, r in residual.items():
        seen = white_noise(r) if data.time is not None else _between_neighbours(data, r)
        known = _known(data, name) if stated else np.zeros(data.size)
        least = AS_STORED * largest(data.recorded[name]) + 1e-9
        out[name] = ForceNoise(np.sqrt(max(seen, least) ** 2 + known**2))
    return out


def _between_neighbours(data: Data, r: Array) -> float:
    """Return the scatter of a residual between nearest neighbours of the operating space, N."""
    x = np.column_stack([data.get(n) / max(float(np.ptp(data.get(n))), 1e-9) for n in SLIP_AND_LOAD])
    _, nearest = scipy.spatial.cKDTree(x).query(x, k=2)
    scatter = scipy.stats.median_abs_deviation(r - r[nearest[:, 1]], scale="normal")
    return float(scatter) / np.sqrt(2.0)


def _known(data: Data, name: str) -> Array:
    """Standard deviations that the recording states itself (inverse models, differentiation), N."""
    variance = np.zeros(data.size)
    if f"{name}_std" in data.channels:
        variance = variance + np.nan_to_num(data.get(f"{name}_std")) ** 2
    if "slip_angle_std" in data.channels:
        slope = data.simulation.slope("slip_angle")[name]
        variance = variance + (slope * np.nan_to_num(data.get("slip_angle_std"))) ** 2
    return np.sqrt(variance)


def refined(data: Data, noise: ForceNoise, calm: Array) -> ForceNoise:
    """Take size and colour from the correlations of a residual that holds nothing but noise.

    Parameters
    ----------
    data : Data
    noise : ForceNoise
        The first estimate.
    calm : ndarray, shape (n,)
        A residual without what any model explains, N. What stays correlated for long is not noise, and is
        subtracted.
    """
    if data.time is None:
        return noise
    x = calm / noise.sigma
    variance = max(float(np.mean(x**2)), 1e-12)
    lags = 2 ** np.arange(int(np.log2(np.sqrt(x.size))))
    piece = np.cumsum(data.start)

    def correlation(lag: int) -> float:
        same = piece[lag:] == piece[:-lag]
        return float(np.mean((x[lag:] * x[:-lag])[same])) / variance if same.any() else 0.0

    seen = np.array([correlation(int(k)) for k in lags])
    most = 0.5 ** (2.0 / lags[-1])  # halved within half of the longest lag
    found = scipy.optimize.least_squares(
        lambda p: p[0] * p[1] ** lags + p[2] - seen, (0.5, 0.5, 0.0), bounds=(0.0, (1.0, most, 1.0))
    )
    share, rho, slow = found.x
    noisy = max(1.0 - slow, 1e-6)
    return ForceNoise(noise.sigma * np.sqrt(variance * noisy), float(min(share / noisy, 1.0)), float(rho))
