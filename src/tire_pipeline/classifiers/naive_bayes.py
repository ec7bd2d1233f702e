"""Gaussian naive Bayes with an uninformative prior (thesis, 4.4.1)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np

from tire_pipeline.classifiers.oversampling import with_smote

_ARRAYS = ("theta_", "var_", "class_prior_")


class NaiveBayes:
    """scikit-learn's GaussianNB; every class has the same prior probability.

    Parameters
    ----------
    smote : bool
        Balance the training rows with SMOTE first.
    """

    name: ClassVar[str] = "naive_bayes"

    def __init__(self, *, smote: bool = True) -> None:
        self.smote = smote
        self.classes_ = np.zeros(0, dtype=str)
        self._fitted: Any = None

    def fit(self, features: np.ndarray, labels: np.ndarray, *, seed: int) -> Self:
        """Estimate mean and variance of every feature in every class."""
        from sklearn.naive_bayes import GaussianNB

        n_classes = len(np.unique(labels))
        bayes = GaussianNB(priors=np.full(n_classes, 1 / n_classes))
        pipeline = with_smote(bayes, labels, smote=self.smote, seed=seed).fit(features, labels)
        self._fitted = pipeline.named_steps["estimator"]
        self.classes_ = np.asarray(self._fitted.classes_).astype(str)
        return self

    def predict_proba(self, features: np.ndarray) -> np.ndarray:
        """Give the probabilities, shape (n, classes)."""
        probabilities: np.ndarray = self._fitted.predict_proba(np.asarray(features))
        return probabilities

    def to_state(self) -> dict[str, Any]:
        """Give means, variances and priors."""
        arrays = {name: getattr(self._fitted, name) for name in _ARRAYS}
        return {"classifier": self.name, "classes": self.classes_, **arrays}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Bring back what :meth:`to_state` gave."""
        from sklearn.naive_bayes import GaussianNB

        back = cls()
        back.classes_ = np.asarray(state["classes"]).astype(str)
        back._fitted = GaussianNB()
        back._fitted.classes_ = back.classes_
        for name in _ARRAYS:
            setattr(back._fitted, name, np.asarray(state[name]))
        back._fitted.n_features_in_ = back._fitted.theta_.shape[1]
        return back
