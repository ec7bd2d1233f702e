"""Decision trees flattened to arrays and summed up by compiled code for a whole batch.

scikit-learn's ``predict_proba`` costs milliseconds even for one row; an agent's reward asks for four
rows at a time, thousands of times a second.
"""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

njit: Any = None
with suppress(ImportError):  # numba is a dependency; this keeps a broken one from stopping the pipeline
    from numba import njit

ForestArrays = namedtuple("ForestArrays", ["feature", "threshold", "left", "right", "value", "roots"])
ForestArrays.__doc__ = "The arrays of a :class:`CompiledForest`, as compiled code takes them."


@dataclass(frozen=True)
class CompiledForest:
    """All nodes of all trees in a row.

    Attributes
    ----------
    feature : ndarray of int32, shape (nodes,)
        The feature that a node looks at, -1 in a leaf.
    threshold : ndarray of float64, shape (nodes,)
        Up to here (features taken as float32, as scikit-learn does) it goes left.
    left, right : ndarray of int32, shape (nodes,)
        Row of the children.
    value : ndarray of float64, shape (nodes, outputs)
        What a leaf adds to the sum.
    roots : ndarray of int32, shape (trees,)
        Row of every tree's first node.
    """

    feature: np.ndarray
    threshold: np.ndarray
    left: np.ndarray
    right: np.ndarray
    value: np.ndarray
    roots: np.ndarray

    def sums(self, features: np.ndarray) -> np.ndarray:
        """Return the sum of all trees' leaves.

        Parameters
        ----------
        features : ndarray, shape (n, d)

        Returns
        -------
        ndarray, shape (n, outputs)
            For a forest: the class probabilities.
        """
        rows = np.ascontiguousarray(features, dtype=np.float32)
        if njit is None:
            return self.sums_without_numba(rows)
        out = np.zeros((len(rows), self.value.shape[1]))
        add_leaves(rows, self.arrays(), out)
        return out

    def sums_without_numba(self, features: np.ndarray) -> np.ndarray:
        """Return the same as :meth:`sums`, with NumPy alone: all rows and trees a level at a time."""
        rows = np.asarray(features, dtype=np.float32)
        node = np.broadcast_to(self.roots, (len(rows), len(self.roots))).copy()
        index = np.arange(len(rows))[:, None]
        while True:
            feature = self.feature[node]
            inner = feature >= 0
            if not inner.any():
                return self.value[node].sum(axis=1)
            goes_left = rows[index, np.maximum(feature, 0)] <= self.threshold[node]
            child = np.where(goes_left, self.left[node], self.right[node])
            node = np.where(inner, child, node)

    def arrays(self) -> ForestArrays:
        """Return the arrays, for compiled code."""
        return ForestArrays(**self.to_state())

    def to_state(self) -> dict[str, np.ndarray]:
        """Return the arrays by name."""
        return {name: getattr(self, name) for name in ForestArrays._fields}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> CompiledForest:
        """Restore what :meth:`to_state` returned."""
        return cls(**{name: np.asarray(state[name]) for name in ForestArrays._fields})


def compile_trees(trees: Sequence[Any], values: Sequence[np.ndarray]) -> CompiledForest:
    """Flatten scikit-learn trees.

    Parameters
    ----------
    trees : sequence of sklearn.tree._tree.Tree
        The ``tree_`` of each estimator.
    values : sequence of ndarray, shape (nodes of the tree, outputs)
        What each node adds if it is a leaf.
    """
    offsets = np.cumsum([0, *(tree.node_count for tree in trees)])
    feature, left, right = [], [], []
    for tree, offset in zip(trees, offsets[:-1], strict=True):
        leaf = tree.children_left < 0
        feature.append(np.where(leaf, -1, tree.feature))
        left.append(np.where(leaf, 0, tree.children_left + offset))
        right.append(np.where(leaf, 0, tree.children_right + offset))
    return CompiledForest(
        feature=np.concatenate(feature).astype(np.int32),
        threshold=np.concatenate([tree.threshold for tree in trees]).astype(np.float64),
        left=np.concatenate(left).astype(np.int32),
        right=np.concatenate(right).astype(np.int32),
        value=np.ascontiguousarray(np.concatenate(list(values)), dtype=np.float64),
        roots=offsets[:-1].astype(np.int32),
    )


def compile_forest(forest: Any) -> CompiledForest:
    """Flatten a fitted ``RandomForestClassifier``: the sums are its ``predict_proba``."""
    trees = [estimator.tree_ for estimator in forest.estimators_]
    values = []
    for tree in trees:
        share = tree.value[:, 0, :]
        values.append(share / share.sum(axis=1, keepdims=True) / len(trees))
    return compile_trees(trees, values)


if njit is not None:

    @njit(cache=True, nogil=True)
    def add_leaves(rows, forest, out):
        """Add to ``out`` (n, outputs) the leaves of the forest that the ``rows`` (n, d) fall into."""
        feature, threshold, left, right, value, roots = forest
        for row in range(rows.shape[0]):
            for root in roots:
                node = root
                split = feature[node]
                while split >= 0:
                    if rows[row, split] <= threshold[node]:
                        node = left[node]
                    else:
                        node = right[node]
                    split = feature[node]
                for output in range(value.shape[1]):
                    out[row, output] += value[node, output]
