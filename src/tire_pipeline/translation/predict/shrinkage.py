"""Shorter moves where a prediction is uncertain, and what stands in for a torque whose fit failed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tire_pipeline.translation.population.model import CurveMixedModel, Prediction

VARIANCE_WEIGHT = 0.5
"""Weight of a move's variance against its square in :func:`shortened`."""

ODD_TORQUE = 2.5
"""Root mean square surprise of the aligning torque beyond which its fit has failed."""


def shortened(model: CurveMixedModel, found: Prediction) -> Prediction:
    """Shorten the move of each part by how uncertain it is: positive-part shrinkage (Stein) towards no
    change, and by the probability that the source measures otherwise than the target at all.

    The shrinkage of the mixed model rests on variances that six categories tell little about, and that all of
    them share; this one takes each file's move and the variance of its estimate, and what the training files
    say of its own category.

    Parameters
    ----------
    model : CurveMixedModel
    found : Prediction

    Returns
    -------
    Prediction
        With another ``target``.
    """
    target = found.target.copy()
    for place in model.space.slices.values():
        size = (found.shift[:, place] ** 2).sum(axis=1)
        variance = found.shift_variance[:, place].sum(axis=1)
        share = VARIANCE_WEIGHT * variance / np.maximum(size + VARIANCE_WEIGHT * variance, 1e-12)
        moved = target[:, place] - share[:, None] * found.shift[:, place]
        source, differs = found.source[:, place], found.differs[:, place]
        target[:, place] = moved - (1.0 - differs) * (moved - source)
    return replace(found, target=target)


def failed_fits(model: CurveMixedModel, found: Prediction) -> np.ndarray:
    """Tell whose aligning torque is unlike any tire's: a fit that failed, not a bias, (n,)."""
    place = model.space.slices["aligning torque"]
    return np.sqrt((found.surprise[:, place] ** 2).mean(axis=1)) > ODD_TORQUE


def without_failed_fits(model: CurveMixedModel, found: Prediction) -> Prediction:
    """Where the aligning torque's fit failed, take what the target would measure of such a tire instead."""
    failed, place = failed_fits(model, found), model.space.slices["aligning torque"]
    target = found.target.copy()
    target[failed, place] = found.expected[failed, place]
    return replace(found, target=target)
