"""Levenberg-Marquardt for thousands of small bounded problems at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Model = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Problem:
    """A batch of n bounded least-squares problems with p parameters and m residuals.

    Attributes
    ----------
    model : callable
        ``model(parameters (k, p), rows (k,))`` gives values (k, m) and derivatives (k, p, m) for
        the problems named by ``rows``.
    target, weight : ndarray, shape (n, m)
    start, lower, upper : ndarray, shape (n, p)
        ``lower == upper`` freezes a parameter.
    prior, stiffness : ndarray, shape (n, p)
        Penalty ``stiffness * (parameter - prior)**2``.
    """

    model: Model
    target: np.ndarray
    weight: np.ndarray
    start: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    prior: np.ndarray
    stiffness: np.ndarray


def solve(problem: Problem, *, iterations: int = 40, tolerance: float = 1e-7) -> np.ndarray:
    """Minimise the weighted squares of every problem of the batch.

    Each problem has its own damping and stops on its own; so the result of one does not depend on
    the others. Parameters at a bound whose gradient points outwards are held there for the step.

    Parameters
    ----------
    problem : Problem
    iterations : int
    tolerance : float
        A problem is done when a step that is taken lowers its cost by less than this share.

    Returns
    -------
    ndarray, shape (n, p)
    """
    best = np.clip(problem.start, problem.lower, problem.upper)
    rows = np.arange(len(best))
    normal, gradient, cost = _linearise(problem, best, rows)
    damping = np.full(len(best), 1e-2)
    for _ in range(iterations):
        step = _step(problem, best[rows], rows, normal, gradient, damping)
        trial = np.clip(best[rows] + step, problem.lower[rows], problem.upper[rows])
        new_normal, new_gradient, new_cost = _linearise(problem, trial, rows)
        better = new_cost < cost
        done = better & (cost - new_cost < tolerance * cost)
        best[rows[better]] = trial[better]
        normal[better], gradient[better] = new_normal[better], new_gradient[better]
        cost = np.where(better, new_cost, cost)
        damping = np.where(better, damping / 6.0, damping * 5.0)
        done |= damping > 1e8
        if done.any():
            stay = ~done
            rows, normal, gradient = rows[stay], normal[stay], gradient[stay]
            cost, damping = cost[stay], damping[stay]
        if rows.size == 0:
            break
    return best


def _linearise(
    problem: Problem, parameters: np.ndarray, rows: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """J'J (k, p, p), J'r (k, p) and the cost (k,), penalty included."""
    value, jacobian = problem.model(parameters, rows)
    weight = problem.weight[rows]
    residual = (value - problem.target[rows]) * weight
    jacobian *= weight[:, None, :]
    stiffness, apart = problem.stiffness[rows], parameters - problem.prior[rows]
    normal = jacobian @ jacobian.transpose(0, 2, 1)
    diagonal = np.arange(parameters.shape[1])
    normal[:, diagonal, diagonal] += stiffness
    gradient = (jacobian @ residual[:, :, None])[:, :, 0] + stiffness * apart
    cost = (residual * residual).sum(axis=1) + (stiffness * apart * apart).sum(axis=1)
    return normal, gradient, cost


def _step(
    problem: Problem,
    parameters: np.ndarray,
    rows: np.ndarray,
    normal: np.ndarray,
    gradient: np.ndarray,
    damping: np.ndarray,
) -> np.ndarray:
    """Damped Gauss-Newton step with held parameters left out."""
    lower, upper = problem.lower[rows], problem.upper[rows]
    held = (lower == upper) | ((parameters <= lower) & (gradient > 0.0))
    held |= (parameters >= upper) & (gradient < 0.0)
    free = ~held
    matrix = normal * free[:, :, None] * free[:, None, :]
    diagonal = np.arange(parameters.shape[1])
    scale = normal[:, diagonal, diagonal]
    floor = 1e-12 * scale.max(axis=1, keepdims=True) + 1e-30
    matrix[:, diagonal, diagonal] += damping[:, None] * scale + floor
    matrix[:, diagonal, diagonal] = np.where(held, 1.0, matrix[:, diagonal, diagonal])
    right = np.where(free, -gradient, 0.0)
    return np.linalg.solve(matrix, right[:, :, None])[:, :, 0]
