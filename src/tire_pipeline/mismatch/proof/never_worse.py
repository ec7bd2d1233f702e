"""The one guard beside the posterior: a correction is added only as far as unseen sweeps confirm it.

It can withhold a correction or a part of it, never choose a name.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.linearised_set import Fit
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.model.blocks import whole_sweeps
from tire_pipeline.mismatch.model.residual import partly, residual
from tire_pipeline.mismatch.proof.left_out import each_left_out
from tire_pipeline.mismatch.proof.nested import FOLDS, RepeatedChoice

Array = np.ndarray


@dataclass(frozen=True)
class Guarded:
    """The correction that may be added to the model.

    Parameters
    ----------
    fit : Fit
        The effects.
    part : float
        The part of what they change that unseen sweeps confirm, above 0 to 1: so much of it is added. 1 where
        there are no effects.
    left : dict of ndarray, shape (n,)
        Output -> the residual, N, of sweeps that neither the choice of what is added nor its fit has seen;
        by what is added, fitted without them, if that leaves more: a repeated choice can be another one.
    agreed : dict of ndarray, shape (n,)
        Output -> share of the effects' change on which the likely explanations agree, 0 to 1; all of it
        where an output is left out.
    """

    fit: Fit
    part: float
    left: dict[str, Array]
    agreed: Mapping[str, Array] = field(default_factory=dict)

    def added(self, output: str) -> Array | float:
        """Return the share of the effects' change that is added, at each sample."""
        return self.part * self.agreed.get(output, 1.0)


def guarded(analysis: Analysis, sets: Enumerated, level: float) -> Guarded:
    """Return the named set without those effects whose correction does not help on unseen sweeps.

    Both have to be confirmed there: the whole choice, made again without them, and the very effects that are
    added, fitted without them. So much of each as is added has to help on average beside the others. The
    effect goes first without which the others leave least.

    Parameters
    ----------
    analysis : Analysis
        With the set that is named.
    sets : Enumerated
    level : float
        Probability from which an effect is named.
    """
    fit, before = analysis.fit, residual(analysis.data, [])
    if not fit.names:
        return Guarded(fit, 1.0, before)
    repeated = RepeatedChoice(sets, analysis.block, level)
    sweep = None if analysis.data.time is None else whole_sweeps(analysis.block)

    def size(left: Mapping[str, Array], part: float = 1.0) -> float:
        return size_over_largest({o: partly(before[o], left[o], part) for o in before}, analysis.largest)

    while fit.names:
        both = (
            repeated.unseen(set(analysis.fit.names) - set(fit.names)).left,
            each_left_out(analysis, fit),
        )
        numbers = range(len(fit.names))
        fewer = [fit.part([j for j in numbers if j != i], analysis.system) for i in numbers]
        without = [each_left_out(analysis, each, refitted=True) for each in fewer]
        part = min(confirmed_part(before, left, analysis.largest, sweep) for left in both)
        if part > 0.0 and all(size(both[1], part) < size(left, part) for left in without):
            left = max(both, key=size)
            return Guarded(fit, part, {o: partly(before[o], left[o], part) for o in before})
        fit = fewer[min(numbers, key=lambda i: size(without[i]))]
    return Guarded(fit, 1.0, before)


def confirmed_part(
    before: Mapping[str, Array], after: Mapping[str, Array], largest: Mapping[str, float], sweep: Array | None
) -> float:
    """Return the part of a change that sweeps confirm which it was predicted without, 0 to 1.

    Each force of each sweep says by how much the change should be multiplied: its product with the residual
    over its square. The mean over the sweeps, each weighed by that square, has a standard error from how they
    differ. One standard error below the mean lies what the true multiple exceeds with 84%, as for
    explanations that are open (:mod:`.corrected.agreed`). A change of less than twice the true one
    leaves less error than none.

    Parameters
    ----------
    before, after : mapping of ndarray, shape (n,)
        Output -> residual without and with the change, N.
    largest : mapping of float
        Output -> largest force, N: each force counts over its largest.
    sweep : ndarray of int, shape (n,), optional
        Sweep of each sample. Without it each sample counts by itself: a recording without a time line.

    Returns
    -------
    float
        0 where one sweep has all of the change: then nothing says how much sweeps differ.
    """
    change = {o: (before[o] - after[o]) / largest[o] for o in after}
    product = np.asarray(sum(change[o] * before[o] / largest[o] for o in after))
    square = np.asarray(sum(change[o] ** 2 for o in after))
    if sweep is not None:
        product, square = np.bincount(sweep, product), np.bincount(sweep, square)
    total = float(square.sum())
    if total <= 0.0:
        return 0.0
    count = total**2 / float(square @ square)  # of sweeps, as if all had the same weight
    if count <= 1.0 + 1e-9:
        return 0.0
    mean = float(product.sum()) / total
    off = product - mean * square
    error = float(np.sqrt((off @ off) * count / (count - 1.0))) / total
    return float(np.clip(mean - error, 0.0, 1.0))


def fifths(block: Array) -> Array:
    """Return in which fifth of the sweeps each sample is, 0 to 4; shape (n,)."""
    return block * FOLDS // (int(block.max()) + 1)


def confirmed_by_later(
    before: Mapping[str, Array], after: Mapping[str, Array], largest: Mapping[str, float], block: Array
) -> float:
    """Return :func:`confirmed_part` by the sweeps after the first fifth, which those before them predict.

    Parameters
    ----------
    before, after, largest
        As for :func:`confirmed_part`, of all samples.
    block : ndarray of int, shape (n,)
        Sweep of each sample.
    """
    later = fifths(block) > 0
    if not later.any():
        return 0.0
    left, changed = ({o: r[later] for o, r in each.items()} for each in (before, after))
    return confirmed_part(left, changed, largest, whole_sweeps(block)[later])


def size_over_largest(left: Mapping[str, Array], largest: Mapping[str, float]) -> float:
    """Mean squared residuals of all forces, each over the square of its largest."""
    return sum(float(np.mean((r / largest[o]) ** 2)) for o, r in left.items())
