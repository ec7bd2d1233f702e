"""How well a model matches measurements, by load and camber."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS, OperatingPoints

LOAD_STEP = 0.25
"""Points are grouped by load in steps of this part of the nominal load."""
_CAMBER_STEP = np.deg2rad(1.0)


def _residuals(
    model: TireModel, points: Mapping[str, np.ndarray], forces: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray]:
    at = OperatingPoints(**{name: points[name] for name in POINT_CHANNELS})
    computed = model.forces(at, limits="ignore", outputs=tuple(forces))
    return {name: getattr(computed, name) - measured for name, measured in forces.items()}


def relative_rms(
    model: TireModel, points: Mapping[str, np.ndarray], forces: Mapping[str, np.ndarray]
) -> dict[str, float]:
    """Return, for each output, the RMS of model minus measurement over the largest magnitude measured."""
    found = {}
    for name, residual in _residuals(model, points, forces).items():
        rms = float(np.sqrt(np.nanmean(residual**2)))
        found[name] = rms / float(np.nanmax(np.abs(forces[name])))
    return found


def residual_table(
    model: TireModel, points: Mapping[str, np.ndarray], forces: Mapping[str, np.ndarray]
) -> pd.DataFrame:
    """Return count, bias, RMS and largest residual for each output, load and camber.

    Loads are grouped in steps of a quarter of the nominal load, camber in steps of a degree; both columns
    hold the middle of the group.
    """
    step = LOAD_STEP * model.value("FNOMIN")
    parts = []
    for name, residual in _residuals(model, points, forces).items():
        frame = pd.DataFrame(
            {
                "output": name,
                "normal_load": np.round(points["normal_load"] / step) * step,
                "camber": np.round(points["camber"] / _CAMBER_STEP) * _CAMBER_STEP + 0.0,
                "residual": residual,
            }
        ).dropna()
        grouped = frame.groupby(["output", "normal_load", "camber"])["residual"]
        table = grouped.agg(
            count="size",
            bias="mean",
            rms=lambda r: float(np.sqrt(np.mean(r**2))),
            largest=lambda r: float(np.max(np.abs(r))),
        ).reset_index()
        table["rms_percent"] = 100.0 * table["rms"] / float(np.nanmax(np.abs(forces[name])))
        parts.append(table)
    return pd.concat(parts, ignore_index=True)
