"""Whether a stated confidence is worth its number."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from tire_pipeline.concealed.scoring.rows import score_row

_DRAWS = 500


def calibration_error(confidence: ArrayLike, correct: ArrayLike, n_bins: int = 10) -> float:
    """Expected calibration error: mean distance of confidence and hit rate over equal bins.

    Parameters
    ----------
    confidence : array_like, shape (n,)
        0 to 1.
    correct : array_like of bool, shape (n,)
    n_bins : int
    """
    p, hit = np.asarray(confidence, dtype=float), np.asarray(correct, dtype=float)
    if p.size == 0:
        return float("nan")
    place = np.minimum((np.clip(p, 0.0, 1.0) * n_bins).astype(int), n_bins - 1)
    total = 0.0
    for k in np.unique(place):
        here = place == k
        total += here.mean() * abs(p[here].mean() - hit[here].mean())
    return float(total)


def calibration_rows(
    name: str,
    confidence: Sequence[float],
    correct: Sequence[bool],
    *,
    at_most: float,
    rng: np.random.Generator,
) -> list[dict[str, Any]]:
    """The calibration error of some answers, and what chance alone would show of so many.

    Parameters
    ----------
    name : str
    confidence : sequence of float
        0 to 1, one an answer.
    correct : sequence of bool
    at_most : float
        The goal.
    rng : numpy.random.Generator
        For the interval (bootstrap over answers) and for chance.

    Returns
    -------
    list of dict
        The error; then its floor: the mean error if each answer were right as often as it says, with the
        central 95% of the draws.
    """
    p, hit, n = np.asarray(confidence, dtype=float), np.asarray(correct, dtype=bool), len(confidence)
    nan = float("nan")
    error = (
        [calibration_error(p[pick], hit[pick]) for pick in rng.integers(n, size=(_DRAWS, n))] if n else [nan]
    )
    exact = [calibration_error(p, rng.random(n) < p) for _ in range(_DRAWS)] if n else [nan]
    low, high = np.quantile(error, [0.025, 0.975])
    least, most = np.quantile(exact, [0.025, 0.975])
    return [
        score_row(name, calibration_error(p, hit), low, high, n, at_most, None),
        score_row(f"{name}, by chance alone", float(np.mean(exact)), least, most, n, None, None),
    ]
