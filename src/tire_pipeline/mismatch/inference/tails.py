"""Priors with tails: a parameter is usually as large as its effect's file states, and at times far larger.

Within twice its spread a prior is normal. Beyond, its density falls with the fourth power of the size instead
of with the exponential of its square. An offset of a load cell has no largest size: a fault that is ten times
as large as usual is rare, not impossible. In terms of z, the size over the spread::

    -log p(z) = z^2 / 2                           |z| <= 2
    -log p(z) = 2 + 4 log(|z| / 2)                |z| > 2

Both value and slope are continuous; the tails hold 7% of the mass, which the normalisation ignores. About any
z the prior acts as a normal one whose spread is |z| / 2 times as wide (iteratively reweighted least squares:
Huber and Ronchetti 2009, Robust Statistics, 2nd ed., 7.8).
"""

from __future__ import annotations

import numpy as np

Array = np.ndarray
_NORMAL = 2.0
"""Spreads within which a prior is normal."""


def cost(z: Array) -> Array:
    """Return the negative log density at some sizes over their spread, shape as ``z``; 0 at the centre."""
    return 0.5 * np.minimum(np.abs(z), _NORMAL) ** 2 + _NORMAL**2 * np.log(widening(z))


def widening(z: Array) -> Array:
    """Return how many times as wide the normal prior is that has the slope of this one, shape as ``z``."""
    return np.maximum(np.abs(z) / _NORMAL, 1.0)


def log_correction(z: Array, wide: Array) -> float:
    """Return the log density at some sizes over that of normal priors ``wide`` times as wide, summed."""
    return float(np.sum(0.5 * (z / wide) ** 2 + np.log(wide) - cost(z)))
