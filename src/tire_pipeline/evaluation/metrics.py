"""Mean squared errors between curves (thesis, section 4.5.5)."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError

from .curves import Curves

# metric -> the curve it compares; the first three are the thesis' own
METRIC_CURVES: dict[str, str] = {
    "forces": "fy",
    "cornering_stiffness": "cornering_stiffness",
    "peak_friction": "peak_friction",
    "forces_camber": "fy_camber",
    "fx": "fx",
    "mz": "mz",
}
THESIS_METRICS: tuple[str, ...] = ("forces", "cornering_stiffness", "peak_friction")
ALL_METRICS: tuple[str, ...] = tuple(METRIC_CURVES)


def curve_errors(curves: Curves, reference: Curves) -> pd.DataFrame:
    """Mean squared error of each tire's curves to the reference's.

    Parameters
    ----------
    curves, reference : Curves
        n tires each, in the same order, on the same grid. A curve that either lacks is left out.

    Returns
    -------
    pandas.DataFrame
        n rows, a column for each metric that can be had: N^2, (N/rad)^2, 1, N^2, N^2, (N m)^2.

    Raises
    ------
    DomainError
        If numbers of tires or grids differ.
    """
    errors = {}
    for metric, name in METRIC_CURVES.items():
        ours, theirs = getattr(curves, name), getattr(reference, name)
        if ours is None or theirs is None:
            continue
        if ours.shape != theirs.shape:
            raise DomainError(
                f"{name} has shape {ours.shape}, the reference {theirs.shape}",
                where="evaluation",
                todo="compare the same tires on the same grid",
            )
        squares = (ours - theirs) ** 2
        errors[metric] = squares.reshape(len(squares), -1).mean(axis=1)
    return pd.DataFrame({name: np.asarray(values) for name, values in errors.items()})
