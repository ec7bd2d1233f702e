"""What is known before the classes of tires are looked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from tire_pipeline.translation.population.mixed_effects import Design


@dataclass(frozen=True)
class ClassSearchInput:
    """What the search needs to know.

    Attributes
    ----------
    design : Design
        Cells, without classes; must have the block ``category``.
    response : ndarray, shape (n, q)
        Scores that tell classes apart, in their standard deviations.
    tire : ndarray of int, shape (n,)
        Which cells are of one tire, as far as that may be used.
    metadata : ndarray, shape (n, d)
    noise, alone : ndarray, shape (q,)
        Variance of one file's noise, and of what a tire does in one category alone.
    variances : sequence of dict, q
        As in :attr:`.mixed_effects.Fitted.variances`, without classes: where the search begins.
    scores : ndarray of int, shape (q,)
        Which scores these are.
    linked : ndarray of bool, shape (q, q)
        Scores that may go together within a class; what links others is the class.
    """

    design: Design
    response: np.ndarray
    tire: np.ndarray
    metadata: np.ndarray
    noise: np.ndarray
    alone: np.ndarray
    variances: tuple[Mapping[str, float], ...]
    scores: np.ndarray
    linked: np.ndarray

    @property
    def one_cell(self) -> np.ndarray:
        """A cell of each tire, (tires,)."""
        return np.unique(self.tire, return_index=True)[1]


def per_tire(values: np.ndarray, tire: np.ndarray) -> np.ndarray:
    """Mean over the cells of each tire, (tires, ...), from values (n, ...)."""
    total = np.zeros((tire.max() + 1, *values.shape[1:]))
    np.add.at(total, tire, values)
    return np.asarray(total / np.bincount(tire).reshape(-1, *[1] * (values.ndim - 1)))
