"""Overlap of intervals: when and where an effect is, as named and as it is."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


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
