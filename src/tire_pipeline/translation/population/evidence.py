"""How probable it is that a category measures a property of the curves otherwise than the target does.

The mixed model gives each category an effect on each score, whatever the data say: the effect of one that
measures as the target does is the chance of the training files, and a file that is moved by it becomes worse.
So two models are compared for each category and part of the curves: its effects are those of the mixed model,
or they equal the target's. The quotient of their evidences needs no second fit: it is the density of an equal
effect beforehand over that afterwards (Savage-Dickey; Verdinelli and Wasserman 1995).
"""

from __future__ import annotations

import numpy as np
from scipy.special import expit

from tire_pipeline.translation.curves.space import CurveSpace
from tire_pipeline.translation.population.mixed_effects import Fitted

CATEGORY_BLOCKS = ("category", "category_metadata", "category_kind", "category_class")
"""The blocks of the mixed model that say what a category does, each category in as many columns."""


def probability_of_difference(
    fitted: tuple[Fitted, ...], space: CurveSpace, columns: dict[str, slice], categories: int, target: int
) -> np.ndarray:
    """Return how probably each category measures each part otherwise than the target, even odds beforehand.

    Parameters
    ----------
    fitted : tuple of Fitted
        One a score.
    space : CurveSpace
        Which scores are of one part.
    columns : dict of slice
        Where the weights of each of :data:`CATEGORY_BLOCKS` stand, category by category.
    categories : int
    target : int
        Its place among the categories.

    Returns
    -------
    ndarray, shape (categories, p)
        The same for all scores of a part; 0 for the target.
    """
    probability = np.zeros((categories, len(fitted)))
    for category in range(categories):
        if category == target:
            continue
        odds = np.array(
            [log_odds_of_difference(one, columns, categories, category, target) for one in fitted]
        )
        for place in space.slices.values():
            probability[category, place] = expit(odds[place].sum())
    return probability


def log_odds_of_difference(
    fitted: Fitted, columns: dict[str, slice], categories: int, category: int, target: int
) -> float:
    """Logarithm of the evidence for another effect of a category on a score over that for an equal one."""
    mine, its, prior = [], [], []
    for name, place in columns.items():
        each = np.arange(place.start, place.stop).reshape(categories, -1)
        mine.append(each[category])
        its.append(each[target])
        prior.append(np.full(each.shape[1], 2.0 * fitted.variances[name]))
    a, b, before = np.concatenate(mine), np.concatenate(its), np.concatenate(prior)
    apart = fitted.mean[a] - fitted.mean[b]
    full = fitted.covariance
    after = full[np.ix_(a, a)] - full[np.ix_(a, b)] - full[np.ix_(b, a)] + full[np.ix_(b, b)]
    return _zero_before_over_after(apart, after, before)


def log_odds_of_block(fitted: Fitted, name: str, place: slice) -> float:
    """Logarithm of the evidence for a block of weights on a score over that for none."""
    before = np.full(place.stop - place.start, fitted.variances[name])
    return _zero_before_over_after(fitted.mean[place], fitted.covariance[place, place], before)


def _zero_before_over_after(mean: np.ndarray, covariance: np.ndarray, before: np.ndarray) -> float:
    """Logarithm of the density at zero beforehand, with these variances, over that afterwards."""
    scale = np.sqrt(before)
    factor = np.linalg.cholesky(covariance / np.outer(scale, scale) + 1e-9 * np.eye(scale.size))
    move = np.linalg.solve(factor, mean / scale)
    return float(np.log(np.diag(factor)).sum() + 0.5 * move @ move)
