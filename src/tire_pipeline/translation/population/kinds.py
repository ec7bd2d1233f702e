"""What kind of tire it is, in a few numbers along which categories' biases may differ.

A soft rig loses more of a stiff tire's force than of a soft one's: such a bias differs from tire to tire with
the tire's own curves. So the numbers are made of the scores that a tire is expected to have by its metadata,
size and class, and of what is its own beyond that.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from tire_pipeline.numerics.row_products import by_row

TIRE_BLOCKS = ("metadata", "size", "class")
"""The blocks of the mixed model that say what a tire is, whoever measures it."""


@dataclass(frozen=True)
class TireKinds:
    """How the kind of tire follows from what is known and measured.

    Attributes
    ----------
    scores : ndarray of int, shape (q,)
        The scores that say it.
    expected : ndarray, shape (m, q)
        Regressors of the tire (:data:`TIRE_BLOCKS`) to these scores, in their standard deviations.
    centre : ndarray, shape (q,)
        Mean of that over the training cells.
    turn : ndarray, shape (q, k)
        To k numbers of mean 0 and, by what is expected alone, deviation 1.
    """

    scores: np.ndarray
    expected: np.ndarray
    centre: np.ndarray
    turn: np.ndarray

    @classmethod
    def find(cls, scores: np.ndarray, regressors: np.ndarray, expected: np.ndarray, count: int) -> Self:
        """Find the directions along which tires are expected to differ most.

        Parameters
        ----------
        scores : ndarray of int
        regressors : ndarray, shape (n, m)
            Of n tires.
        expected : ndarray, shape (m, q)
            Weights of their expectation.
        count : int
            Directions at most.
        """
        values = regressors @ expected
        centre = values.mean(axis=0)
        _, size, axes = np.linalg.svd(values - centre, full_matrices=False)
        keep = min(count, int((size > 1e-6 * max(size[0], 1e-12)).sum()))
        return cls(scores, expected, centre, axes[:keep].T / (size[:keep] / np.sqrt(len(values))))

    def of(self, blocks: Mapping[str, np.ndarray], own: np.ndarray) -> np.ndarray:
        """Return the numbers of n tires, (n, k).

        Parameters
        ----------
        blocks : mapping
            Regressors by block, each (n, columns).
        own : ndarray, shape (n, q)
            What is a tire's own beyond its expectation, scores in their standard deviations.
        """
        expected = by_row(tire_regressors(blocks), self.expected)
        return by_row(expected - self.centre + own, self.turn)

    def to_state(self) -> dict[str, Any]:
        """Return the arrays that restore it."""
        return {f"kinds_{name}": getattr(self, name) for name in ("scores", "expected", "centre", "turn")}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        scores, *others = (
            np.asarray(state[f"kinds_{name}"]) for name in ("scores", "expected", "centre", "turn")
        )
        return cls(scores.astype(int), *others)


def tire_regressors(blocks: Mapping[str, np.ndarray]) -> np.ndarray:
    """Regressors that say what a tire is, (n, m)."""
    return np.concatenate([blocks[name] for name in TIRE_BLOCKS if name in blocks], axis=1)


def with_kinds(blocks: Mapping[str, np.ndarray], kind: np.ndarray) -> dict[str, np.ndarray]:
    """Add the regressors of what each category does along each number of the kind, (n, k)."""
    organisation = blocks["category"]
    both = (organisation[:, :, None] * kind[:, None, :]).reshape(len(organisation), -1)
    return {**blocks, "category_kind": both} if kind.shape[1] else dict(blocks)
