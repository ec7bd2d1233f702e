"""90% bands of curves, from the variances of scores."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.translation.curves.features import LOADS, REDUCED, encode
from tire_pipeline.translation.curves.pure_slip import (
    Points,
    aligning_torque,
    columns,
    lateral_force,
    longitudinal_force,
)
from tire_pipeline.translation.curves.space import PARTS, UNIT, CurveSpace
from tire_pipeline.translation.result import Band

BAND_SLIP_RATIOS = np.linspace(-0.2, 0.2, 41)
"""Slip angles (rad) and slip ratios of the bands."""

BAND_QUANTILE = 1.6449 * 1.04
"""Standard deviations to either side of the middle: those that hold 90% of a Gaussian, and 4% more, since the
variances are estimates and the errors have longer tails (found on tuning tires)."""

_TORQUE = {True: 1.08, False: 1.30}
"""How much wider still those of the aligning torque are, with and without tires that several categories
measured: its fits go astray more often, and without such tires nothing tells by how much. So that on tuning
tires the bands hold 90% in the mean of the fleets."""

_REST_SHARE = 1.0  # variance of what the scores leave out, over that of the same between tires
_LIMIT_DEVIATIONS = 4.0  # CurveSpace.limit is in these deviations


def curve_bands(
    space: CurveSpace, translated: pd.DataFrame, variance: np.ndarray, changed: np.ndarray, *, pairs: bool
) -> dict[str, Band]:
    """Return the bands of lateral force, longitudinal force and aligning torque at zero camber.

    Parameters
    ----------
    space : CurveSpace
    translated : DataFrame
        n translated tires.
    variance : ndarray, shape (n, p)
        Of the target's scores about the translated ones.
    changed : ndarray of bool, shape (n,)
        Files that were translated; the others have no band (NaN).
    pairs : bool
        Whether tires that several categories measured told what one tire does in one category alone.

    Returns
    -------
    dict of str to Band
        ``fy``, ``fx``, ``mz``.

    Notes
    -----
    At a fixed slip, d ln F = d shape + (1 - eta) d level + eta d slope with eta = d ln F / d ln slip: linear
    in
    the features, and so in the independent scores.
    """
    p = columns(translated)
    features = encode(translated)
    points = Points.grid(BAND_SLIP_RATIOS, LOADS, [0.0])
    shape = (len(translated), LOADS.size, BAND_SLIP_RATIOS.size)
    side = {
        "fy": (lateral_force(p, points), _force_deviation(space, features, variance, "lateral")),
        "fx": (longitudinal_force(p, points), _force_deviation(space, features, variance, "longitudinal")),
        "mz": (
            aligning_torque(p, points),
            _TORQUE[pairs] * _torque_deviation(space, features, variance, p["UNLOADED_RADIUS"]),
        ),
    }
    bands = {}
    for name, (middle, deviation) in side.items():
        middle = middle.reshape(shape)
        half = np.where(changed[:, None, None], BAND_QUANTILE * deviation, np.nan)
        bands[name] = Band(BAND_SLIP_RATIOS, LOADS, middle, middle - half, middle + half)
    return bands


def stiffness_band(
    space: CurveSpace, translated: pd.DataFrame, variance: np.ndarray, changed: np.ndarray
) -> Band:
    """Return the band of the cornering stiffness over load at zero camber.

    Parameters
    ----------
    space, translated, variance, changed
        As for :func:`curve_bands`.

    Returns
    -------
    Band
        With one slip, 0; N/rad, positive.
    """
    features = encode(translated)
    (stiffness, *_) = _part_names("lateral")
    weights = {stiffness: np.broadcast_to(np.eye(LOADS.size), (len(translated), LOADS.size, LOADS.size))}
    deviation = BAND_QUANTILE * _linear_deviation(space, variance, weights)
    middle = np.exp(features["lateral"][:, : LOADS.size]) * LOADS
    ratio = np.where(changed[:, None], np.exp(deviation), np.nan)
    parts = [each[:, :, None] for each in (middle, middle / ratio, middle * ratio)]
    return Band(np.zeros(1), LOADS, *parts)


def _part_names(group: str) -> list[str]:
    return [name for name, part in PARTS.items() if part.group == group]


def _linear_deviation(space: CurveSpace, variance: np.ndarray, weights: dict[str, np.ndarray]) -> np.ndarray:
    """Deviation of weighted sums of features; ``weights`` by part, (n, q, d of the part) in features."""
    total = 0.0
    for name, weight in weights.items():
        unit = UNIT[PARTS[name].group]
        along = weight @ space.back[name].T * unit
        total = total + (along**2 @ variance[:, space.slices[name], None])[..., 0]
        left = (space.limit[name] / _LIMIT_DEVIATIONS * unit) ** 2 * _REST_SHARE
        total = total + (weight**2) @ left
    return np.sqrt(total)


def _plane(values: np.ndarray) -> np.ndarray:
    return values.reshape(len(values), LOADS.size, REDUCED.size)


def _slope_along(values: np.ndarray) -> np.ndarray:
    return np.gradient(values, np.log(REDUCED), axis=2)


def _force_deviation(
    space: CurveSpace, features: dict[str, np.ndarray], variance: np.ndarray, group: str
) -> np.ndarray:
    stiffness, friction, form = _part_names(group)
    own = features[group]
    count, loads, steps = len(own), LOADS.size, REDUCED.size
    slope, level = np.exp(own[:, :loads]), np.exp(own[:, loads : 2 * loads])
    shape = _plane(own[:, 2 * loads : 2 * loads + loads * steps])
    eta = np.clip(_slope_along(shape), 0.0, 1.0)
    size = np.exp(shape)
    by_part = {stiffness: size * eta, friction: size * (1.0 - eta)}
    deviations = []
    for sign in (-1.0, 1.0):
        weights = {name: np.zeros((count, loads * steps, loads)) for name in by_part}
        weights[form] = np.zeros((count, loads * steps, 2 * loads * steps))
        for k in range(loads):
            rows = slice(k * steps, (k + 1) * steps)
            for name, weight in by_part.items():
                weights[name][:, rows, k] = weight[:, k]
            at = np.arange(k * steps, (k + 1) * steps)
            weights[form][:, at, at] = size[:, k]
            weights[form][:, at, at + loads * steps] = sign
        deviations.append(_plane(_linear_deviation(space, variance, weights)))
    return _to_slips(deviations, level / slope, level * LOADS)


def _torque_deviation(
    space: CurveSpace, features: dict[str, np.ndarray], variance: np.ndarray, radius: np.ndarray
) -> np.ndarray:
    lateral, own = features["lateral"], features["aligning"]
    count, loads, steps = len(own), LOADS.size, REDUCED.size
    slope, level = np.exp(lateral[:, :loads]), np.exp(lateral[:, loads : 2 * loads])
    odd = _plane(own[:, : loads * steps])
    along = _slope_along(odd)
    stiffness, friction, _ = _part_names("lateral")
    (torque,) = _part_names("aligning")
    width = own.shape[1]
    deviations = []
    for sign in (-1.0, 1.0):
        weights = {name: np.zeros((count, loads * steps, loads)) for name in (stiffness, friction)}
        weights[torque] = np.zeros((count, loads * steps, width))
        for k in range(loads):
            rows = slice(k * steps, (k + 1) * steps)
            weights[stiffness][:, rows, k] = along[:, k]
            weights[friction][:, rows, k] = odd[:, k] - along[:, k]
            at = np.arange(k * steps, (k + 1) * steps)
            weights[torque][:, at, at] = 1.0
            weights[torque][:, at, at + loads * steps] = sign
        deviations.append(_plane(_linear_deviation(space, variance, weights)))
    return _to_slips(deviations, level / slope, level * LOADS * radius)


def _to_slips(deviations: list[np.ndarray], reach: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """From reduced slips to both sides to ``BAND_SLIP_RATIOS``, times the scale; (n, loads, slips)."""
    negative, positive = deviations
    out = np.empty((*reach.shape, BAND_SLIP_RATIOS.size))
    for i in range(reach.shape[0]):
        for k in range(reach.shape[1]):
            at = REDUCED * reach[i, k]
            both = np.concatenate([-at[::-1], at])
            values = np.concatenate([negative[i, k, ::-1], positive[i, k]])
            out[i, k] = np.interp(BAND_SLIP_RATIOS, both, values)
    return out * scale[:, :, None]
