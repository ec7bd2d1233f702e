"""Moments at which the force jumps. The derivative with respect to one is a spike, so they are tried."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import RecordingProducts
from tire_pipeline.mismatch.inference.sets.objective import (
    negative_log_posterior,
    normal_equations,
)
from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.model.forces import Change

Array = np.ndarray
Free = Sequence[tuple[str, ...]]


def with_likeliest_moments(
    products: RecordingProducts, likelihood: Likelihood, changes: list[Change], free: Free
) -> tuple[list[Change], float]:
    """Return a set with its moments where they are likeliest, and what that gains in log posterior.

    From half of the way between two starts down to a sample; each width is tried until it gains nothing more.

    Parameters
    ----------
    products : RecordingProducts
    likelihood : Likelihood
    changes : list of (name, parameters)
    free : sequence of tuple of str
        Parameters of each effect that float.
    """
    data, effects = products.data, catalogue()
    moments = _moments(changes, free)
    if not moments:
        return changes, 0.0
    assert data.time is not None  # the effect needs a time line
    first = best = negative_log_posterior(products, likelihood, changes, free)
    for i, moment in moments:
        effect = effects[changes[i][0]]
        begun_from = {s[moment] for s in effect.starts(data) if moment in effect.free(data, s)}
        width = 0.5 * float(np.min(np.diff(sorted(begun_from))))
        while width > data.sampling:
            nearer = [_with_moment(changes, i, moment, sign * width, data.time) for sign in (1.0, -1.0)]
            costs = [negative_log_posterior(products, likelihood, trial, free) for trial in nearer]
            if min(costs) < best:
                changes, best = nearer[int(np.argmin(costs))], min(costs)
            else:
                width *= 0.5
    return changes, first - best


def log_spread(
    products: RecordingProducts, likelihood: Likelihood, changes: list[Change], free: Free
) -> float:
    """Return the log of how much wider moments spread, all else held, than their derivatives say.

    Where the slip is small a moment hardly matters, and the derivative at one says nothing of the others. The
    posterior over a moment is integrated from sample to sample, farther and farther, until it has no mass.

    Parameters
    ----------
    products, likelihood, changes, free
        As for :func:`with_likeliest_moments`.
    """
    return sum(_log_spread(products, likelihood, changes, *each) for each in _moments(changes, free))


def _log_spread(
    products: RecordingProducts, likelihood: Likelihood, changes: list[Change], i: int, moment: str
) -> float:
    data, time = products.data, products.data.time
    assert time is not None  # the effect needs a time line
    only: list[tuple[str, ...]] = [(moment,) if j == i else () for j in range(len(changes))]
    at = normal_equations(products, likelihood, changes, only)
    information = float(at.inner[0, 0]) + 1.0  # with the prior's
    near, here = likelihood.at(at.weights), changes[i][1][moment]
    best = negative_log_posterior(products, near, changes, only)
    odds = {0.0: 1.0}
    for step in (-data.sampling, data.sampling):
        last, later = 1.0, step
        while last > CHANCE and time[0] < here + later < time[-1]:
            trial = _with_moment(changes, i, moment, later, time)
            last = odds[later] = float(np.exp(best - negative_log_posterior(products, near, trial, only)))
            later += later
    seconds = np.array(sorted(odds))
    mass = float(np.trapezoid([odds[s] for s in seconds], seconds))
    return float(np.log(mass * np.sqrt(information / (2.0 * np.pi)) / at.wide[0]))


def _moments(changes: Sequence[Change], free: Free) -> list[tuple[int, str]]:
    """Return (index of effect, parameter) of the moments that float."""
    return [(i, m) for i, (name, _) in enumerate(changes) for m in catalogue()[name].stepped if m in free[i]]


def _with_moment(changes: Sequence[Change], i: int, moment: str, later: float, time: Array) -> list[Change]:
    """Return the same with a moment of one effect later by some seconds, within the recording."""
    name, p = changes[i]
    there = float(np.clip(p[moment] + later, time[0], time[-1]))
    return [*changes[:i], (name, {**p, moment: there}), *changes[i + 1 :]]
