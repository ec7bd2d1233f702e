"""The one guard beside the posterior: what does not surely help on unseen sweeps is not added.

It can withhold a correction, never choose a name.
"""

from __future__ import annotations

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.linearised_set import Fit
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.left_out import each_left_out
from tire_pipeline.mismatch.proof.nested import RepeatedChoice

Array = np.ndarray


def harmless(analysis: Analysis, sets: Enumerated, level: float) -> tuple[Fit, dict[str, Array]]:
    """Return the named set without those effects whose correction does not surely help on unseen sweeps.

    Both have to help there: the whole choice, made again without them, and the very effects that are added,
    fitted without them. Each of these has to help on average beside the others. The effect goes first
    without which the others leave least.

    Parameters
    ----------
    analysis : Analysis
        With the set that is named.
    sets : Enumerated
    level : float
        Probability from which a name is said.

    Returns
    -------
    Fit
        What is added.
    dict of ndarray, shape (n,)
        Output -> the residual, N, of sweeps that neither the choice of what is added nor its fit has seen;
        by what is added, fitted without them, if that leaves more: a repeated choice can be another one.
    """
    fit = analysis.fit
    if not fit.names:
        return fit, residual(analysis.data, [])
    repeated = RepeatedChoice(sets, analysis.block, level)
    while fit.names:
        both = (
            repeated.unseen(set(analysis.fit.names) - set(fit.names)).left,
            each_left_out(analysis, fit),
        )
        numbers = range(len(fit.names))
        fewer = [fit.part([j for j in numbers if j != i], analysis.system) for i in numbers]
        without = [each_left_out(analysis, each, refitted=True) for each in fewer]
        before = residual(analysis.data, [])
        surely = all(_surely_less(analysis, before, left) for left in both)
        if surely and all(_size(analysis, both[1]) < _size(analysis, left) for left in without):
            return fit, max(both, key=lambda left: _size(analysis, left))
        least = min(numbers, key=lambda i: _size(analysis, without[i]))
        fit = fewer[least]
    return fit, residual(analysis.data, [])


def _surely_less(analysis: Analysis, before: dict[str, Array], after: dict[str, Array]) -> bool:
    """Whether all forces together surely have a smaller error on sweeps that are predicted without them.

    By sweeps, or by the points of a recording without a time line.
    """
    return surely_above_zero(_gains(analysis, before, after))


def surely_above_zero(gain: Array) -> bool:
    """Whether the mean gain of a sweep is above zero by a one-sided t test, shape (sweeps,).

    A gain that a few sweeps make and others lose is no gain elsewhere.
    """
    if gain.size < 2:
        return bool(gain.sum() > 0.0)
    error = float(gain.std(ddof=1)) / np.sqrt(gain.size)
    return bool(gain.mean() > float(scipy.special.stdtrit(gain.size - 1, 1.0 - CHANCE)) * error)


def _gains(analysis: Analysis, before: dict[str, Array], after: dict[str, Array]) -> Array:
    """Return the squared error that goes in each sweep, or point; each force over its largest."""
    each = sum((before[o] ** 2 - after[o] ** 2) / analysis.largest[o] ** 2 for o in after)
    if analysis.data.time is None:
        return np.asarray(each)
    return np.bincount(analysis.block, each, analysis.system.count)


def _size(analysis: Analysis, rest: dict[str, Array]) -> float:
    """Squared residuals of all forces, each over the square of its largest."""
    return sum(float(np.mean((r / analysis.largest[o]) ** 2)) for o, r in rest.items())
