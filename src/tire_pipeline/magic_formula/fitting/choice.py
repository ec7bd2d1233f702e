"""Of the fits that leave about the least, the one that is most like a tire.

Real sweeps at two or three loads are met about as well by fits that differ widely at other loads. Searches
that are drawn to typical values find those of them that are like a tire; each is drawn as far as its misfit
allows, and the one nearest to typical values is taken.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from tire_pipeline.magic_formula.fitting import typical
from tire_pipeline.magic_formula.fitting.search import ROBUST_WIDTH, SLACK, are_few, noise
from tire_pipeline.magic_formula.fitting.solve import Bounds, Problem, minimum, quick
from tire_pipeline.magic_formula.fitting.starts import curved_starts

_DRAWN = 0.035
"""A pull may add this much to the least."""
_STARTS = 24
_POINTS, _MORE_POINTS = 300, 1500
"""Of a search, and of the paths from its minima to typical values."""
_SEARCH = (0.1, 0.02)
"""Strengths of the pull in a search, over the noise, if as many points are independent as a search has."""
_PULLS = (0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0)
"""Strengths along a path."""
_TYPICAL, _LOWEST = 4, 2
"""Minima of a search that are followed: of those about as good the most typical, and the lowest."""
_SAME = 0.002, 0.05
"""Shares of the misfit and of the distance within which two minima are the same."""
_PEAKED = 1.0
"""The shape factor of a pure slip force from which its curve reaches its peak; no tire file has less."""
_SHAPES = ("PCY1", "PCX1")
_FAR = 6.0
"""Standard deviations from a robust fit beyond which a row has no say in the choice."""
_FLOOR = 1e-6
"""Least noise that a pull is measured by, over the largest force."""
_EXACT = 1e-7
"""A misfit below this share of the largest force is none."""


def most_typical(
    problem: Problem,
    bounds: Bounds,
    best: np.ndarray,
    loss: str,
    most: float,
    rng: Generator,
) -> np.ndarray:
    """Return, of the fits that leave no more than ``most``, the one that is most like a tire.

    Parameters
    ----------
    problem : Problem
    bounds : pair of ndarray
    best : ndarray
        The values that leave the least.
    loss : str
    most : float
        RMS.
    rng : Generator
        For the starts of the search.

    Returns
    -------
    ndarray
    """
    largest = float(np.abs(problem.measured).max())
    if are_few(problem):
        width = ROBUST_WIDTH * typical.FORMULA_ERROR * largest
        drawn = problem.drawn(typical.FORMULA_ERROR * largest)
        return minimum(drawn, bounds, best, loss=loss, width=max(width, 1e-6 * largest))
    clean, spread = _without_outliers(problem, bounds, best, loss)
    unit = spread / np.sqrt(_POINTS)
    peaked = _peaked(clean, bounds)
    few, more = (clean.thinned(max(rows, 8 * len(clean.names))) for rows in (_POINTS, _MORE_POINTS))
    begun = [(peaked, x) for x in _minima(few, peaked, best, unit, rng)] + [(bounds, best)]
    weak = _drawn(more, unit, _PULLS[0])
    ends = [(limits, quick(weak, limits, x, tolerance=1e-4)) for limits, x in begun]
    lower = min([best, *(x for _, x in ends)], key=more.left)
    found = quick(clean.drawn(_FLOOR * largest), bounds, lower, tolerance=1e-6)
    lowest = min(best, found, key=clean.left)
    most = min(most, (1.0 + SLACK) * max(problem.misfit(lowest), _EXACT * largest))
    allowed = (1.0 + _DRAWN) * max(clean.misfit(lowest), _EXACT * largest)
    rough = allowed / max(clean.misfit(lowest), 1e-300) * min(more.misfit(lower), more.misfit(lowest))
    for limits, values, share in _towards_typical(more, ends, unit, rough):
        values = quick(_drawn(clean, unit, share), limits, values, tolerance=1e-6)
        if clean.left(values) <= allowed and problem.misfit(values) <= most:
            return _robust(_drawn(problem, unit, share), limits, values, loss, most)
    return _robust(problem.drawn(_FLOOR * largest), bounds, lowest, loss, most)


def _without_outliers(problem: Problem, bounds: Bounds, best: np.ndarray, loss: str) -> tuple[Problem, float]:
    """Return the problem without the rows that a robust fit is far from, and the noise of the others."""
    floor = _FLOOR * float(np.abs(problem.measured).max())
    near = _robust(problem.drawn(floor), bounds, best, loss, np.inf)
    spread = max(noise(problem, near, loss), floor)
    return problem.at(np.abs(problem.residuals(near)) <= _FAR * spread), spread


def _minima(few: Problem, bounds: Bounds, best: np.ndarray, unit: float, rng: Generator) -> list[np.ndarray]:
    """Return minima of searches that are drawn to typical values: the most typical and the lowest."""
    strong, weak = (_drawn(few, unit, share) for share in _SEARCH)
    starts = [best, *curved_starts(few.names, few.pull.centre, bounds, few.pull.spread, _STARTS, rng)]
    found: list[tuple[float, float, np.ndarray]] = []
    for start in starts:
        values = quick(weak, bounds, quick(strong, bounds, start, tolerance=1e-4), tolerance=1e-4)
        left, far = few.left(values), _distance(few, values)
        known = any(abs(left - a) < _SAME[0] * a and abs(far - b) < _SAME[1] * b for a, b, _ in found)
        if np.isfinite(left) and not known:
            found.append((left, far, values))
    found.sort(key=lambda minimum: minimum[0])
    least = min([few.misfit(best), *(left for left, _, _ in found[:1])])
    near = [minimum for minimum in found if minimum[0] <= (1.0 + 1.5 * _DRAWN) * least]
    near.sort(key=lambda minimum: minimum[1])
    return [values for _, _, values in [*near[:_TYPICAL], *found[:_LOWEST]]]


def _towards_typical(
    more: Problem, ends: Sequence[tuple[Bounds, np.ndarray]], unit: float, most: float
) -> list[tuple[Bounds, np.ndarray, float]]:
    """Return what pulls make of minima as far as they leave no more than ``most``, the most typical first.

    Curves that reach their peak come before the one end that may not: the last.
    """
    found = []
    for number, (limits, values) in enumerate(ends):
        for share in _PULLS:
            values = quick(_drawn(more, unit, share), limits, values, tolerance=1e-5)
            if more.left(values) > most:
                break
            found.append((number == len(ends) - 1, _distance(more, values), limits, values, share))
    found.sort(key=lambda one: one[:2])
    return [(limits, values, share) for _, _, limits, values, share in found]


def _robust(drawn: Problem, bounds: Bounds, values: np.ndarray, loss: str, most: float) -> np.ndarray:
    """Return the minimum of a robust loss nearby, if it leaves no more than ``most``."""
    if loss == "linear":
        return values
    largest = float(np.abs(drawn.measured).max())
    width = max(ROBUST_WIDTH * noise(drawn, values, loss), 1e-6 * largest)
    found = minimum(drawn, bounds, values, loss=loss, width=width)
    return found if drawn.left(found) <= most else values


def _peaked(problem: Problem, bounds: Bounds) -> Bounds:
    """Return bounds within which the curve of a pure slip force reaches its peak."""
    low, high = bounds
    shaped = np.isin(problem.names, _SHAPES)
    return np.where(shaped, np.maximum(low, np.minimum(_PEAKED, problem.pull.centre)), low), high


def _drawn(problem: Problem, unit: float, share: float) -> Problem:
    """Return the problem with a pull that does not depend on how many rows there are."""
    return problem.drawn(unit * share * np.sqrt(problem.measured.size))


def _distance(problem: Problem, values: np.ndarray) -> float:
    """Return the square of the distance to typical values, in spreads."""
    return float(np.sum(((values - problem.pull.centre) / problem.pull.spread) ** 2))
