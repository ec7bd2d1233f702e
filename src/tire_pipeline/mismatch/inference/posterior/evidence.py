"""Log evidence of sets of effects by Laplace's approximation: everything linear is integrated out.

``y = J x + E e + B b + noise`` with ``x`` the parameters (unit prior after scaling by the spread of their
priors), ``e`` the form errors and ``b`` the background. The sizes of the misfit are summed over their grid.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.posterior.products import OfCase, OfSet
from tire_pipeline.mismatch.inference.posterior.sizes import LearntSizes

Array = np.ndarray
_STEPS = 4


@dataclass(frozen=True)
class Hypothesis:
    """One explanation: a set of effects, with something without a name beside it or not."""

    effects: OfSet
    unnamed: bool

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects, in alphabetical order."""
        return self.effects.names


def hypotheses(case: OfCase) -> list[Hypothesis]:
    """Return every set of a case, first all without and then all with something unnamed."""
    return [Hypothesis(each, unnamed) for unnamed in (False, True) for each in case.sets]


def log_evidence(case: OfCase, sizes: LearntSizes) -> Array:
    """Return the log evidence of each of :func:`hypotheses`, before the exponent; shape (h,)."""
    usual = sizes.of(case.families)
    pairs = [_evidences(case, each, usual, sizes) for each in case.sets]
    return np.concatenate([[value for value, _ in pairs], [value for _, value in pairs]])


def log_posterior(case: OfCase, sizes: LearntSizes) -> Array:
    """Return the log of the posterior probability of each of :func:`hypotheses`, shape (h,).

    From two likelihoods, each to a power that is learnt (a composite one; Varin, Reid and Firth 2011): the
    evidence, which sees what is small beside the noise, and the size of what is left as it is. A flexible
    misfit may make up for a wrong effect in the first, but not in the second.
    """
    every = hypotheses(case)
    prior = np.array([sizes.log_prior(len(each.names), unnamed=each.unnamed) for each in every])
    power = np.array([each.effects.power for each in every])
    value = sizes.exponent * log_evidence(case, sizes) - 0.5 * sizes.samples * power + prior
    return value - scipy.special.logsumexp(value)


def _evidences(case: OfCase, each: OfSet, usual: Array, sizes: LearntSizes) -> tuple[float, float]:
    """Return the log evidence of one set without something unnamed beside it, and with it."""
    scale = _own_scale(each, sizes)
    plain = _over_misfits(case, each, scale, usual)
    weight = _outlying(case, each, scale, usual, sizes, int(np.argmax(plain)))
    penalty = 0.5 * sizes.tails * float(np.sum(np.log(weight) - weight + 1.0))
    spread = usual / np.sqrt(weight)
    values = [
        scipy.special.logsumexp(_over_misfits(case, each, scale, spread * factor)) + penalty
        for factor in (1.0, np.hypot(1.0, sizes.wide))
    ]
    return float(values[0]), float(values[1])


def _own_scale(each: OfSet, sizes: LearntSizes) -> Array:
    """Return the standard deviations of the parameters, then of the form errors of a set."""
    scale = np.full(each.own.shape[1] - 1, sizes.form_error)
    scale[: each.parameters] = sizes.prior
    return scale


def _over_misfits(case: OfCase, each: OfSet, scale: Array, background: Array) -> Array:
    """Return the log evidence of a set for each size of the misfit, all of them as likely, shape (g,)."""
    inner = case.background * background[:, None] * background[None, :] + np.eye(background.size)
    lower = np.linalg.cholesky(inner)
    determinant = case.log_determinant + 2.0 * np.log(np.diagonal(lower, axis1=1, axis2=2)).sum(axis=1)
    seen = np.linalg.solve(lower, each.with_background * background[:, None])
    products = each.own - seen.transpose(0, 2, 1) @ seen
    return gaussian(products, scale) - 0.5 * determinant - np.log(determinant.size)


