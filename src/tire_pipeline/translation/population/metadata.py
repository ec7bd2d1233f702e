"""The metadata of a tire, which do not depend on who measured it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import pandas as pd

LOGARITHMIC = ("UNLOADED_RADIUS", "WIDTH", "RIM_WIDTH", "MASS", "NOMPRES")
PLAIN = ("ASPECT_RATIO", "RIM_RADIUS")
SIZE = ("WIDTH", "ASPECT_RATIO", "RIM_RADIUS")


@dataclass(frozen=True)
class Metadata:
    """Metadata as regressors.

    Attributes
    ----------
    names : tuple of str
        Columns that are known for at least half of the training files and that differ.
    mean, deviation : ndarray, shape (d,)
    sizes : tuple of str
        Tire sizes of the training files.
    """

    names: tuple[str, ...]
    mean: np.ndarray
    deviation: np.ndarray
    sizes: tuple[str, ...]

    @classmethod
    def fit(cls, table: pd.DataFrame) -> Self:
        """Learn means, spreads and sizes from the training table."""
        candidates = [name for name in (*LOGARITHMIC, *PLAIN) if name in table]
        if "COMPOUND_CLASS" in table and pd.api.types.is_numeric_dtype(table["COMPOUND_CLASS"]):
            candidates.append("COMPOUND_CLASS")
        raw = _raw(table, candidates)
        known = np.isfinite(raw).mean(axis=0) >= 0.5
        spread = np.array(
            [np.nanstd(column) if keep else 0.0 for column, keep in zip(raw.T, known, strict=True)]
        )
        keep = known & (spread > 1e-9)
        names = tuple(name for name, use in zip(candidates, keep, strict=True) if use)
        raw = raw[:, keep]
        mean = np.nanmean(raw, axis=0) if names else np.empty(0)
        return cls(names, mean, spread[keep], tuple(np.unique(size_names(table))))

    def regressors(self, table: pd.DataFrame) -> np.ndarray:
        """Standardised metadata, (n, d); what is not known counts as the mean."""
        raw = (_raw(table, self.names) - self.mean) / self.deviation
        return np.where(np.isfinite(raw), raw, 0.0)

    def size_indicators(self, table: pd.DataFrame) -> np.ndarray:
        """One column a training size, (n, sizes); a new size has none."""
        return (size_names(table)[:, None] == np.array(self.sizes)[None, :]).astype(float)

    def missing(self, table: pd.DataFrame) -> np.ndarray:
        """Share of the metadata that a file lacks, (n,)."""
        if not self.names:
            return np.ones(len(table))
        return 1.0 - np.isfinite(_raw(table, self.names)).mean(axis=1)

    def to_state(self) -> dict[str, Any]:
        """Return the arrays that restore it."""
        return {
            "metadata_names": np.array(self.names, dtype=str),
            "metadata_mean": self.mean,
            "metadata_deviation": self.deviation,
            "metadata_sizes": np.array(self.sizes, dtype=str),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(
            tuple(str(name) for name in state["metadata_names"]),
            np.asarray(state["metadata_mean"]),
            np.asarray(state["metadata_deviation"]),
            tuple(str(name) for name in state["metadata_sizes"]),
        )


def _raw(table: pd.DataFrame, names: tuple[str, ...] | list[str]) -> np.ndarray:
    columns = []
    for name in names:
        values = np.asarray(table[name], dtype=float) if name in table else np.full(len(table), np.nan)
        if name in LOGARITHMIC:
            values = np.log(np.where(values > 0.0, values, np.nan))
        columns.append(values)
    return np.stack(columns, axis=1) if columns else np.empty((len(table), 0))


def size_names(table: pd.DataFrame) -> np.ndarray:
    """Name each row's tire size, for example ``0.205/0.55/0.2032``, shape (n,)."""
    parts = [
        table[name].round(4).astype(str) if name in table else pd.Series("?", index=table.index)
        for name in SIZE
    ]
    return (parts[0] + "/" + parts[1] + "/" + parts[2]).to_numpy(dtype=str)
