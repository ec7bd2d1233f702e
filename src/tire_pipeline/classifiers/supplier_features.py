"""Features that identify a supplier: curves, coefficients that are not fitted, stated conditions."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula.parameters.coefficients import FAMILIES, SCALE_FACTORS
from tire_pipeline.representations.coefficients import DATASETS

STATED = ("LONGVL", "ALPMIN", "ALPMAX", "KPUMIN", "KPUMAX", "CAMMIN", "CAMMAX")
"""Reference speed and ranges of the test, as the file states them."""

QUOTIENTS = (("FZMIN", "FZMAX"), ("INFLPRES", "NOMPRES"))
"""Pairs of which the supplier chooses the ratio."""


def supplier_features(table: pd.DataFrame) -> tuple[np.ndarray, list[str]]:
    """Return the features that identify a supplier, one row a file.

    The coefficients of the pure slip forces and the aligning torque; which of them are exactly zero, because
    the supplier does not fit them; scale factors; the stated ranges and speed, the load range and the test
    pressure as shares, and whether they are stated; the version. Nothing of it says how large the tire is.

    Parameters
    ----------
    table : DataFrame
        n files at one nominal load (:func:`.tire_table.normalize_table`).

    Returns
    -------
    features : ndarray, shape (n, d)
        Finite. A coefficient that is not there counts as its equations count it: 0, a scale factor 1.
    names : list of str
        d of them.
    """
    coefficients = _numbers(table, DATASETS["full"]).fillna(0.0)
    stated = _numbers(table, STATED)
    for low, high in QUOTIENTS:
        ends = _numbers(table, (low, high))
        stated[f"{low}/{high}"] = ends[low] / ends[high].where(ends[high] != 0.0)
    stated = stated.where(np.isfinite(stated))
    version = table["version"].astype(str) if "version" in table else pd.Series("5.2", index=table.index)
    parts = [
        coefficients,
        (coefficients == 0.0).add_suffix(" = 0"),
        _numbers(table, tuple(SCALE_FACTORS)).fillna(1.0),
        stated.fillna(0.0),
        stated.isna().add_suffix(" not stated"),
        pd.DataFrame({f"version {name}": version == name for name in FAMILIES}, index=table.index),
    ]
    joined = pd.concat(parts, axis=1).astype(float)
    return joined.to_numpy(), list(joined.columns)


def _numbers(table: pd.DataFrame, names: tuple[str, ...]) -> pd.DataFrame:
    return table.reindex(columns=list(names)).astype(float)
