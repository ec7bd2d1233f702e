"""How far a prediction may be trusted: shorter moves where it is doubtful, and what gain it expects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.stats import norm

from tire_pipeline.translation.curve_mixed import CurveMixedModel, Prediction
from tire_pipeline.translation.curve_space import PARTS

DOUBTFUL = 0.2
"""Mean predicted probability, over a category's training files, that a translation makes the error larger,
beyond which its bias is not told from chance and its files are left alone. On tuning fleets it was 0.25 to
0.34 without any bias, and above 0.2 for two of twenty categories at a third of the calibrated one."""

CAUTION = 0.5
"""Weight of a move's variance against its square in :func:`cautious`."""

ODD_TORQUE = 2.5
"""Root mean square surprise of the aligning torque beyond which its fit has failed."""

_JUDGED = tuple(name for name, part in PARTS.items() if part.group in ("lateral", "longitudinal"))


def cautious(model: CurveMixedModel, found: Prediction) -> Prediction:
    """Shorten the move of each part by how uncertain it is: positive-part shrinkage (Stein) towards no
    change.

    The shrinkage of the mixed model rests on variances that six categories tell little about; this one takes
    each file's move and the variance of its estimate.

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
        doubt = found.shift_variance[:, place].sum(axis=1)
        share = CAUTION * doubt / np.maximum(size + CAUTION * doubt, 1e-12)
        target[:, place] -= share[:, None] * found.shift[:, place]
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


def expected_gain(model: CurveMixedModel, found: Prediction) -> tuple[np.ndarray, np.ndarray]:
    """Expected squared error of the translation over that of no change, and the probability that it is
    larger.

    Parameters
    ----------
    model : CurveMixedModel
    found : Prediction

    Returns
    -------
    ratio, harm : ndarray, shape (n,)
        Over the features of lateral and longitudinal force.
    """
    after = np.zeros(len(found.source))
    move = np.zeros_like(after)
    doubt = np.zeros_like(after)
    for name in _JUDGED:
        place, back = model.space.slices[name], model.space.back[name]
        weight = back @ back.T / back.shape[1]
        step = found.target[:, place] - found.source[:, place]
        after += found.variance[:, place] @ np.diag(weight)
        along = step @ weight
        move += (step * along).sum(axis=1)
        doubt += (along**2 * found.variance[:, place]).sum(axis=1)
    harm = norm.cdf(-0.5 * move / np.sqrt(np.maximum(doubt, 1e-12)))
    return after / np.maximum(after + move, 1e-12), harm
