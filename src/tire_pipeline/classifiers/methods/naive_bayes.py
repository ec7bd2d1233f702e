"""Gaussian naive Bayes (thesis, 4.4.1).

The thesis says "an uninformative prior was used". That SMOTE lowers its accuracy from 0.801 to 0.765
(Table 5.6) tells that it means scikit-learn's default, no prior given: the classes' shares of the training
rows, which SMOTE makes equal. With equal priors given, SMOTE would change next to nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np

from tire_pipeline.classifiers.methods.oversampling import with_smote

_ARRAYS = ("theta_", "var_", "class_prior_")


class NaiveBayes:
    """scikit-learn's GaussianNB, with its default priors.

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

        pipeline = with_smote(GaussianNB(), labels, smote=self.smote, seed=seed)
        pipeline.fit(features, labels)
        self._fitted = pipeline.named_steps["estimator"]
        self.classes_ = np.asarray(self._fitted.classes_).astype(str)
        return self

    def predict_proba(self, features: np.ndarray) -> np.ndarray:
        """Return the probabilities, shape (n, classes)."""
        probabilities: np.ndarray = self._fitted.predict_proba(np.asarray(features))
        return probabilities

    def to_state(self) -> dict[str, Any]:
        """Return means, variances and priors."""
        arrays = {name: getattr(self._fitted, name) for name in _ARRAYS}
        return {"classifier": self.name, "classes": self.classes_, **arrays}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        from sklearn.naive_bayes import GaussianNB

        back = cls()
        back.classes_ = np.asarray(state["classes"]).astype(str)
        back._fitted = GaussianNB()
        back._fitted.classes_ = back.classes_
        for name in _ARRAYS:
            setattr(back._fitted, name, np.asarray(state[name]))
        back._fitted.n_features_in_ = back._fitted.theta_.shape[1]
        return back
