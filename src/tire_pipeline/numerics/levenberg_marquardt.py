"""Levenberg-Marquardt for thousands of small bounded least-squares problems side by side.

SciPy's ``least_squares`` solves one problem a call; with a dozen parameters the calls cost most of the time.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Model = Callable[[np.ndarray, np.ndarray, bool], tuple[np.ndarray, np.ndarray | None]]
"""``model(parameters (k, p), rows (k,), slopes)`` gives the residuals (k, m) of the problems named in
``rows``, and their derivatives (k, p, m): without ``slopes`` perhaps None, if they cost more."""


@dataclass(frozen=True)
class LeastSquares:
    """A batch of n bounded least-squares problems with p parameters and m residuals.

    Attributes
    ----------
    model : callable
        See :data:`Model`.
    start, lower, upper : ndarray, shape (n, p)
        ``lower == upper`` freezes a parameter.
    prior, stiffness : ndarray, shape (n, p)
        Penalty ``stiffness * (parameter - prior)**2``.
    """

    model: Model
    start: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    prior: np.ndarray
    stiffness: np.ndarray


@dataclass(frozen=True)
class Steps:
    """How steps are damped, and when they end.

    Attributes
    ----------
    most : int
        Steps that are tried.
    tolerance : float
        A problem is done when a step that is taken lowers its cost by less than this share.
    damping, easier, harder : float
        Damping of the first step; what divides it after a step that is taken, and what multiplies it after
        one that is not.
    largest : float
        A problem is done when its damping is beyond this.
    relative : bool
        Damp by the curvature of each parameter (Marquardt); else all alike (Levenberg), for parameters that
        are counted in units of their own.
    hold : bool
        Leave a parameter at a bound out of the step where its gradient points outwards; else the step goes
        on for the others as if the bound were not there, and is cut off.
    """

    most: int = 40
    tolerance: float = 1e-7
    damping: float = 1e-2
    easier: float = 6.0
    harder: float = 5.0
    largest: float = 1e8
    relative: bool = True
    hold: bool = True


def solve(problem: LeastSquares, steps: Steps = Steps()) -> tuple[np.ndarray, np.ndarray]:
    """Minimise the squares of every problem of the batch.

    Each problem has its own damping and stops on its own; so the result of one does not depend on
    the others. A step that does not lower a problem's cost is not taken.

    Parameters
    ----------
    problem : LeastSquares
    steps : Steps

    Returns
    -------
    best : ndarray, shape (n, p)
    cost : ndarray, shape (n,)
        Sum of squares, penalty included.
    """
    best = np.clip(problem.start, problem.lower, problem.upper)
    rows = np.arange(len(best))
    residual, jacobian = problem.model(best, rows, True)
    costs = _cost(problem, best, rows, residual)
    cost = costs.copy()
    normal, gradient = _normal(problem, best, rows, residual, jacobian)
    damping = np.full(len(best), steps.damping)
    for number in range(steps.most):
        step = _step(problem, best[rows], rows, normal, gradient, damping, steps)
        trial = np.clip(best[rows] + step, problem.lower[rows], problem.upper[rows])
        residual, jacobian = problem.model(trial, rows, False)
        new_cost = _cost(problem, trial, rows, residual)
        better = new_cost < cost
        done = better & (cost - new_cost < steps.tolerance * cost)
        best[rows[better]] = trial[better]
        cost = np.where(better, new_cost, cost)
        costs[rows] = cost
        damping = np.where(better, damping / steps.easier, damping * steps.harder)
        done |= damping > steps.largest
        stay = ~done
        if number + 1 == steps.most or not stay.any():
            break
        moved = better & stay
        if moved.any():
            at = rows[moved]
            part = (residual[moved], None if jacobian is None else jacobian[moved])
            if jacobian is None:
                part = problem.model(trial[moved], at, True)
            normal[moved], gradient[moved] = _normal(problem, trial[moved], at, *part)
        rows, normal, gradient = rows[stay], normal[stay], gradient[stay]
        cost, damping = cost[stay], damping[stay]
    return best, costs


def _cost(
    problem: LeastSquares, parameters: np.ndarray, rows: np.ndarray, residual: np.ndarray
) -> np.ndarray:
    """The cost (k,), penalty included."""
    stiffness, apart = problem.stiffness[rows], parameters - problem.prior[rows]
    penalty: np.ndarray = (stiffness * apart * apart).sum(axis=1)
    squares: np.ndarray = (residual * residual).sum(axis=1)
    return squares + penalty


def _normal(
    problem: LeastSquares,
    parameters: np.ndarray,
    rows: np.ndarray,
    residual: np.ndarray,
    jacobian: np.ndarray | None,
) -> tuple[np.ndarray, np.ndarray]:
    """J'J (k, p, p) and J'r (k, p), penalty included."""
    assert jacobian is not None
    stiffness, apart = problem.stiffness[rows], parameters - problem.prior[rows]
    normal = jacobian @ jacobian.transpose(0, 2, 1)
    diagonal = np.arange(parameters.shape[1])
    normal[:, diagonal, diagonal] += stiffness
    return normal, (jacobian @ residual[:, :, None])[:, :, 0] + stiffness * apart


def _step(
    problem: LeastSquares,
    parameters: np.ndarray,
    rows: np.ndarray,
    normal: np.ndarray,
    gradient: np.ndarray,
    damping: np.ndarray,
    steps: Steps,
) -> np.ndarray:
    """Damped Gauss-Newton step with held parameters left out."""
    lower, upper = problem.lower[rows], problem.upper[rows]
    held = lower == upper
    if steps.hold:
        held |= (parameters <= lower) & (gradient > 0.0)
        held |= (parameters >= upper) & (gradient < 0.0)
    free = ~held
    matrix = normal * free[:, :, None] * free[:, None, :]
    diagonal = np.arange(parameters.shape[1])
    scale = normal[:, diagonal, diagonal]
    floor = 1e-12 * scale.max(axis=1, keepdims=True) + 1e-30
    matrix[:, diagonal, diagonal] += damping[:, None] * (scale if steps.relative else 1.0) + floor
    matrix[:, diagonal, diagonal] = np.where(held, 1.0, matrix[:, diagonal, diagonal])
    right = np.where(free, -gradient, 0.0)
    return np.linalg.solve(matrix, right[:, :, None])[:, :, 0]
