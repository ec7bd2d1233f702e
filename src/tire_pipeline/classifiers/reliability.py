"""Whether a classifier's probabilities are calibrated."""

from __future__ import annotations

import numpy as np
import pandas as pd


def reliability_curve(
    probabilities: np.ndarray, labels: np.ndarray, classes: np.ndarray, *, bins: int = 10
) -> pd.DataFrame:
    """Compare the top probability with how often the top class is right.

    Parameters
    ----------
    probabilities : ndarray, shape (n, classes)
    labels : ndarray, shape (n,)
    classes : ndarray, shape (classes,)
    bins : int
        Equal-width bins of the top probability.

    Returns
    -------
    DataFrame
        One row a bin that is not empty: ``low``, ``high``, ``rows``, ``confidence`` (mean top
        probability), ``accuracy``.
    """
    top = probabilities.max(axis=1)
    right = np.asarray(classes)[probabilities.argmax(axis=1)] == np.asarray(labels)
    index = np.minimum((top * bins).astype(int), bins - 1)
    frame = pd.DataFrame({"bin": index, "confidence": top, "accuracy": right.astype(float)})
    grouped = frame.groupby("bin")
    curve = grouped.mean()
    curve.insert(0, "low", curve.index / bins)
    curve.insert(1, "high", (curve.index + 1) / bins)
    curve.insert(2, "rows", grouped.size())
    return curve.reset_index(drop=True)


def expected_calibration_error(curve: pd.DataFrame) -> float:
    """Return the mean distance between confidence and accuracy, weighted by rows.

    Parameters
    ----------
    curve : DataFrame
        From :func:`reliability_curve`.
    """
    distance = (curve["confidence"] - curve["accuracy"]).abs()
    return float((distance * curve["rows"]).sum() / curve["rows"].sum())
