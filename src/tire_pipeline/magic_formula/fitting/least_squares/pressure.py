"""Coefficients that no set pressures determine, but that the rows need: as near to typical as they allow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tire_pipeline.magic_formula.fitting.least_squares.search import ROBUST_WIDTH, noise
from tire_pipeline.magic_formula.fitting.least_squares.solve import Bounds, Problem, minimum
from tire_pipeline.magic_formula.fitting.setup.typical import Pull
from tire_pipeline.numerics.independent_rows import rows_of_one

PRESSURE_SLACK = 0.03
"""A fit whose pressures cannot determine their coefficients leaves this much more than the least: as much as
it may (``SLACK``), less what the search for the least may have missed."""
_NEARER_STRENGTHS = (0.01, 1000.0)
"""Of the pull on them: in between lies that of the strongest one that leaves no more than is allowed."""
_NEARER_OTHERS = 0.001
"""Strength of the pull on all else towards where the fit stands."""
_NEARER_POINTS = 1500
_NEARER_HALVINGS = 9
_NEARER_ON_ALL_ROWS = (1.1, 1.0, 0.9, 0.75, 0.5)
"""Of the search for it: rows, and halvings on these; then what is tried on all rows, over what came out."""


def nearer(
    problem: Problem, bounds: Bounds, values: np.ndarray, loss: str, most: float, which: np.ndarray
) -> np.ndarray:
    """Return the fit whose coefficients of pressure are nearest to typical values and that leaves ``most``.

    Parameters
    ----------
    problem : Problem
    bounds : pair of ndarray
    values : ndarray
        A fit that leaves no more than ``most``.
    loss : str
    most : float
        RMS.
    which : ndarray of bool
        The coefficients that are drawn to typical values; the others may move.

    Returns
    -------
    ndarray
        ``values`` if there is none that is nearer.
    """
    spread = noise(problem, values, loss)
    one = spread * np.sqrt(rows_of_one(problem.residuals(values)))
    width = max(ROBUST_WIDTH * spread, 1e-6 * float(np.abs(problem.measured).max()))
    drawn = Pull(np.where(which, problem.pull.centre, values), problem.pull.spread, problem.pull.strength)

    def solved(rows: Problem, hold: float, begin: np.ndarray) -> np.ndarray:
        strength = (
            one * np.where(which, hold, _NEARER_OTHERS) * np.sqrt(rows.measured.size / problem.measured.size)
        )
        part = replace(rows, pull=drawn.times(strength))
        return minimum(part, bounds, begin, loss=loss, width=width)

    thin, at = problem.thinned(_NEARER_POINTS), values
    limit = most * thin.misfit(values) / max(problem.misfit(values), 1e-300)
    weak, strong = np.log(_NEARER_STRENGTHS)
    for _ in range(_NEARER_HALVINGS):
        hold = 0.5 * (weak + strong)
        tried = solved(thin, float(np.exp(hold)), values)
        if thin.left(tried) <= limit:
            weak, at = hold, tried
        else:
            strong = hold
    for share in _NEARER_ON_ALL_ROWS:
        tried = solved(problem, share * float(np.exp(weak)), at)
        if problem.left(tried) <= most:
            return min(tried, values, key=lambda x: _far(problem, x, which))
    return values


def _far(problem: Problem, values: np.ndarray, which: np.ndarray) -> float:
    """How far coefficients are from typical values, in spreads among tires."""
    return float(np.sum((((values - problem.pull.centre) / problem.pull.spread)[which]) ** 2))
