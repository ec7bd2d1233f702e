"""From features back to a tire: the least change of coefficients that gives the curves asked for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.numerics.levenberg_marquardt import LeastSquares, Steps, solve
from tire_pipeline.progress import track
from tire_pipeline.translation.curves.features import GROUPS, Group
from tire_pipeline.translation.curves.pure_slip import columns
from tire_pipeline.translation.decode.physics import curvature_excess

_SOLVER_STEPS = Steps(
    most=6, tolerance=0.01, damping=1e-3, easier=10.0, harder=50.0, largest=1e4, relative=False, hold=False
)
_STEP_IN_SPREADS = 1e-4  # of a coefficient's spread, for derivatives
_PULL = 0.003  # weight of "stay at the source's coefficients" against one feature, both in their spreads
_CURVATURE = (30.0, 300.0, 3000.0)  # weight of a curvature factor above 1; the next where it still is
_EXCESS = 3e-4  # of the curvature factor above 1 that may remain
_POOR = 1.0  # root mean square in units, above which a second start is tried


@dataclass(frozen=True)
class DecodeTarget:
    """What the coefficients of n tires have to give.

    Attributes
    ----------
    features : dict of ndarray
        By group, (n, d).
    unit : dict of float
        By group: what counts as one unit of a feature.
    spread : dict of float
        By coefficient: what counts as one unit of change.
    typical : dict of float
        By coefficient: a second point to start from.
    bounds : dict of (float, float)
        By coefficient; a source outside of them may stay where it is.
    locked : dict of ndarray of bool
        By coefficient, (n,): which tires keep it.
    """

    features: dict[str, np.ndarray]
    unit: dict[str, float]
    spread: dict[str, float]
    typical: dict[str, float]
    bounds: dict[str, tuple[float, float]]
    locked: dict[str, np.ndarray]


def decode(table: pd.DataFrame, target: DecodeTarget) -> pd.DataFrame:
    """Change every tire's coefficients so that it has the features asked for.

    Parameters
    ----------
    table : DataFrame
        n source tires.
    target : DecodeTarget

    Returns
    -------
    DataFrame
        A copy of ``table`` with other p and q coefficients.

    Notes
    -----
    Damped Gauss-Newton steps on all tires at once (:mod:`.numerics.levenberg_marquardt`), derivatives by
    differences. A curvature factor above 1 costs more and more, until next to none is left.
    """
    decoded = table.copy()
    asked = [group for group in GROUPS if group.name in target.features]
    for group in track(asked, "finding coefficients of the translated tires, force by force"):
        decoded[list(group.coefficients)] = _Solver(decoded, group, target).solve()
    return decoded


class _Solver:
    """Least squares of one output's features over its coefficients."""

    def __init__(self, table: pd.DataFrame, group: Group, target: DecodeTarget) -> None:
        self.group, self.names, self.curvature = group, group.coefficients, _CURVATURE[0]
        self.fixed = columns(table)
        self.wanted, self.unit = target.features[group.name], target.unit[group.name]
        self.spread = np.array([target.spread[name] for name in self.names])
        self.source = np.concatenate([self.fixed[name] for name in self.names], axis=1)
        self.typical = np.array([target.typical[name] for name in self.names])
        limits = np.array([target.bounds[name] for name in self.names])
        self.low = np.minimum(limits[:, 0], self.source)
        self.high = np.maximum(limits[:, 1], self.source)
        for k, name in enumerate(self.names):
            rows = target.locked.get(name)
            if rows is not None:
                self.low[rows, k] = self.high[rows, k] = self.source[rows, k]

    def solve(self) -> np.ndarray:
        rows = np.arange(len(self.source))
        best, cost = self._descend(rows, self.source.copy())
        gap = self._residual(best, rows)[:, : self.wanted.shape[1]]
        poor = np.flatnonzero((gap**2).mean(axis=1) > _POOR**2)
        if poor.size:
            start = np.clip(
                np.broadcast_to(self.typical, (poor.size, self.typical.size)), self.low[poor], self.high[poor]
            )
            again, new_cost = self._descend(poor, start.copy())
            better = new_cost < cost[poor]
            best[poor[better]] = again[better]
        for self.curvature in _CURVATURE[1:]:
            over = np.flatnonzero((self._excess(best, rows) > _EXCESS).any(axis=1))
            if over.size:
                best[over] = self._descend(over, best[over])[0]
        return best

    def _columns(self, values: np.ndarray, rows: np.ndarray) -> dict[str, np.ndarray]:
        p = {name: column[rows] for name, column in self.fixed.items()}
        return {**p, **{name: values[:, [k]] for k, name in enumerate(self.names)}}

    def _excess(self, values: np.ndarray, rows: np.ndarray) -> np.ndarray:
        return curvature_excess(self.group.name, self._columns(values, rows))

    def _residual(self, values: np.ndarray, rows: np.ndarray) -> np.ndarray:
        p = self._columns(values, rows)
        gap = (self.group.of(p) - self.wanted[rows]) / self.unit
        gap = np.where(np.isfinite(gap), gap, 1e6)
        return np.concatenate([gap, self.curvature * curvature_excess(self.group.name, p)], axis=1)

    def _model(
        self, moves: np.ndarray, rows: np.ndarray, slopes: bool
    ) -> tuple[np.ndarray, np.ndarray | None]:
        """Residuals and their derivatives by differences, over moves from the source in units of spread."""
        values = self.source[rows] + moves * self.spread
        gap = self._residual(values, rows)
        if not slopes:
            return gap, None
        jacobian = np.empty((len(rows), self.spread.size, gap.shape[1]))
        for k, spread in enumerate(self.spread):
            moved = values.copy()
            moved[:, k] += _STEP_IN_SPREADS * spread
            jacobian[:, k] = (self._residual(moved, rows) - gap) / _STEP_IN_SPREADS
        return gap, jacobian

    def _descend(self, rows: np.ndarray, start: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        source = self.source[rows]

        def model(moves: np.ndarray, at: np.ndarray, slopes: bool) -> tuple[np.ndarray, np.ndarray | None]:
            return self._model(moves, rows[at], slopes)

        start, lower, upper = (
            (values - source) / self.spread for values in (start, self.low[rows], self.high[rows])
        )
        zero = np.zeros_like(start)
        moves, cost = solve(LeastSquares(model, start, lower, upper, zero, zero + _PULL), _SOLVER_STEPS)
        return np.where(lower == upper, source, source + moves * self.spread), cost
