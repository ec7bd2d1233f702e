"""Sweeps: the pieces of a recording that are held out, permuted and resampled as wholes."""

from __future__ import annotations

import numpy as np
import scipy

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.mismatch.effects.shared import INDEPENDENT_STRETCHES
from tire_pipeline.mismatch.model.channels import ABSOLUTE_SPREAD
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray
_LEAST_SECONDS = 1.0
_MOST_BLOCKS = 100


def sweeps(data: Data) -> Array:
    """Return the number of the sweep that each sample belongs to.

    A sweep ends where the slip angle (or the slip ratio) passes through zero, at gaps, and where
    one would last more than an independent stretch of the recording. Without time, cells of the operating
    space.

    Parameters
    ----------
    data : Data

    Returns
    -------
    ndarray of int, shape (n,)
        0, 1, ... without holes.
    """
    if data.time is None:
        return _cells(data)
    total = float(data.step.sum())
    least = max(_LEAST_SECONDS, total / _MOST_BLOCKS)
    most = max(total / INDEPENDENT_STRETCHES, least)
    cuts = data.start.copy()
    for name in ("slip_angle", "slip_ratio"):
        x, level = data.smooth(name), ABSOLUTE_SPREAD[name]
        if data.varies(name):
            side = np.sign(np.where(np.abs(x) < level, 0.0, x))
            cuts |= _changes(side)
    elapsed = np.cumsum(data.step)
    block = np.zeros(data.size, int)
    number, begin = 0, elapsed[0]
    times = elapsed
    for i in np.flatnonzero(cuts | (np.arange(data.size) == 0)):
        if times[i] - begin >= least:
            number, begin = number + 1, times[i]
        block[i:] = number
    return _split_long(block, elapsed, most)


def whole_sweeps(block: Array) -> Array:
    """Return the number of the whole sweep, to both sides, that each sample belongs to.

    The two sides of one sweep are no two samples of what a correction gains: the formula's misfit differs
    between the sides, so what helps on one side often harms on the other.

    Parameters
    ----------
    block : ndarray of int, shape (n,)
        Of :func:`sweeps`, each to one side.

    Returns
    -------
    ndarray of int, shape (n,)
        Neighbours in twos; as they came if there is only one whole sweep, which has no spread.
    """
    complete = (int(block.max()) + 1) // 2
    return block // 2 if complete > 1 else block


def _changes(side: Array) -> Array:
    """True where the side differs from the last one that was not zero."""
    known = np.flatnonzero(side != 0.0)
    out = np.zeros(side.size, bool)
    turned = known[1:][side[known[1:]] != side[known[:-1]]]
    out[turned] = True
    return out


def _split_long(block: Array, elapsed: Array, most: float) -> Array:
    out = np.zeros_like(block)
    number = 0
    for k in range(block[-1] + 1):
        rows = np.flatnonzero(block == k)
        if rows.size == 0:
            continue
        span = elapsed[rows[-1]] - elapsed[rows[0]]
        pieces = max(1, int(np.ceil(span / most)))
        out[rows] = number + np.minimum(np.arange(rows.size) * pieces // rows.size, pieces - 1)
        number += pieces
    return out


def _cells(data: Data) -> Array:
    """Cells of the operating space, as many as each has points, but no more than stretches of a recording."""
    names = [n for n in SLIP_AND_LOAD if np.ptp(data.get(n)) > 0.0]
    count = min(int(np.sqrt(data.size)), INDEPENDENT_STRETCHES)
    if not names:
        return np.arange(data.size) * count // data.size
    x = np.column_stack([data.get(n) / np.std(data.get(n)) for n in names])
    _, label = scipy.cluster.vq.kmeans2(x, count, minit="++", seed=0)
    _, label = np.unique(label, return_inverse=True)
    return label
