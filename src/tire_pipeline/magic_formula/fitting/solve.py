"""One stage's robust, bounded least squares from several starts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import OptimizeResult, least_squares

from tire_pipeline.magic_formula import engine
from tire_pipeline.magic_formula.coefficients import INDEX
from tire_pipeline.magic_formula.fitting.typical import Pull
from tire_pipeline.magic_formula.jacobian import packed_jacobian
from tire_pipeline.magic_formula.numpy_form import OUTPUTS

_NO_SIGNS = np.ones(2 + len(OUTPUTS))
_ROBUST_WIDTH = 2.0
"""Residuals beyond this many robust standard deviations count less and less."""
_SINGULAR = 1e-9
"""Directions whose singular value is below this share of the largest are open."""


@dataclass(frozen=True)
class StageFit:
    """Values, standard errors, the names that the data leave open or that end at a bound; whether drawn."""

    values: np.ndarray
    errors: np.ndarray
    open: list[str]
    at_bound: list[str]
    drawn: bool


@dataclass(frozen=True)
class Problem:
    """One output over some coefficients at some points, and what draws them to what tires are like."""

    vector: np.ndarray
    family: int
    output: str
    names: Sequence[str]
    points: list[np.ndarray]
    measured: np.ndarray
    pull: Pull | None = None

    def filled(self, values: np.ndarray) -> np.ndarray:
        """Return the packed coefficients with these values."""
        vector = self.vector.copy()
        vector[[INDEX[name] for name in self.names]] = values
        return vector

    def residuals(self, values: np.ndarray) -> np.ndarray:
        """Return model minus measurement."""
        vector = self.filled(values)[None, :]
        rows = [x[None, :] for x in self.points]
        return engine.run(vector, self.family, rows, _NO_SIGNS, (self.output,), 0.0)[0, 0] - self.measured

    def jacobian(self, values: np.ndarray) -> np.ndarray:
        """Return the residuals' derivatives, one column a coefficient."""
        found = packed_jacobian(self.filled(values), self.family, self.names, self.points, [self.output])
        return found[self.output].T

    def rows(self, values: np.ndarray) -> np.ndarray:
        """Return the residuals and, below them, those of the pull."""
        residuals = self.residuals(values)
        return residuals if self.pull is None else np.append(residuals, self.pull.residuals(values))

    def rows_jacobian(self, values: np.ndarray) -> np.ndarray:
        """Return the derivatives of ``rows``."""
        found = self.jacobian(values)
        return found if self.pull is None else np.vstack([found, self.pull.jacobian()])


def solve(
    problem: Problem,
    bounds: tuple[np.ndarray, np.ndarray],
    starts: Sequence[np.ndarray],
    loss: str,
) -> StageFit:
    """Fit from each start, keep the best, and say how well each coefficient is known.

    Parameters
    ----------
    problem : Problem
    bounds : pair of ndarray
    starts : sequence of ndarray
    loss : str
        A loss of :func:`scipy.optimize.least_squares`; "linear" is not robust.

    Returns
    -------
    StageFit
    """
    largest = float(np.abs(problem.measured).max())
    tries = [_once(problem, bounds, start, loss, 0.02 * largest, 25, 1e-4) for start in starts]
    best = min(tries, key=lambda each: each.cost)
    width = 0.02 * largest
    for _ in range(2):
        residuals = problem.residuals(best.x)
        spread = 1.4826 * float(np.median(np.abs(residuals - np.median(residuals))))
        width = max(_ROBUST_WIDTH * spread, 1e-6 * largest)
        best = _once(problem, bounds, best.x, loss, width, 80, 1e-7)
    return _judged(problem, bounds, best.x, loss, width)


def _once(
    problem: Problem,
    bounds: tuple[np.ndarray, np.ndarray],
    start: np.ndarray,
    loss: str,
    width: float,
    steps: int,
    tolerance: float,
) -> OptimizeResult:
    low, high = bounds
    margin = 1e-6 * (high - low)
    return least_squares(
        problem.rows,
        np.clip(start, low + margin, high - margin),
        problem.rows_jacobian,
        bounds=bounds,
        x_scale=np.maximum(np.abs(start), 0.05 * (high - low)),
        loss=loss,
        f_scale=width,
        max_nfev=steps,
        ftol=tolerance,
        xtol=tolerance,
        gtol=1e-12,
    )


def _judged(
    problem: Problem,
    bounds: tuple[np.ndarray, np.ndarray],
    values: np.ndarray,
    loss: str,
    width: float,
) -> StageFit:
    low, high = bounds
    near = 1e-4 * (high - low)
    bound = (values - low < near) | (high - values < near)
    residuals = problem.rows(values)
    weights = 1.0 if loss == "linear" else 1.0 / np.sqrt(1.0 + (residuals / width) ** 2)
    columns = problem.rows_jacobian(values) * np.sqrt(np.broadcast_to(weights, residuals.shape))[:, None]
    scale = 0.1 * (high - low)
    free = ~bound
    _, singular, turned = np.linalg.svd((columns * scale)[:, free], full_matrices=False)
    good = singular > _SINGULAR * singular.max(initial=0.0)
    inverse = np.where(good, 1.0 / np.where(good, singular, 1.0), 0.0)
    freedom = max(int(np.sum(weights > 0.5)) if np.ndim(weights) else residuals.size, 1) - int(free.sum())
    variance = float(np.sum(weights * residuals**2)) / max(freedom, 1)
    errors = np.full(len(values), np.nan)
    errors[free] = scale[free] * np.sqrt(variance * np.sum((turned.T * inverse) ** 2, axis=1))
    lost = np.zeros(len(values), dtype=bool)
    lost[free] = (np.abs(turned[~good]) > 0.1).any(axis=0)
    unknown = lost | (errors > 0.5 * (high - low))
    return StageFit(
        values,
        errors,
        [n for n, is_open in zip(problem.names, unknown, strict=True) if is_open],
        [n for n, is_bound in zip(problem.names, bound, strict=True) if is_bound],
        problem.pull is not None,
    )
