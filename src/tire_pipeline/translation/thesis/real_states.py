"""Which states of the power series have a real solution, as a table to look up."""

from __future__ import annotations

import numpy as np

from tire_pipeline.representations.base import CURVE_LOADS, Representation
from tire_pipeline.tire_table.binning import Binning


def real_states(representation: Representation, bins: Binning) -> tuple[np.ndarray, np.ndarray]:
    """Ask the representation once for every combination of bins that decides.

    Whether Appendix C has a real solution depends, load by load, on the three derivatives there.

    Returns
    -------
    features : ndarray of int, shape (groups, 3)
    lookup : ndarray of bool, shape (groups, n_bins, n_bins, n_bins)
        Both empty (no groups) for representations whose states are all real.
    """
    n = bins.n_bins
    if representation.name != "power_series":
        return np.zeros((0, 3), dtype=np.int64), np.ones((0, 1, 1, 1), dtype=np.bool_)
    n_loads = len(CURVE_LOADS)
    groups = np.array([[load, n_loads + load, 2 * n_loads + load] for load in range(n_loads)])
    grid = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    lookup = []
    for load in range(n_loads):
        states = np.zeros((len(grid), len(bins.low)), dtype=np.int64)
        states[:, groups[load]] = grid
        values = bins.inverse(states)
        # the same values at all three loads, so that the answer for the tire is that for the load
        for other in range(n_loads):
            values[:, groups[other]] = values[:, groups[load]]
        lookup.append(representation.is_real(values).reshape(n, n, n))
    return groups, np.stack(lookup)
