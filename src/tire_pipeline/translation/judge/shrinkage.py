"""How far a prediction may be trusted: shorter moves where it is doubtful, and what gain it expects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.stats import norm

from tire_pipeline.translation.curves.space import PARTS
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction

DOUBTFUL = 0.2
"""Doubt beyond which a category's bias is not told from chance and its files are left alone, see
:func:`pooled_doubt`. On ten tuning fleets without any bias the least of a category was 0.22; at 0.15 of the
calibrated bias the largest was 0.19, at 0.3 it was 0.17."""

POOLED = 2.0 / 3.0
"""How far a category's doubt is drawn towards the mean of all categories'. A category's own doubt alone tells
little: it was 0.17 to 0.35 without any bias and up to 0.22 at 0.3 of the calibrated one."""

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


def pooled_doubt(
    harm: np.ndarray, category: np.ndarray, categories: tuple[str, ...], target: str
) -> np.ndarray:
    """Give the probability that translating a category's files makes their error larger, (categories,).

    The mean over its files, drawn towards the mean over all categories: whether anyone differs from the
    target at all is told by all of them together.

    Parameters
    ----------
    harm : ndarray, shape (n,)
        That probability for each training file, see :func:`expected_gain`.
    category : ndarray of str, shape (n,)
        Who measured it.
    categories : tuple of str
        Each has files.
    target : str
        Has no doubt: 0.
    """
    own = np.array([harm[category == name].mean() for name in categories])
    others = np.array(categories) != target
    return np.where(others, own + POOLED * (own[others].mean() - own), 0.0)
