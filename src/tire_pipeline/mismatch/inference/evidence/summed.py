"""The sum over sizes of misfit and error, compiled: every evidence is made of it."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(cache=True, fastmath={"reassoc", "contract"})
def summed(
    own: np.ndarray,
    parts: np.ndarray,
    u: np.ndarray,
    explains: np.ndarray,
    before: np.ndarray,
    half_precision: np.ndarray,
    prior: np.ndarray,
) -> tuple[float, int, int]:
    """Sum the likelihood of one output over the sizes of misfit and error, at some coefficients.

    Parameters
    ----------
    own : ndarray, shape (m + 1, m + 1)
        Mean products of the columns, the residual last.
    parts : ndarray, shape (cells, q, m + 1)
        For each size of the misfit, their products with the eigenvectors of what is never known.
    u : ndarray, shape (m + 1,)
        Minus the coefficients, and one: what they leave of the residual.
    explains : ndarray, shape (cells, errors, q)
        What each squared part takes from the log likelihood's loss.
    before : ndarray, shape (cells, errors)
        What does not depend on the residual.
    half_precision : ndarray, shape (errors,)
        Half of the weight of the squared residual.
    prior : ndarray, shape (errors,)
        Log probability of each size of the error.

    Returns
    -------
    value : float
        Log of the sum.
    cell, error : int
        Numbers of the likeliest sizes.
    """
    cells, errors, q = explains.shape
    m = u.size
    power = 0.0
    for i in range(m):
        for j in range(m):
            power += u[i] * own[i, j] * u[j]
    log_likelihood, squared = np.empty((cells, errors)), np.empty(q)
    best, cell, error = -np.inf, 0, 0
    for c in range(cells):
        for i in range(q):
            seen = 0.0
            for j in range(m):
                seen += parts[c, i, j] * u[j]
            squared[i] = seen * seen
        for e in range(errors):
            explained = 0.0
            for i in range(q):
                explained += explains[c, e, i] * squared[i]
            value = before[c, e] + prior[e] - half_precision[e] * power + explained
            log_likelihood[c, e] = value
            if value > best:
                best, cell, error = value, c, e
    total = 0.0
    for c in range(cells):
        for e in range(errors):
            total += np.exp(log_likelihood[c, e] - best)
    return best + np.log(total), cell, error
