"""A form without an equation for the residual: a Gaussian process over the channels in which it lives."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from threadpoolctl import threadpool_limits

from tire_pipeline.channels import INPUT_CHANNELS
from tire_pipeline.mismatch.model.channels import span
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.residual import share_above_noise

if TYPE_CHECKING:
    from sklearn.gaussian_process import GaussianProcessRegressor

Array = np.ndarray
_CHANNELS_WITH_RATE = ("slip_angle", "slip_ratio", "normal_load")
_POINTS = 250
"""Samples of each part: the fit takes time in proportion to their cube."""
_LONGEST_LENGTH = 3.0
_LEAST_LOG_EVIDENCE = 3.0


@dataclass(frozen=True)
class GaussianForm:
    """A Gaussian process for the residual of one output; it has no name.

    Parameters
    ----------
    output : str
    size, noise : float
        Its standard deviation, and that of the white noise beside it, N.
    lengths : dict
        Channel (or ``rate of <channel>``, per second) -> length over which it changes, SI.
    explained : float
        Share of the residual, as a square, that it predicts on sweeps left out of its fit.
    recovered : float
        The same of the residual above the noise.
    points : int
        Samples it was fitted to.
    """

    output: str
    size: float
    noise: float
    lengths: dict[str, float]
    explained: float
    recovered: float
    points: int


def gaussian_form(data: Data, rest: Array, output: str, block: Array, floor: float) -> GaussianForm | None:
    """Fit a Gaussian process to the residual of one output, and test it on sweeps left out.

    Parameters
    ----------
    data : Data
    rest : ndarray, shape (n,)
        Recorded minus corrected force, N.
    output : str
    block : ndarray of int, shape (n,)
        Sweep of each sample; every third sweep is left out of the fit.
    floor : float
        Noise, N.

    Returns
    -------
    GaussianForm or None
        None if no channel varies.

    Notes
    -----
    Squared-exponential kernel with one length scale a channel plus white noise (Rasmussen and Williams,
    Gaussian Processes for Machine Learning, 2006, 5.1), on 250 samples drawn from the other sweeps. Channels
    whose length scale is over three times their range are taken out again, and so are those without which
    the likelihood falls by less than three.
    """
    names, x = _inputs(data)
    held = block % 3 == 1
    if not names or held.all() or not held.any():
        return None
    rng = np.random.default_rng(0)
    train = _some(np.flatnonzero(~held), _POINTS, rng)
    test = _some(np.flatnonzero(held), _POINTS, rng)
    size = float(np.std(rest[train])) or 1.0
    live, process = _chosen(x[train], rest[train] / size)
    lengths = np.atleast_1d(process.kernel_.k1.k2.length_scale)
    left = rest[test] - size * process.predict(x[test][:, live])
    total = float(np.mean(rest[test] ** 2))
    after = float(np.mean(left**2))
    ranges = _ranges(data, names)
    return GaussianForm(
        output=output,
        size=size * float(np.sqrt(process.kernel_.k1.k1.constant_value)),
        noise=size * float(np.sqrt(process.kernel_.k2.noise_level)),
        lengths={names[k]: float(length * ranges[k]) for k, length in zip(live, lengths, strict=True)},
        explained=float(np.clip((total - after) / total, -1.0, 1.0)) if total > 0.0 else float("nan"),
        recovered=share_above_noise(total, after, floor),
        points=int(train.size),
    )


def _chosen(x: Array, y: Array) -> tuple[list[int], GaussianProcessRegressor]:
    """Return the channels that matter and the process over them."""
    live = list(range(x.shape[1]))
    process = _fit(x, y)
    lengths = np.atleast_1d(process.kernel_.k1.k2.length_scale)
    near = [k for k in live if lengths[k] < _LONGEST_LENGTH] or [int(np.argmin(lengths))]
    if len(near) < len(live):
        live, process = near, _fit(x[:, near], y)
    lengths = np.atleast_1d(process.kernel_.k1.k2.length_scale)
    for k in [live[i] for i in np.argsort(-lengths)]:
        fewer = [j for j in live if j != k]
        if not fewer:
            break
        trial = _fit(x[:, fewer], y)
        fall = process.log_marginal_likelihood_value_ - trial.log_marginal_likelihood_value_
        if fall < _LEAST_LOG_EVIDENCE:
            live, process = fewer, trial
    return live, process


def _some(rows: Array, most: int, rng: np.random.Generator) -> Array:
    return rows if rows.size <= most else np.sort(rng.choice(rows, most, replace=False))


def _fit(x: Array, y: Array) -> GaussianProcessRegressor:
    # Slow to import, and most reports need none.
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    kernel = ConstantKernel() * RBF(np.ones(x.shape[1])) + WhiteKernel()
    with warnings.catch_warnings(), threadpool_limits(1):
        warnings.simplefilter("ignore", ConvergenceWarning)
        return GaussianProcessRegressor(kernel, normalize_y=False, random_state=0).fit(x, y)


def _columns(data: Data) -> dict[str, Array]:
    out = {n: data.smooth(n) for n in INPUT_CHANNELS if data.varies(n)}
    if data.time is not None:
        step = np.maximum(data.step, 1e-9)
        for n in _CHANNELS_WITH_RATE:
            if n in out:
                rate = np.diff(out[n], prepend=out[n][0]) / step
                rate[data.start] = 0.0
                low, high = span(rate)
                if high > low:
                    out[f"rate of {n}"] = np.clip(rate, low, high)
    return out


def _inputs(data: Data) -> tuple[list[str], Array]:
    """Channels that vary and the rates of the inputs, each over its range."""
    columns = _columns(data)
    names = list(columns)
    if not names:
        return [], np.zeros((data.size, 0))
    ranges = _ranges(data, names, columns)
    return names, np.column_stack([columns[n] / r for n, r in zip(names, ranges, strict=True)])


def _ranges(data: Data, names: list[str], columns: dict[str, Array] | None = None) -> list[float]:
    columns = _columns(data) if columns is None else columns
    return [max(float(np.ptp(span(columns[n]))), 1e-12) for n in names]
