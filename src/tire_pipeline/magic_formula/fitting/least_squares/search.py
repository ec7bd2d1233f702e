"""A stage's fit: of several starts, the most typical result among those with about the least misfit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tire_pipeline.magic_formula.fitting.least_squares.solve import Bounds, Problem, minimum, quick
from tire_pipeline.magic_formula.fitting.setup import typical
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import LOAD, ONE_SIDED_RATIO, ONE_SIDED_SLIP
from tire_pipeline.numerics.independent_rows import rows_of_one

SLACK = 0.045
"""A fit may leave this much more than the least, where a minimum of its own is more like a tire."""
_ADDED_BY_PULL = 0.02
"""A pull may add this much to a minimum."""
ROBUST_WIDTH = 2.0
"""Residuals beyond this many robust standard deviations count less and less."""
_SEARCH_ROUNDS = ((240, 60, 1e-5), (1500, 60, 1e-6), (10**9, 30, 1e-7))
"""Of a search: points at most, steps, tolerance."""
_GO_ON = 3
"""Minima that go on to more points."""
_EQUAL = 0.003
"""Relative difference in misfit up to which two searches have found the same minimum."""
_STRENGTHS = (1.0, 0.3, 0.1, 0.03, 0.01)
"""Strengths of the pull towards typical values, strongest first."""
_HELD_STRENGTHS = (1000.0, 100.0, 10.0, 3.0)
"""The same on what the ranges cannot determine."""
_EVEN_PULLS = tuple((share, share) for share in _STRENGTHS)
"""On all alike."""
_EASED_PULLS = (*((hold, _STRENGTHS[0]) for hold in _HELD_STRENGTHS), *_EVEN_PULLS)
"""Both, as they are eased from the strongest."""
_HELD_PULLS = (
    *((hold, share) for hold in (*_HELD_STRENGTHS, 1.0) for share in _STRENGTHS),
    *_EVEN_PULLS[1:],
)
"""Both, as they are tried: all else leaves typical values before what the ranges cannot determine does."""
_LEAST_PULL = 1e-6
"""Strength of the pull that keeps a search well posed, over the largest force."""


@dataclass(frozen=True)
class StageFit:
    """Values, standard errors, names that typical values determine more than the data, names at a bound."""

    values: np.ndarray
    errors: np.ndarray
    open: list[str]
    at_bound: list[str]
    misfit: float


def least(
    problem: Problem,
    bounds: Bounds,
    starts: Sequence[np.ndarray],
) -> np.ndarray:
    """Return the values with the least RMS residual.

    All starts are searched on few points. The best minima are refined on more points, and the best of these
    on all points.

    Parameters
    ----------
    problem : Problem
    bounds : pair of ndarray
    starts : sequence of ndarray
        In the order in which they are tried.

    Returns
    -------
    ndarray
    """
    floor = _LEAST_PULL * float(np.abs(problem.measured).max())
    found: list[np.ndarray] = list(starts)
    for number, (points, steps, tolerance) in enumerate(_SEARCH_ROUNDS):
        part = problem.thinned(max(points, 10 * len(problem.names))).drawn(floor)
        ends: list[np.ndarray] = []
        left: list[float] = []
        for start in found:
            ends.append(quick(part, bounds, start, steps=steps, tolerance=tolerance))
            left.append(part.left(ends[-1]))
        kept: list[int] = []
        for i in np.argsort(left):
            if all(left[i] > (1.0 + _EQUAL) * left[j] for j in kept):
                kept.append(int(i))
        found = [ends[i] for i in kept[: max(_GO_ON - number, 1)]]
    return min([*found, *starts], key=problem.left)


def most_typical(
    problem: Problem,
    bounds: Bounds,
    best: np.ndarray,
    loss: str,
    most: float,
    held: np.ndarray,
    others: Sequence[np.ndarray] = (),
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
    held : ndarray of bool
        Coefficients that the recording's ranges cannot determine; they leave their typical values last.
    others : sequence of ndarray
        More fits to choose from, such as that of a simpler formula.

    Returns
    -------
    ndarray
    """
    largest = float(np.abs(problem.measured).max())
    if are_few(problem):
        width = ROBUST_WIDTH * typical.FORMULA_ERROR * largest
        drawn = problem.drawn(typical.FORMULA_ERROR * largest)
        return minimum(drawn, bounds, best, loss=loss, width=max(width, 1e-6 * largest))

    def of_each(pulls: Sequence[tuple[float, float]]) -> list[np.ndarray]:
        return [np.where(held, hold, share) for hold, share in (pulls if held.any() else _EVEN_PULLS)]

    pulls = of_each(_HELD_PULLS)
    drawn_by = _Drawn(problem, bounds, best, loss)
    thin = problem.thinned(_SEARCH_ROUNDS[1][0])
    eased = [problem.pull.centre]
    for pull in of_each(_EASED_PULLS):
        eased.append(drawn_by.solved(thin, pull, eased[-1], 1e-5))
    found = [best, *(values for values in others if problem.left(values) <= most)]
    one_sided = bool(held[np.isin(problem.names, [*(ONE_SIDED_SLIP | ONE_SIDED_RATIO) - LOAD])].any())
    owns = (best, drawn_by.solved(problem, pulls[-1], eased[-1], 1e-7))
    for each in dict.fromkeys((loss, "linear")):
        searched = drawn_by if each == loss else _Drawn(problem, bounds, best, each)
        pulled = [values for own in owns for values in searched.strongest(thin, pulls, own, most)]
        found += pulled
        if pulled and not one_sided:
            break
    weight = np.where(held, _HELD_STRENGTHS[0], 1.0) / problem.pull.spread
    return min(found, key=lambda x: float(np.sum((weight * (x - problem.pull.centre)) ** 2)))


