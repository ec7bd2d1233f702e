"""What a translation is expected to gain, and how probably it makes the error larger."""

from __future__ import annotations

import numpy as np
from scipy.special import ndtr

from tire_pipeline.numerics.row_products import by_row
from tire_pipeline.translation.curves.space import PARTS
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction

MOST_HARM = 0.2
"""Probability of harm beyond which a category's bias counts as chance and its files are left alone,
see :func:`pooled_harm`. On ten tuning fleets without any bias the least of a category was 0.22; at 0.15 of
the calibrated bias the largest was 0.19, at 0.3 it was 0.17."""

POOLED = 2.0 / 3.0
"""How far a category's probability of harm is shrunk towards the mean of all categories'. Its own alone tells
little: it was 0.17 to 0.35 without any bias and up to 0.22 at 0.3 of the calibrated one."""

_JUDGED = tuple(name for name, part in PARTS.items() if part.group in ("lateral", "longitudinal"))


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
    move_variance = np.zeros_like(after)
    for name in _JUDGED:
        place, back = model.space.slices[name], model.space.back[name]
        weight = back @ back.T / back.shape[1]
        step = found.target[:, place] - found.source[:, place]
        after += by_row(found.variance[:, place], np.diag(weight)[:, None])[:, 0]
        along = by_row(step, weight)
        move += (step * along).sum(axis=1)
        move_variance += (along**2 * found.variance[:, place]).sum(axis=1)
    harm = ndtr(-0.5 * move / np.sqrt(np.maximum(move_variance, 1e-12)))
    return after / np.maximum(after + move, 1e-12), harm


def pooled_harm(
    harm: np.ndarray, category: np.ndarray, categories: tuple[str, ...], target: str
) -> np.ndarray:
    """Return the probability that translating a category's files makes their error larger, (categories,).

    The mean over its files, shrunk towards the mean over all categories: whether anyone differs from the
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
        0: its files are not translated.
    """
    own = np.array([harm[category == name].mean() for name in categories])
    others = np.array(categories) != target
    return np.where(others, own + POOLED * (own[others].mean() - own), 0.0)
