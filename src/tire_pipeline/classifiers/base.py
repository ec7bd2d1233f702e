"""What every classifier offers, and how to get one by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Protocol, Self

import numpy as np

from tire_pipeline.on_demand import class_by_name

CLASSIFIERS: dict[str, tuple[str, str]] = {
    "random_forest": ("tire_pipeline.classifiers.methods.random_forest", "RandomForest"),
    "naive_bayes": ("tire_pipeline.classifiers.methods.naive_bayes", "NaiveBayes"),
    "ann": ("tire_pipeline.classifiers.methods.ann", "Ann"),
    "gradient_boosting": ("tire_pipeline.classifiers.methods.gradient_boosting", "GradientBoosting"),
    "calibrated": ("tire_pipeline.classifiers.calibrated_forest", "CalibratedForest"),
}
"""Name of a classifier -> module and class; imported only when asked for."""


class Classifier(Protocol):
    """Gives every row a probability for each class."""

    name: ClassVar[str]
    classes_: np.ndarray

    def fit(self, features: np.ndarray, labels: np.ndarray, *, seed: int) -> Self:
        """Train.

        Parameters
        ----------
        features : ndarray, shape (n, d)
        labels : ndarray of str, shape (n,)
        seed : int
            Seed of SMOTE and of the training.
        """
        ...

    def predict_proba(self, features: np.ndarray) -> np.ndarray:
        """Return the probabilities, shape (n, classes), columns in the order of ``classes_``."""
        ...

    def to_state(self) -> dict[str, Any]:
        """Return the arrays, strings and numbers that restore the trained classifier."""
        ...

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned; predicts the same, cannot be trained further."""
        ...


def make_classifier(name: str, **options: Any) -> Classifier:
    """Make a classifier that is not trained yet.

    Parameters
    ----------
    name : str
        One of ``CLASSIFIERS``.
    **options
        Passed to its constructor; all take ``smote: bool``.

    Raises
    ------
    DomainError
        If there is none of that name.
    """
    classifier: Classifier = class_by_name(CLASSIFIERS, name, "classifier")(**options)
    return classifier


def classifier_from_state(state: Mapping[str, Any]) -> Classifier:
    """Restore any classifier from its ``to_state()``."""
    classifier: Classifier = class_by_name(CLASSIFIERS, str(state["classifier"]), "classifier").from_state(
        state
    )
    return classifier
