"""Values that stand out: off their neighbours by far more than values usually are."""

from __future__ import annotations

import numpy as np
import scipy

Array = np.ndarray
STANDS_OUT = 10.0
"""Times as far off as usual. In the shared recordings (calspan, DART, TYDEX, 2 to 100 Hz) no sample of any
channel, and no residual of a point, reaches five; in 40 simulated recordings none reaches six."""
_POINTS_AROUND = 6
"""Points around one, whose median it is compared with."""

_TURNS_A_FIT = 0.05
"""Share of the squared deviations from which one point counts: a swift turn in a long drive has far less."""


def unlike_neighbours(values: Array, place: Array) -> Array:
    """Return which points have a value that is unlike those of the points around them.

    Off the median of its neighbours by ``STANDS_OUT`` times as much as usual: the geometric mean of what one
    point in ten is off, and of the range of these neighbours. And it has a part in the squared deviations of
    all. What is found hides others: those that are left are looked at until nothing is found.

    Parameters
    ----------
    values : ndarray, shape (n,)
    place : ndarray, shape (n, k)
        Where the points are; each column counts over its range. Columns that do not vary are left out.

    Returns
    -------
    ndarray of bool, shape (n,)
        None where there are no more points than neighbours, or all are at one place.
    """
    left, before = np.arange(values.size), values.size + 1
    while left.size < before:
        before = left.size
        left = left[~_seen_once(values[left], place[left])]
    found = np.ones(values.size, bool)
    found[left] = False
    return found


def _seen_once(values: Array, place: Array) -> Array:
    moved = place[:, np.ptp(place, axis=0) > 0.0] if len(place) > _POINTS_AROUND else place[:, :0]
    if moved.shape[1] == 0:
        return np.zeros(values.size, bool)
    tree = scipy.spatial.cKDTree(moved / np.ptp(moved, axis=0))
    near = tree.query(tree.data, k=_POINTS_AROUND + 1)[1][:, 1:]
    off = np.abs(values - np.median(values[near], axis=1))
    usual = float(np.quantile(off, 0.9))
    moves = np.ptp(values[near], axis=1)
    stands_out = off > STANDS_OUT * np.sqrt(np.maximum(moves, usual) * usual)
    return np.asarray(stands_out & (off**2 > _TURNS_A_FIT * np.sum(off**2)))
