"""The ranges for which a fitted model is valid: those of the measurement."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.coefficients import RANGE_KEYS

_NOISE = {"slip_angle": np.deg2rad(0.5), "camber": np.deg2rad(0.5), "slip_ratio": 0.01}
"""Spans up to which an input was not varied: the angles of rigs stray by some hundredths of a degree."""


def with_measured_ranges(model: TireModel, measured: pd.DataFrame | None) -> TireModel:
    """Return the model with the ranges of the points that it was fitted to.

    Parameters
    ----------
    model : TireModel
    measured : DataFrame, optional
        ``FitResult.measured``: slips and camber (rad, slip ratio without a unit), normal load (N), pressure
        (Pa).

    Returns
    -------
    TireModel
        With ``ALPMIN``, ``ALPMAX`` and so on for each input that varies. One at a single value states no
        range, nor does the noise of a slip or camber at one: a simulator would clip everything else to it.

    Examples
    --------
    >>> tire = TireModel.from_coefficients({"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2})
    >>> points = pd.DataFrame({"normal_load": [2000.0, 6000.0], "camber": [0.0, 0.0]})
    >>> with_measured_ranges(tire, points).ranges["normal_load"][2:]
    (2000.0, 6000.0)
    """
    ranges: dict[str, float] = {}
    for name, keys in RANGE_KEYS.items():
        values = measured[name].to_numpy(float) if measured is not None and name in measured else np.empty(0)
        values = values[np.isfinite(values)]
        if (
            values.size
            and np.ptp(values) > _NOISE.get(name, 0.0)
            and (name != "pressure" or model.family == 6)
        ):
            ranges |= dict(zip(keys, (float(values.min()), float(values.max())), strict=True))
    return model.replace(**ranges)
