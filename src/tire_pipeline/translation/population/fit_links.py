"""Correlations between the errors of one fit.

A fit that draws the curve a little too stiff at the origin bends it more towards the peak, because it goes
through the same points: the errors of stiffness and shape of one output belong together. So a shape that is
unlike the tire's kind tells which way the stiffness of the same file is off. Friction is not among them: its
error is the surface of the day, which all of a file shares and nothing in it tells.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from scipy.special import ndtri

LINKED = (("cornering stiffness", "lateral shape"), ("slip stiffness", "longitudinal shape"))
"""Parts whose errors belong together."""

FEWEST = 20
"""Fewer rows than this tell no correlation."""

_LARGEST_DEVIATION = 3.0  # of a deviation, in standard deviations
_NO_SPREAD = 1e-9
"""A score that differs by less, in standard deviations, has no correlation with others."""
_LEAST_OWN_PART = 0.05  # of a score's variance is the tires' own at least
_LARGEST_CORRELATION = 0.95  # correlation of what is the tires' own
_LEAST_EIGENVALUE = 1e-2  # of an eigenvalue of a correlation


@dataclass(frozen=True)
class FitLinks:
    """Correlations between scores, 0 between parts that are not linked.

    Attributes
    ----------
    own : ndarray, shape (p, p)
        Of what is the tires' own beyond metadata, size and class.
    error : ndarray, shape (p, p)
        Of noise, and of what one tire does in one category only.
    """

    own: np.ndarray
    error: np.ndarray

    def to_state(self) -> dict[str, Any]:
        """Return the arrays that restore it."""
        return {"links_own": self.own, "links_error": self.error}

    @classmethod
    def from_state(cls, state: Mapping[str, Any], count: int) -> Self:
        """Restore what :meth:`to_state` returned; a state from before there were links has none."""
        if "links_own" not in state:
            return cls(np.eye(count), np.eye(count))
        return cls(np.asarray(state["links_own"]), np.asarray(state["links_error"]))


def linked_blocks(slices: Mapping[str, slice]) -> list[np.ndarray]:
    """Lay out all scores in blocks: linked parts together, every other score on its own."""
    places = {name: np.arange(place.start, place.stop) for name, place in slices.items()}
    linked = [np.concatenate([places[name] for name in names]) for names in LINKED]
    others = np.setdiff1d(np.concatenate(list(places.values())), np.concatenate(linked))
    return [*linked, *others[:, None]]


@dataclass(frozen=True)
class Deviations:
    """What the correlations are found from; scores in their standard deviations.

    Attributes
    ----------
    cells : ndarray, shape (c, p)
        Training cells less their expectation.
    repeats : ndarray, shape (n, p)
        Files less their cell's location.
    shared : ndarray, shape (k, p)
        Cells of tires that several categories measured, less their tire and their category.
    own : ndarray, shape (p,)
        Variance of what is a tire's own.
    error : ndarray, shape (p,)
        Variance of a cell's noise and of what a tire does in one category only.
    """

    cells: np.ndarray
    repeats: np.ndarray
    shared: np.ndarray
    own: np.ndarray
    error: np.ndarray


def find_links(found: Deviations, blocks: list[np.ndarray]) -> FitLinks:
    """Find the correlations within blocks.

    Errors are seen twice: files of one cell differ by noise and by who fitted them, cells of one tire by what
    each category makes of it. Neither alone is the error of a file, so the mean of both is taken. What the
    errors leave of the cells' covariance is the tires' own.

    Parameters
    ----------
    found : Deviations
    blocks : list of ndarray of int
        As :func:`linked_blocks` gives them.

    Returns
    -------
    FitLinks
    """
    count = found.own.size
    own, error = np.eye(count), np.eye(count)
    for whole_block in blocks:
        if len(found.cells) < FEWEST:
            continue
        block = whole_block[_varies(found, whole_block)]
        if block.size < 2:
            continue
        here = np.ix_(block, block)
        seen = [rows[:, block] for rows in (found.repeats, found.shared) if len(rows) >= FEWEST]
        if not seen:
            continue
        error[here] = sum(_correlation(rows) for rows in seen) / len(seen)
        own[here] = _own_correlation(found, block, error[here])
    return FitLinks(own, error)


def _varies(found: Deviations, block: np.ndarray) -> np.ndarray:
    """Whether each score of a block differs at all: files without noise repeat each other exactly."""
    rows = [r[:, block] for r in (found.repeats, found.shared) if len(r) >= FEWEST]
    moved = [np.ptp(r, axis=0) > _NO_SPREAD for r in rows]
    return np.all([found.own[block] + found.error[block] > _NO_SPREAD**2, *moved], axis=0)


def _correlation(rows: np.ndarray) -> np.ndarray:
    """Shrunk correlation of normal scores: outliers count by their rank only (Ledoit and Wolf 2004)."""
    from scipy.stats import rankdata
    from sklearn.covariance import LedoitWolf

    normal = ndtri((rankdata(rows, axis=0) - 0.5) / len(rows))
    return _unit(LedoitWolf(assume_centered=True).fit(normal).covariance_)


def _own_correlation(found: Deviations, block: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Correlation of the cells without that of their errors."""
    from sklearn.covariance import LedoitWolf

    own, noise = found.own[block], found.error[block]
    spread = np.sqrt(own + noise)
    bounded = np.clip(found.cells[:, block] / spread, -_LARGEST_DEVIATION, _LARGEST_DEVIATION)
    whole = LedoitWolf().fit(bounded).covariance_ * np.outer(spread, spread)
    rest = whole - error * np.sqrt(np.outer(noise, noise))
    size = np.sqrt(np.maximum(np.diag(rest), _LEAST_OWN_PART * np.diag(whole)))
    correlation = np.clip(rest / np.outer(size, size), -_LARGEST_CORRELATION, _LARGEST_CORRELATION)
    np.fill_diagonal(correlation, 1.0)
    values, axes = np.linalg.eigh(correlation)
    return _unit((axes * np.maximum(values, _LEAST_EIGENVALUE)) @ axes.T)


def _unit(covariance: np.ndarray) -> np.ndarray:
    size = np.sqrt(np.diag(covariance))
    return np.asarray(covariance / np.outer(size, size))
