"""The target's score of a tire given the source's: Gaussian conditioning, for scores whose errors belong
together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tire_pipeline.numerics.row_products import by_row
from tire_pipeline.translation.population.mixed_effects import Fitted


@dataclass(frozen=True)
class CategoryReading:
    """How source and target read what is a tire's own in the b scores of a block.

    Attributes
    ----------
    mine : ndarray, shape (n, b)
        Spread of each file's category.
    theirs : ndarray, shape (b,)
        Spread of the target.
    alone_here : ndarray, shape (n, b)
        Variance of what a tire does in the file's category only.
    alone_there : ndarray, shape (b,)
        The same in the target.
    same : ndarray of bool, shape (n,)
        Whether the file is the target's own.
    own_link, error_link : ndarray, shape (b, b)
        As in :class:`.fit_links.FitLinks`.
    """

    mine: np.ndarray
    theirs: np.ndarray
    alone_here: np.ndarray
    alone_there: np.ndarray
    same: np.ndarray
    own_link: np.ndarray
    error_link: np.ndarray


def predict_block(
    fitted: tuple[Fitted, ...],
    source: np.ndarray,
    here: list[np.ndarray],
    there: list[np.ndarray],
    likely: np.ndarray,
    trust: float,
    reading: CategoryReading,
) -> tuple[np.ndarray, ...]:
    """Predict the scores of a block, in their standard deviations.

    Parameters
    ----------
    fitted : tuple of Fitted
        One a score.
    source : ndarray, shape (n, b)
    here, there : list of ndarray
        Regressors (n, m) for each class of tire, as the source and as the target measures.
    likely : ndarray, shape (n, k)
        Probability of each class.
    trust : float
        0: the tire effect is kept as it is; 1: it is shrunk towards the expectation by as much as it is
        error.
    reading : CategoryReading

    Returns
    -------
    tuple of ndarray
        Shift, its variance, prediction, its variance, surprise, expectation, each (n, b): what they are for
        each class, averaged by the classes' probabilities.
    """
    each = [
        _in_class(fitted, source, mine, theirs, trust, reading)
        for mine, theirs in zip(here, there, strict=True)
    ]
    columns = [np.stack(part, axis=1) for part in zip(*each, strict=True)]
    weight = likely[:, :, None]
    mean = [(weight * values).sum(axis=1) for values in columns]
    for value, variance in ((0, 1), (2, 3)):  # what the class leaves open
        apart = columns[value] - mean[value][:, None]
        mean[variance] = mean[variance] + (weight * apart**2).sum(axis=1)
    return tuple(mean)


def _in_class(
    fitted: tuple[Fitted, ...],
    source: np.ndarray,
    here: np.ndarray,
    there: np.ndarray,
    trust: float,
    reading: CategoryReading,
) -> tuple[np.ndarray, ...]:
    """As :func:`predict_block`, for tires of a known class."""
    count = here.shape[1]
    weights = np.stack([one.mean[:count] for one in fitted], axis=1)
    own, noise = (np.sqrt([one.variances[name] for one in fitted]) for name in ("tire", "noise"))
    of_weights = [one.covariance[:count, :count] for one in fitted]
    from_here, from_there, from_apart = (_times(x, of_weights) for x in (here, there, there - here))
    at_source, at_target = by_row(here, weights), by_row(there, weights)
    tire_here, tire_there = reading.mine * own, reading.theirs * own
    alone = _outer(np.sqrt(reading.alone_here)) * reading.error_link
    together = tire_there[:, None] * tire_here[:, None, :] * reading.own_link
    together = together + reading.same[:, None, None] * alone + _diagonal(_dot(from_here, there))
    source_covariance = _outer(tire_here) * reading.own_link + alone
    source_covariance = source_covariance + np.outer(noise, noise) * reading.error_link
    source_covariance = source_covariance + _diagonal(_dot(from_here, here))
    target_variance = _dot(from_there, there) + tire_there**2 + reading.alone_there + noise**2
    drawn = np.linalg.solve(source_covariance, together.transpose(0, 2, 1)).transpose(0, 2, 1)
    slope = np.eye(len(fitted)) - trust * (np.eye(len(fitted)) - drawn)
    residual = source - at_source
    target = at_target + (slope @ residual[:, :, None])[:, :, 0]
    variance = target_variance - 2.0 * (slope * together).sum(axis=2)
    variance = variance + ((slope @ source_covariance) * slope).sum(axis=2)
    surprise = residual / np.sqrt(np.diagonal(source_covariance, axis1=1, axis2=2))
    shift_variance = _dot(from_apart, there - here)
    return at_target - at_source, shift_variance, target, variance, surprise, at_target


def _outer(values: np.ndarray) -> np.ndarray:
    """Products of the b columns of each row, (n, b, b)."""
    return np.asarray(values[:, :, None] * values[:, None, :])


def _times(design: np.ndarray, of_weights: list[np.ndarray]) -> list[np.ndarray]:
    """A design (n, m) times the covariance of each score's weights."""
    return [by_row(design, one) for one in of_weights]


def _dot(left: list[np.ndarray], right: np.ndarray) -> np.ndarray:
    """Covariance of the expectations at two designs, by score, (n, b): :func:`_times` one, and the other."""
    return np.stack([(one * right).sum(axis=1) for one in left], axis=1)


def _diagonal(values: np.ndarray) -> np.ndarray:
    """The b columns of each row as a diagonal matrix, (n, b, b)."""
    return np.asarray(values[:, :, None] * np.eye(values.shape[1]))
