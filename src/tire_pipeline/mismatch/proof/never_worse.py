"""The one guard beside the posterior: what does not surely help on unseen sweeps is not added.

It can withhold a correction, never choose a name.
"""

from __future__ import annotations

from collections.abc import Mapping

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
    fit, before = analysis.fit, residual(analysis.data, [])
    if not fit.names:
        return fit, before
    repeated = RepeatedChoice(sets, analysis.block, level)
    sweep = None if analysis.data.time is None else analysis.block

    def size(left: Mapping[str, Array]) -> float:
        return size_over_largest(left, analysis.largest)

    while fit.names:
        both = (
            repeated.unseen(set(analysis.fit.names) - set(fit.names)).left,
            each_left_out(analysis, fit),
        )
        numbers = range(len(fit.names))
        fewer = [fit.part([j for j in numbers if j != i], analysis.system) for i in numbers]
        without = [each_left_out(analysis, each, refitted=True) for each in fewer]
        surely = all(surely_less(before, left, analysis.largest, sweep) for left in both)
        if surely and all(size(both[1]) < size(left) for left in without):
            return fit, max(both, key=size)
        fit = fewer[min(numbers, key=lambda i: size(without[i]))]
    return fit, before


def surely_less(
    before: Mapping[str, Array], after: Mapping[str, Array], largest: Mapping[str, float], sweep: Array | None
) -> bool:
    """Whether all forces together surely have a smaller error on sweeps that are predicted without them.

    Surely: the mean gain of a sweep is above zero by a one-sided t test over the sweeps. A gain that a few
    sweeps make and others lose is no gain elsewhere.

    Parameters
    ----------
    before, after : mapping of ndarray, shape (n,)
        Output -> residual, N.
    largest : mapping of float
        Output -> largest force, N: each force counts over its largest.
    sweep : ndarray of int, shape (n,), optional
        Sweep of each sample. Without it each sample counts by itself: a recording without a time line.
    """
    gain = np.asarray(sum((before[o] ** 2 - after[o] ** 2) / largest[o] ** 2 for o in after))
    if sweep is not None:
        gain = np.bincount(sweep, gain)
    if gain.size < 2:
        return bool(gain.sum() > 0.0)
    return chance_of_no_gain(gain) < CHANCE


def chance_of_no_gain(gain: Array) -> float:
    """Return the chance of a mean gain as large where there is none: one-sided t test over sweeps.

    Parameters
    ----------
    gain : ndarray, shape (sweeps,)
        What goes of the squared error, sweep by sweep; one sweep alone proves nothing.
    """
    if gain.size < 2:
        return 1.0
    error = float(gain.std(ddof=1)) / np.sqrt(gain.size)
    if error == 0.0:
        return 0.0 if gain.mean() > 0.0 else 1.0
    return float(scipy.special.stdtr(gain.size - 1, -gain.mean() / error))


def size_over_largest(left: Mapping[str, Array], largest: Mapping[str, float]) -> float:
    """Mean squared residuals of all forces, each over the square of its largest."""
    return sum(float(np.mean((r / largest[o]) ** 2)) for o, r in left.items())
