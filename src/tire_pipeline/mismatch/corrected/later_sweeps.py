"""What earlier sweeps say of later ones: whether what goes with time, or turns, holds after the recording."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.linearised_set import Fit, moved
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.proof.left_out import step_without
from tire_pipeline.mismatch.proof.nested import FOLDS
from tire_pipeline.mismatch.proof.never_worse import confirmed_by_later, fifths, size_over_largest

Array = np.ndarray


def confirmed_later(analysis: Analysis, fit: Fit, own: Collection[int]) -> float:
    """Return the part of what goes with time, or turns, that later sweeps confirm, 0 to 1.

    Between sweeps of other times the state at a sweep is known from its neighbours, whatever the true cause.
    After the recording nothing is left to its later side. So each fifth of the sweeps is predicted with
    parameters by those before it. The other effects stay as all sweeps have them. What earlier sweeps do not
    predict, such as a step in the last fifth, or a turn whose angle slips away, is not confirmed.

    Parameters
    ----------
    analysis : Analysis
    fit : Fit
        The effects that are added.
    own : collection of int
        Those of them, by number, that go with time or turn.
    """
    data, count = analysis.data, analysis.system.count
    fold = fifths(np.arange(count))
    before = residual(data, [change for i, change in enumerate(fit.changes) if i not in own])
    whole, after = residual(data, fit.changes), {o: r.copy() for o, r in before.items()}
    of_time = np.array([i in own for i, _ in fit.labels], bool)
    stays = step_without(fit, np.zeros(count, bool))
    for number in range(1, FOLDS):
        step = np.where(of_time, step_without(fit, fold >= number) - stays, 0.0)
        left, rows = residual(data, moved(fit.changes, fit.labels, step)), fold[analysis.block] == number
        for o in after:
            after[o][rows] = left[o][rows]
    later = fold[analysis.block] > 0
    part = confirmed_by_later(before, after, analysis.largest, analysis.block)
    if part == 0.0:
        return 0.0
    predicted, all_of_it = (
        size_over_largest({o: (before[o] - r[o])[later] for o in before}, analysis.largest)
        for r in (after, whole)
    )
    return part * min(1.0, float(np.sqrt(predicted / all_of_it))) if all_of_it > 0.0 else 0.0