class _Drawn:
    """A problem with pulls, by one loss.

    Least squares get down to an RMS at which a robust loss stops short. It matters most where the slip has
    one sign: shifts, which may then stand for a part of the level, give the whole force of the other sign.
    """

    def __init__(self, problem: Problem, bounds: Bounds, best: np.ndarray, loss: str) -> None:
        self.problem, self.bounds, self.best, self.loss = problem, bounds, best, loss
        self.spread = noise(problem, best, loss)
        self.width = max(ROBUST_WIDTH * self.spread, 1e-6 * float(np.abs(problem.measured).max()))

    def solved(self, part: Problem, pull: np.ndarray, begin: np.ndarray, tolerance: float) -> np.ndarray:
        """Return the minimum on some of the rows with a pull in units of one independent row."""
        drawn = part.drawn(self.spread * np.sqrt(rows_of_one(part.residuals(self.best))) * pull)
        return minimum(drawn, self.bounds, begin, loss=self.loss, width=self.width, tolerance=tolerance)

    def strongest(
        self, thin: Problem, pulls: Sequence[np.ndarray], own: np.ndarray, most: float
    ) -> list[np.ndarray]:
        """Return the minimum by the strongest of some pulls that leaves little more than it did, or none."""
        limit = min(most, (1.0 + _ADDED_BY_PULL) * self.problem.misfit(own))
        rough = limit * thin.misfit(own) / max(self.problem.misfit(own), 1e-300)
        for pull in pulls:
            values = self.solved(thin, pull, own, 1e-5)
            if thin.misfit(values) <= rough:
                values = self.solved(self.problem, pull, values, 1e-7)
                if self.problem.left(values) <= limit:
                    return [values]
        return []


def are_few(problem: Problem) -> bool:
    """Return whether the points are too few for the least misfit to mean anything."""
    return problem.measured.size < typical.FEW_POINTS * len(problem.names)


def noise(problem: Problem, values: np.ndarray, loss: str) -> float:
    """Return the standard deviation of one point, robust unless the loss is linear."""
    residuals = problem.residuals(values)
    freedom = max(residuals.size - len(values), 1) / residuals.size
    if loss == "linear":
        return float(np.sqrt(np.mean(residuals**2) / freedom))
    middle = float(np.median(np.abs(residuals - np.median(residuals))))
    return 1.4826 * middle / np.sqrt(freedom)


def judged(problem: Problem, bounds: Bounds, values: np.ndarray, loss: str) -> StageFit:
    """Return the fit with standard errors, and what typical values determine more than the data.

    The errors take typical values as one more measurement, and count rows as many as are independent.
    """
    low, high = bounds
    near = 1e-4 * (high - low)
    bound = (values - low < near) | (high - values < near)
    residuals = problem.residuals(values)
    spread = noise(problem, values, loss)
    weights = np.ones(residuals.size)
    if loss != "linear" and spread > 0.0:
        weights = 1.0 / np.sqrt(1.0 + (residuals / (ROBUST_WIDTH * spread)) ** 2)
    freedom = max(float(np.sum(weights > 0.5)) - np.sum(~bound), 1.0)
    variance = float(np.sum(weights * residuals**2)) / freedom * rows_of_one(residuals)
    columns = problem.jacobian(values) * np.sqrt(weights)[:, None] * problem.pull.spread
    known = columns.T @ columns / max(variance, 1e-300)
    free = np.flatnonzero(~bound)
    inverse = np.linalg.inv(known[np.ix_(free, free)] + np.eye(free.size))
    shares = np.full(len(values), np.nan)
    shares[free] = np.sqrt(np.maximum(np.diag(inverse), 0.0))  # of exact forces, rounding goes below
    return StageFit(
        values,
        shares * problem.pull.spread,
        [n for n, share in zip(problem.names, shares, strict=True) if share > _UNDETERMINED_SHARE],
        [n for n, is_bound in zip(problem.names, bound, strict=True) if is_bound],
        problem.misfit(values),
    )


def part_of(whole: StageFit, names: Sequence[str], some: Sequence[str]) -> StageFit:
    """Return what a fit says of some of its coefficients."""
    rows = [list(names).index(name) for name in some]
    return StageFit(
        whole.values[rows],
        whole.errors[rows],
        [name for name in whole.open if name in some],
        [name for name in whole.at_bound if name in some],
        whole.misfit,
    )


_UNDETERMINED_SHARE = float(np.sqrt(0.5))
"""Standard error over the spread among tires, above which the spread determines more than the data."""
