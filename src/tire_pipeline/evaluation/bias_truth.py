"""The bias that a translator reports beside the fleet's sealed truth. Only evaluation may read this."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations

import numpy as np
import pandas as pd

from .curves import EvaluationGrid, curves_of


def measured_bias(first: pd.DataFrame, loads: np.ndarray) -> pd.DataFrame:
    """Mean difference between organisations who measured the same evaluation tires.

    Parameters
    ----------
    first : pandas.DataFrame
        Sealed first measurements: ``file`` is ``<set>/<category>/<tire>.tir``; every tire by every category.
    loads : ndarray
        N.

    Returns
    -------
    pandas.DataFrame
        ``organisation``, ``reference``, ``region``, ``true_bias`` (a share) and ``true_error`` (its standard
        error).
    """
    parts = first["file"].str.split("/", expand=True)
    grid = EvaluationGrid(loads=np.asarray(loads), load_axis=np.asarray(loads))
    curves = curves_of(first, grid, lateral_only=True)
    values = {
        "cornering stiffness": np.asarray(curves.cornering_stiffness),
        "friction level": np.asarray(curves.peak_friction),
    }
    rows = []
    for what, array in values.items():
        logs = pd.DataFrame(np.log(array), index=[parts[1], parts[0] + "/" + parts[2]])
        for reference, organisation in combinations(sorted(parts[1].unique()), 2):
            gap = (logs.loc[organisation] - logs.loc[reference]).dropna().to_numpy()
            error = gap.std(axis=0) / np.sqrt(len(gap))
            for load, mean, uncertainty in zip(loads, gap.mean(axis=0), error, strict=True):
                rows.append((organisation, reference, f"{what}, {load:.0f} N", np.expm1(mean), uncertainty))
    return pd.DataFrame(rows, columns=["organisation", "reference", "region", "true_bias", "true_error"])


def bias_beside_truth(by_region: pd.DataFrame, measured: pd.DataFrame) -> pd.DataFrame:
    """Put reported and true bias side by side.

    Parameters
    ----------
    by_region : pandas.DataFrame
        ``translation.bias_report.BiasReport.by_region``.
    measured : pandas.DataFrame
        From :func:`measured_bias`.

    Returns
    -------
    pandas.DataFrame
        Lateral rows of both, with ``inside``: the true bias lies in the reported interval.
    """
    own = by_region[by_region["output"] == "lateral"]
    both = own.merge(measured, on=["organisation", "reference", "region"])
    return both.assign(inside=(both["true_bias"] >= both["low"]) & (both["true_bias"] <= both["high"]))


def regime_differences(
    regimes: Mapping[str, Mapping[str, float]], organisation: str, reference: str
) -> pd.DataFrame:
    """List what two organisations' true protocols do differently (surface, temperature, drum, lag, ranges).

    Parameters
    ----------
    regimes : mapping
        The truth's regimes, by ``category/protocol``.
    organisation, reference : str

    Returns
    -------
    pandas.DataFrame
        ``field``, ``organisation``, ``reference`` for each field that differs.
    """
    ours, theirs = regimes[f"{organisation}/old"], regimes[f"{reference}/old"]
    rows = [(name, ours[name], theirs[name]) for name in ours if ours[name] != theirs[name]]
    return pd.DataFrame(rows, columns=["field", organisation, reference])