def _outlying(
    case: OfCase, each: OfSet, scale: Array, usual: Array, sizes: LearntSizes, misfit: int
) -> Array:
    """Return the precision of each direction of the background over the usual one, shape (b,).

    The background of one recording has longer tails than a normal distribution: Student's, as a mixture of
    normal ones (expectation and maximisation for the weights; Lange, Little and Taylor 1989).
    """
    own, across = each.own[misfit], each.with_background[misfit]
    inner = own[:-1, :-1] * scale[:, None] * scale[None, :] + np.eye(scale.size)
    solved = np.linalg.solve(inner, np.column_stack([(across[:, :-1] * scale).T, own[:-1, -1] * scale]))
    gram = case.background[misfit] - (across[:, :-1] * scale) @ solved[:, :-1]
    score = across[:, -1] - (across[:, :-1] * scale) @ solved[:, -1]
    weight = np.ones(usual.size)
    for _ in range(_STEPS):
        spread = usual / np.sqrt(weight)
        covariance = np.linalg.inv(gram * spread[:, None] * spread[None, :] + np.eye(spread.size))
        power = (covariance @ (score * spread)) ** 2 + np.diag(covariance)
        weight = (sizes.tails + 1.0) / (sizes.tails + power / weight)
    return weight


def gaussian(products: Array, scale: Array) -> Array:
    """Return the log likelihood of a residual, up to what all sets have in common, shape (g,).

    Parameters
    ----------
    products : ndarray, shape (g, k + 1, k + 1)
        Of k columns and the residual, which comes last.
    scale : ndarray, shape (k,)
        Standard deviation of each column's coefficient.
    """
    power = products[:, -1, -1]
    if scale.size == 0:
        return -0.5 * power
    inner = products[:, :-1, :-1] * scale[:, None] * scale[None, :] + np.eye(scale.size)
    lower = np.linalg.cholesky(inner)
    score = (products[:, :-1, -1] * scale)[:, :, None]
    told = np.linalg.solve(lower, score)[:, :, 0]
    return -0.5 * (power - (told**2).sum(axis=1)) - np.log(np.diagonal(lower, axis1=1, axis2=2)).sum(axis=1)


def background_power(case: OfCase, index: int, sizes: LearntSizes) -> Array:
    """Return the expected square of each background coefficient over its variance, given one set.

    Parameters
    ----------
    case : OfCase
    index : int
        Number of the set.
    sizes : LearntSizes

    Returns
    -------
    ndarray, shape (b,)
        1 if the recording says nothing of it: the step of expectation and maximisation for the sizes.
    """
    each, usual = case.sets[index], sizes.of(case.families)
    own_scale = _own_scale(each, sizes)
    count, scale = own_scale.size, np.concatenate([own_scale, usual])
    own, across = each.own[:, :-1, :-1], each.with_background[:, :, :-1]
    gram = np.block([[own, across.transpose(0, 2, 1)], [across, case.background]])
    score = np.concatenate([each.own[:, :-1, -1], each.with_background[:, :, -1]], axis=1) * scale
    inner = gram * scale[:, None] * scale[None, :] + np.eye(scale.size)
    covariance = np.linalg.inv(inner)
    mean = (covariance @ score[:, :, None])[:, :, 0]
    left = each.own[:, -1, -1] - (mean * score).sum(axis=1)
    value = -0.5 * left - 0.5 * np.linalg.slogdet(inner)[1] - 0.5 * case.log_determinant
    weight = scipy.special.softmax(value)
    power = mean**2 + np.diagonal(covariance, axis1=1, axis2=2)
    return np.asarray((weight @ power)[count:])


def position(case: OfCase, names: Sequence[str]) -> int | None:
    """Return the number of the set of some names, or None if it was not enumerated."""
    wanted = tuple(sorted(names))
    return next((i for i, each in enumerate(case.sets) if each.names == wanted), None)
