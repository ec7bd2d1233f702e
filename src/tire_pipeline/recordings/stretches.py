"""Stretches of samples in which something holds."""

from __future__ import annotations

import numpy as np


def stretches(mask: np.ndarray) -> np.ndarray:
    """Return the first sample and the one after the last of each run of True, shape (k, 2).

    Parameters
    ----------
    mask : ndarray of bool, shape (n,)

    Examples
    --------
    >>> stretches(np.array([True, False, True, True])).tolist()
    [[0, 1], [2, 4]]
    """
    edges = np.diff(np.concatenate([[0], mask.astype(np.int8), [0]]))
    return np.flatnonzero(edges).reshape(-1, 2)
