"""How each category spreads what is a tire's own, and how much it adds that no other category sees.

Score of a tire in a category, less its expectation: spread of the category x the tire's own + alone + noise.
One fit stiffens every curve's shape, another lets a coefficient run into its bound: both differ by category,
and they decide how far a file is to be believed. Tires that several categories measured tell both apart.
With fewer than four, only their sum is known: then what is alone stays as it is expected, and the spread
follows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

FEWEST_SHARED = 4
"""Fewer tires that several categories measured do not tell what is alone."""

FREEDOM = 6.0
"""Of the Student distribution of a cell: a fit that went astray is no usual tire."""

_ALONE_WIDTH = 1.0  # of the logarithm of a category's variance alone about the common one
_COMMON_WIDTHS = (0.5, 1.0)  # of the common ones about what the mixed model found
_HELD = 1e-2  # of what is not to be found
_ABSENT = 1e8
_FARTHEST = 3.0  # that a logarithm moves: beyond it a covariance may be singular


@dataclass(frozen=True)
class Residuals:
    """One score of n cells less its expectation, and who measured what.

    Attributes
    ----------
    gap : ndarray, shape (n,)
    category : ndarray of int, shape (n,)
    noise : ndarray, shape (n,)
        Variance of each cell's noise.
    shared : ndarray of int, shape (t, categories)
        For each tire that several categories measured, its cells; -1 where there is none.
    """

    gap: np.ndarray
    category: np.ndarray
    noise: np.ndarray
    shared: np.ndarray


def shared_cells(tire: np.ndarray, category: np.ndarray, categories: int) -> np.ndarray:
    """Lay out :attr:`Residuals.shared` from tires as indicator columns (n, t)."""
    place = np.full((tire.shape[1], categories), -1)
    cell, column = np.nonzero(tire)
    place[column, category[cell]] = cell
    return place


def category_spreads(
    found: Residuals, own: float, alone: float, width: float
) -> tuple[np.ndarray, np.ndarray]:
    """Find by how much each category scatters: the mode of the posterior.

    Parameters
    ----------
    found : Residuals
    own : float
        Variance of what is the tires' own, where the spread is 1.
    alone : float
        Variance of what one tire does in one category only, in the mean of the categories.
    width : float
        Standard deviation of the logarithm of a category's spread about the common one, beforehand.

    Returns
    -------
    spread : ndarray, shape (categories,)
        Times as far apart as the tires are.
    alone : ndarray, shape (categories,)
        Variance of what one tire does in this category only.
    """
    count = found.shared.shape[1]
    single = np.ones(len(found.gap), dtype=bool)
    single[found.shared[found.shared >= 0]] = False
    told = (found.shared >= 0).sum(axis=0) >= FEWEST_SHARED

    def cost(logs: np.ndarray) -> tuple[float, np.ndarray]:
        spread, extra = np.exp(logs[0] + logs[2 : 2 + count]), alone * np.exp(logs[1] + logs[2 + count :])
        one = _single_cost(found, single, own, spread, extra)
        several = _shared_cost(found, own, spread, extra)
        prior, pull = _prior(logs, told, width)
        by_spread, by_extra = one[1] + several[1], one[2] + several[2]
        slope = np.concatenate([[by_spread.sum(), by_extra.sum()], by_spread, by_extra])
        return one[0] + several[0] + prior, slope + pull

    start = np.zeros(2 + 2 * count)
    bounds = [(-_FARTHEST, _FARTHEST)] * start.size
    logs = minimize(cost, start, jac=True, method="L-BFGS-B", bounds=bounds, options={"maxiter": 100}).x
    return np.exp(logs[0] + logs[2 : 2 + count]), alone * np.exp(logs[1] + logs[2 + count :])


def _prior(logs: np.ndarray, told: np.ndarray, width: float) -> tuple[float, np.ndarray]:
    """Cost and slope of the prior; ``told`` (categories,): whose variance alone its shared tires tell."""
    common = [_COMMON_WIDTHS[0], _COMMON_WIDTHS[1] if told.any() else _HELD]
    spread = np.full(told.size, width)
    widths = np.concatenate([common, spread, np.where(told, _ALONE_WIDTH, _HELD)])
    return 0.5 * float(((logs / widths) ** 2).sum()), logs / widths**2


def _single_cost(
    found: Residuals, single: np.ndarray, own: float, spread: np.ndarray, extra: np.ndarray
) -> tuple[float, np.ndarray, np.ndarray]:
    """Cost and its slopes by the logarithms of spread and extra: tires that one category measured."""
    place, gap = found.category[single], found.gap[single]
    variance = own * spread[place] ** 2 + extra[place] + found.noise[single]
    size = gap**2 / variance
    value = 0.5 * np.log(variance).sum()
    value += 0.5 * (FREEDOM + 1.0) * np.log1p(size / (FREEDOM - 2.0)).sum()
    slope = 0.5 / variance * (1.0 - (FREEDOM + 1.0) / (FREEDOM - 2.0 + size) * size)
    by_spread = np.bincount(place, slope * 2.0 * own * spread[place] ** 2, spread.size)
    return float(value), by_spread, np.bincount(place, slope * extra[place], spread.size)


def _shared_cost(
    found: Residuals, own: float, spread: np.ndarray, extra: np.ndarray
) -> tuple[float, np.ndarray, np.ndarray]:
    """The same for tires that several categories measured."""
    if not len(found.shared):
        return 0.0, np.zeros_like(spread), np.zeros_like(extra)
    there = found.shared >= 0
    gap = np.where(there, found.gap[found.shared], 0.0)
    both = there[:, :, None] & there[:, None, :]
    covariance = own * spread[:, None] * spread[None, :] * both
    diagonal = np.arange(spread.size)
    covariance[:, diagonal, diagonal] += np.where(there, extra + found.noise[found.shared], _ABSENT)
    inverse = np.linalg.inv(covariance)
    weighted = (inverse @ gap[:, :, None])[:, :, 0]
    size, known = (weighted * gap).sum(axis=1), there.sum(axis=1)
    value = 0.5 * np.linalg.slogdet(covariance)[1].sum()
    value += (0.5 * (FREEDOM + known) * np.log1p(size / (FREEDOM - 2.0))).sum()
    trust = (FREEDOM + known) / (FREEDOM - 2.0 + size)
    slope = 0.5 * (inverse - trust[:, None, None] * weighted[:, :, None] * weighted[:, None, :]) * both
    by_extra = slope[:, diagonal, diagonal].sum(axis=0) * extra
    return float(value), 2.0 * own * ((slope @ spread) * spread).sum(axis=0), by_extra
