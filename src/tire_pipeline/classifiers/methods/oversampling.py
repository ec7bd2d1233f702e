"""SMOTE from imbalanced-learn, always inside the training part."""

from __future__ import annotations

from typing import Any

import numpy as np

from tire_pipeline.errors import DomainError


def smote_for(labels: np.ndarray, seed: int) -> Any:
    """Return imbalanced-learn's SMOTE with as many neighbours (at most 5) as the classes allow.

    Parameters
    ----------
    labels : ndarray, shape (n,)
        Labels of the training part.
    seed : int

    Raises
    ------
    DomainError
        If a class has a single row: no neighbour to draw a line to.
    """
    from imblearn.over_sampling import SMOTE

    names, counts = np.unique(labels, return_counts=True)
    least = int(counts.min())
    if least < 2:
        raise DomainError(
            f"SMOTE needs two training rows of every category, {names[counts.argmin()]} has one",
            todo="raise the least number of files a category must have, or switch SMOTE off",
        )
    return SMOTE(k_neighbors=min(5, least - 1), random_state=seed)


def with_smote(estimator: Any, labels: np.ndarray, *, smote: bool, seed: int) -> Any:
    """Put SMOTE before a scikit-learn estimator, in an imbalanced-learn pipeline.

    The pipeline oversamples in ``fit`` only, so it is right inside any cross-validation.
    """
    from imblearn.pipeline import Pipeline

    steps = [("smote", smote_for(labels, seed))] if smote else []
    return Pipeline([*steps, ("estimator", estimator)])


def oversample(
    features: np.ndarray, labels: np.ndarray, *, smote: bool, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the training rows with SMOTE's synthetic ones, or as they are."""
    if not smote:
        return features, labels
    more, more_labels = smote_for(labels, seed).fit_resample(features, labels)
    return np.asarray(more), np.asarray(more_labels)
