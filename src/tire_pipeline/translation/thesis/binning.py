"""Equal-width bins of features scaled to [0, 1] by the training set (thesis, 4.1.1)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class EqualWidthBins:
    """From features to bins and back by whole steps; agents need steps of one size.

    Attributes
    ----------
    low, high : ndarray, shape (d,)
        Range of every feature in the training set.
    n_bins : int
    """

    low: np.ndarray
    high: np.ndarray
    n_bins: int

    @classmethod
    def fit(cls, features: np.ndarray, n_bins: int) -> EqualWidthBins:
        """Take the ranges from the training features, shape (n, d)."""
        return cls(features.min(axis=0), features.max(axis=0), int(n_bins))

    @property
    def widths(self) -> np.ndarray:
        """Width of a bin of every feature, shape (d,); 0 for a feature that never varies."""
        return (self.high - self.low) / self.n_bins

    def assign(self, features: np.ndarray) -> np.ndarray:
        """Give bins from 0 to n_bins - 1; values outside the range go to the outermost bin."""
        span = np.where(self.high > self.low, self.high - self.low, 1.0)
        scaled = (np.asarray(features) - self.low) / span
        return np.clip(np.floor(scaled * self.n_bins), 0, self.n_bins - 1).astype(np.int64)

    def centres(self, bins: np.ndarray) -> np.ndarray:
        """Give the values in the middle of bins, shape (..., d)."""
        return self.low + (np.asarray(bins) + 0.5) * self.widths

    def moved(self, features: np.ndarray, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Move features by as many bin widths as their bins moved; the others stay as they are.

        Parameters
        ----------
        features : ndarray, shape (n, d)
        before, after : ndarray of int, shape (n, d)
            Bins before and after.
        """
        return features + (after - before) * self.widths

    def to_state(self) -> dict[str, Any]:
        """Give the attributes by name."""
        return {"low": self.low, "high": self.high, "n_bins": self.n_bins}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> EqualWidthBins:
        """Bring back what :meth:`to_state` gave."""
        return cls(np.asarray(state["low"]), np.asarray(state["high"]), int(state["n_bins"]))
