"""Spikes and dropouts: values that stand out from their neighbours, as a disturbed line makes them.

One sample in a thousand that is off by a few times the largest force carries more power than all that a tire
model leaves, and no physics has its shape.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
import pandas as pd
import scipy

from tire_pipeline.channels import FORCE_CHANNELS, INPUT_CHANNELS
from tire_pipeline.numerics.outliers import STANDS_OUT
from tire_pipeline.pages.numbers_in_words import in_digits

Array = np.ndarray
LONGEST_SPIKE = 3
"""Samples: as many as a hole may have that is put on a straight line."""
_FEWEST_DROPOUTS = 3
_WINDOW = 2 * LONGEST_SPIKE + 1
"""Samples of the running median, which does not follow a spike."""


def spikes(x: Array, name: str = "") -> Array:
    """Return which samples of a channel are spikes.

    A value that is repeated exactly counts once, so that a dropout of any length is one. Where the channel
    itself moves fast, or neighbours are separate test points, nothing stands out: how far a sample usually is
    off is the geometric mean of how much the channel moves nearby, and of what one sample in ten is off.
    Where most of those that are off by more than the latter have one value, a line drops out to it.

    What a rig sets (slip, camber, load, speed, pressure) stays at one value between steps, as no measured
    force does: there a value that lasts is a dropout only if it comes again, and samples are counted.

    Parameters
    ----------
    x : ndarray, shape (n,)
        One channel in any unit; NaN where nothing was recorded.
    name : str
        Its name, if it is known.

    Returns
    -------
    ndarray of bool, shape (n,)
    """
    known = np.isfinite(x)
    found = np.zeros(x.size, bool)
    new = np.diff(x[known], prepend=np.nan) != 0.0
    values = x[known][new]
    if values.size < _WINDOW:
        return found
    middle = scipy.ndimage.median_filter(values, _WINDOW, mode="mirror")
    around = 2 * _WINDOW + 1
    moves = scipy.ndimage.maximum_filter(middle, around) - scipy.ndimage.minimum_filter(middle, around)
    off = np.abs(values - middle)
    of_sample, is_set = np.cumsum(new) - 1, name in INPUT_CHANNELS
    share_off = float(np.quantile(off[of_sample] if is_set else off, 0.9))
    usual = max(share_off, float(np.median(np.abs(np.diff(values)))))
    alone = off > STANDS_OUT * np.sqrt(np.maximum(moves, usual) * usual)
    if is_set:
        alone &= np.bincount(of_sample) <= LONGEST_SPIKE
    alone |= _dropped_out(values, off > STANDS_OUT * usual)
    found[known] = alone[of_sample]
    return found


def _dropped_out(values: Array, off: Array) -> Array:
    """Return which samples have the one value that most of those have which are off, bool."""
    same, count = np.unique(values[off], return_counts=True)
    if not same.size or count.max() < max(_FEWEST_DROPOUTS, 0.5 * off.sum()):
        return np.zeros(off.size, bool)
    return np.asarray(off & (values == same[np.argmax(count)]))


def said_of_spikes(name: str, x: Array, found: Array) -> str:
    """Return the channel, how many of its samples are spikes, the largest of them, and the first row.

    Parameters
    ----------
    name : str
    x : ndarray, shape (n,)
    found : ndarray of bool, shape (n,)
        Of :func:`spikes`; at least one.
    """
    rows = np.flatnonzero(found)
    most = float(x[rows[np.argmax(np.abs(x[rows]))]])
    size = in_digits(most)
    if rows.size == 1:
        return f"{name}: {size} in row {rows[0]} stands out from its neighbours"
    return f"{name}: {rows.size} values from row {rows[0]} on stand out from their neighbours, up to {size}"


def without_spikes(
    recording: pd.DataFrame, channels: Collection[str] = (*INPUT_CHANNELS, *FORCE_CHANNELS)
) -> tuple[pd.DataFrame, list[str]]:
    """Return a recording with NaN in place of spikes, and what is said of them.

    Parameters
    ----------
    recording : DataFrame
        Numeric columns. It stays as it is.
    channels : collection of str
        Columns that are looked at, if they are there.

    Returns
    -------
    recording : DataFrame
        The same object where nothing stands out.
    remarks : list of str
        One for each channel that has spikes.
    """
    without, remarks = {}, []
    for name in (n for n in channels if n in recording):
        x = recording[name].to_numpy(dtype=float, na_value=np.nan)
        found = spikes(x, name)
        if found.any():
            without[name] = np.where(found, np.nan, x)
            remarks.append(f"{said_of_spikes(name, x, found)} (left out)")
    return (recording.assign(**without) if without else recording), remarks
