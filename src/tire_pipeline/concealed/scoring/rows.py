"""Rows of a table of scores: a value with its 95% interval, its goal and whether it is met."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np


def share_row(
    name: str,
    hits: Sequence[bool],
    *,
    at_most: float | None = None,
    at_least: float | None = None,
) -> dict[str, Any]:
    """Proportion with Wilson's 95% interval."""
    from scipy.stats import binomtest

    n = len(hits)
    k = int(np.sum(hits)) if n else 0
    low, high = binomtest(k, n).proportion_ci(0.95, method="wilson") if n else (float("nan"),) * 2
    return score_row(name, k / n if n else float("nan"), low, high, n, at_most, at_least)


def mean_row(
    name: str,
    values: Sequence[float],
    *,
    at_most: float | None = None,
    at_least: float | None = None,
    rng: np.random.Generator | None = None,
) -> dict[str, Any]:
    """Mean with a 95% bootstrap interval over cases."""
    x = np.asarray(values, dtype=float)
    if x.size == 0:
        return score_row(name, float("nan"), float("nan"), float("nan"), 0, at_most, at_least)
    rng = rng or np.random.default_rng(0)
    means = x[rng.integers(x.size, size=(1000, x.size))].mean(axis=1)
    low, high = np.quantile(means, [0.025, 0.975])
    return score_row(name, float(x.mean()), low, high, x.size, at_most, at_least)


def score_row(
    name: str,
    value: float,
    low: float,
    high: float,
    n: int,
    at_most: float | None,
    at_least: float | None,
) -> dict[str, Any]:
    """A value with its interval; without cases there is none.

    Parameters
    ----------
    name : str
    value, low, high : float
    n : int
        Cases.
    at_most, at_least : float or None
        The goal; at most one of them.

    Returns
    -------
    dict
        ``name, value, low, high, n, target, met``.
    """
    target = None
    met: bool | None = None
    if at_most is not None:
        target, met = f"<= {at_most}", bool(value <= at_most)
    elif at_least is not None:
        target, met = f">= {at_least}", bool(value >= at_least)
    return {
        "name": name,
        "value": value if n else None,
        "low": float(low) if n else None,
        "high": float(high) if n else None,
        "n": int(n),
        "target": target,
        "met": met if n else None,
    }
