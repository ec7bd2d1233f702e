"""Rows of a recording without a number in an input: no force can be predicted there."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pandas as pd

from tire_pipeline.channels import POINT_CHANNELS


def around_holes(recording: pd.DataFrame, predict: Callable[[pd.DataFrame], pd.DataFrame]) -> pd.DataFrame:
    """Predict the rows whose inputs are known; the others are NaN.

    A lag would carry a hole on to all that follows.

    Parameters
    ----------
    recording : pandas.DataFrame
        Numbers, canonical columns.
    predict : callable
        Recording -> forces, with the same index.

    Returns
    -------
    pandas.DataFrame
        Index as the recording's.
    """
    inputs = recording[[c for c in ("time", *POINT_CHANNELS) if c in recording]]
    known = np.isfinite(inputs.dropna(axis=1, how="all").to_numpy(dtype=float)).all(axis=1)
    if known.all() or not known.any():
        return predict(recording)
    found = predict(recording[known])
    out = pd.DataFrame(np.nan, index=recording.index, columns=found.columns)
    out.iloc[np.flatnonzero(known)] = found.to_numpy()
    out.attrs.update(found.attrs)
    return out
