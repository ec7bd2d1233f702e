"""Baseline: sparse identification (PySINDy) of the residual from channels times model forces.

Sequentially thresholded least squares (Brunton, Proctor and Kutz, 2016) knows no effects; a term
gets the name of the channel in it.
"""

from __future__ import annotations

import warnings

import numpy as np
import pandas as pd

from tire_pipeline.channels import OPERATING_CHANNELS
from tire_pipeline.concealed.baselines.regressors import Scene, look_at
from tire_pipeline.concealed.baselines.report import (
    BaselineReport,
    effect_entry,
    fit_entry,
    noise_floor,
)
from tire_pipeline.concealed.cases.clean_run import residual
from tire_pipeline.magic_formula import TireModel

_NAME_OF = {
    "constant": "force_offset",
    "force": "friction_scale",
    "by_angle": "slip_angle_offset",
    "normal_load": "load_sensitivity",
    "camber": "camber",
    "slip_ratio": "combined_slip",
    "speed": "speed_dependence",
    "pressure": "inflation_pressure",
    "tread_temperature": "temperature",
    "turn_slip": "turn_slip",
    "angle_rate": "relaxation_length",
    "force_rate": "time_delay",
    "time": "sensor_drift",
}
_NAMED_CHANNELS = tuple(channel for channel in OPERATING_CHANNELS if channel in _NAME_OF)


def explain_sindy(tire: TireModel, recording: pd.DataFrame, *, threshold: float = 0.15) -> BaselineReport:
    """Find a sparse combination of terms for the residual of fy, and name the terms' channels.

    Parameters
    ----------
    tire : TireModel
    recording : pandas.DataFrame
    threshold : float
        Terms whose contribution is below this share of the residual's RMS are dropped.

    Returns
    -------
    BaselineReport
    """
    from pysindy import STLSQ

    left = residual(tire, recording)
    centre = _centres(recording)
    table = _terms(look_at(tire, recording), centre)
    names = list(table)
    matrix = np.column_stack([table[n][1] for n in names])
    size = np.sqrt(np.mean(matrix**2, axis=0)) + 1e-300
    goal = left[:, 1] / np.sqrt(np.mean(left[:, 1] ** 2))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = STLSQ(threshold=threshold, alpha=1e-3).fit(matrix / size, goal[:, None]).coef_[0]
    weights = found / size * np.sqrt(np.mean(left[:, 1] ** 2))

    def correction(frame: pd.DataFrame) -> np.ndarray:
        terms = _terms(look_at(tire, frame), centre)
        out = np.zeros((len(frame), 2))
        for name, weight in zip(names, weights, strict=True):
            if weight != 0.0 and name in terms:
                out[:, 1] += weight * terms[name][1]
        return out

    parts: dict[str, np.ndarray] = {}
    for name, weight in zip(names, weights, strict=True):
        if weight != 0.0:
            effect, column = table[name]
            parts[effect] = parts.get(effect, np.zeros_like(left))
            parts[effect][:, 1] += weight * column
    noise = float(noise_floor(left)[1])
    effects = [effect_entry(n, p, recording, noise, 0.9) for n, p in parts.items()]
    fit = fit_entry(left, left - correction(recording))
    return BaselineReport(tire, "explained" if effects else "agrees", effects, fit, correction)


def _centres(frame: pd.DataFrame) -> dict[str, tuple[float, float]]:
    """Centre and extent of the channels that move."""
    out = {}
    for channel in _NAMED_CHANNELS:
        if channel in frame:
            low, high = np.quantile(frame[channel], [0.01, 0.99])
            floor = 0.05 * abs(high + low) + 1e-2
            if high - low > floor or channel == "tread_temperature":
                out[channel] = (float(0.5 * (low + high)), float(0.5 * (high - low)) or 1.0)
    return out


def _terms(scene: Scene, centre: dict[str, tuple[float, float]]) -> dict[str, tuple[str, np.ndarray]]:
    """Term -> (effect that its channel stands for, column for fy)."""
    frame = scene.frame
    fy, slope = scene.force[:, 1], scene.by_angle[:, 1]
    terms = {
        "1": (_NAME_OF["constant"], np.ones_like(fy)),
        "fy": (_NAME_OF["force"], fy),
        "dfy/dalpha": (_NAME_OF["by_angle"], slope),
    }
    for channel, (middle, extent) in centre.items():
        z = (frame[channel].to_numpy() - middle) / extent
        for label, base in (("fy", fy), ("dfy/dalpha", slope)):
            terms[f"{channel} {label}"] = (_NAME_OF[channel], z * base)
    if "turn_slip" in frame:
        turn = frame["turn_slip"].to_numpy()
        terms["turn_slip"] = (_NAME_OF["turn_slip"], turn * frame["normal_load"].to_numpy())
    if "time" in frame:
        time = frame["time"].to_numpy()
        dt = np.gradient(time)
        speed = np.maximum(frame["speed"].to_numpy(), 0.5)
        rate = np.gradient(frame["slip_angle"].to_numpy()) / dt
        terms["rate/speed"] = (_NAME_OF["angle_rate"], slope * rate / speed)
        terms["rate"] = (_NAME_OF["force_rate"], np.gradient(fy) / dt)
        terms["time"] = (_NAME_OF["time"], time)
    return terms
