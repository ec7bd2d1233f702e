"""Products of many rows with one matrix: no row's result depends on the other rows, to the last bit."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

GROUP_ROWS = 32
"""Rows of one product. Linear algebra sums the last rows of a product in another order than the rest, so a
row of a hundred would differ in its last bit from the same row of a thousand: here each product is of whole
groups, filled up with zeros."""


def by_row(rows: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Return ``rows @ matrix``, each row as if it stood alone.

    Parameters
    ----------
    rows : ndarray, shape (n, m)
    matrix : ndarray, shape (m, k)

    Examples
    --------
    >>> by_row(np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[1.0], [1.0]]))
    array([[3.],
           [7.]])
    """
    groups = _filled(rows)
    product = groups @ matrix
    return np.asarray(product.reshape(groups.shape[0] * GROUP_ROWS, matrix.shape[1])[: len(rows)])


def by_group(function: Callable[[np.ndarray], np.ndarray], rows: np.ndarray) -> np.ndarray:
    """Apply a function of many rows to groups of the same size, filled up with the first row.

    For functions of libraries that multiply within.

    Parameters
    ----------
    function : callable
        Of an array (t, m); its result has t rows.
    rows : ndarray, shape (n, m)
        At least one.

    Examples
    --------
    >>> by_group(lambda some: some * 2.0, np.array([[1.0], [2.0]]))
    array([[2.],
           [4.]])
    """
    return np.concatenate([function(group) for group in _filled(rows, rows[0])])[: len(rows)]


def _filled(rows: np.ndarray, last: np.ndarray | float = 0.0) -> np.ndarray:
    """The rows in groups, (g, ``GROUP_ROWS``, m)."""
    count = -(-len(rows) // GROUP_ROWS)
    filled = np.empty((count * GROUP_ROWS, rows.shape[1]))
    filled[: len(rows)], filled[len(rows) :] = rows, last
    return filled.reshape(count, GROUP_ROWS, rows.shape[1])
