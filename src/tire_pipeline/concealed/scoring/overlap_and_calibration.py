"""Measures of a score: overlap of intervals, and whether a confidence is worth its number."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike


def interval_iou(a: Sequence[Sequence[float]], b: Sequence[Sequence[float]]) -> float:
    """Intersection over union of two sets of intervals; 1 if both are empty.

    Parameters
    ----------
    a, b : sequence of (low, high)
        Intervals of one set may overlap.
    """
    edges = np.unique([float(v) for pair in (*a, *b) for v in pair])
    if edges.size < 2:
        return 1.0 if [list(p) for p in a] == [list(p) for p in b] else 0.0
    middles, lengths = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)

    def inside(pairs: Sequence[Sequence[float]]) -> np.ndarray:
        hits = [(middles > p[0]) & (middles < p[1]) for p in pairs]
        return np.any(hits, axis=0) if hits else np.zeros(middles.shape, dtype=bool)

    in_a, in_b = inside(a), inside(b)
    union = float(lengths[in_a | in_b].sum())
    return float(lengths[in_a & in_b].sum()) / union if union > 0 else 0.0


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
