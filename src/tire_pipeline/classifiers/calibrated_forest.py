"""A random forest whose probabilities are calibrated: the agent's reward is a probability."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np

from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest, compile_forest
from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.errors import DomainError

_CURVE_KNOTS = 101


class CalibratedForest:
    """The forest, and one increasing curve a class from its probability to the share that is right.

    scikit-learn's CalibratedClassifierCV learns the curves from out-of-fold probabilities; SMOTE
    is applied inside the folds only.

    Parameters
    ----------
    method : {"sigmoid", "isotonic"}
    n_trees, max_depth : int
    smote : bool
        Balance the training rows of each fold with SMOTE first.
    folds : int
    """

    name: ClassVar[str] = "calibrated"

    def __init__(
        self,
        method: str = "isotonic",
        n_trees: int = 30,
        max_depth: int | None = 10,
        *,
        smote: bool = True,
        folds: int = 5,
    ) -> None:
        if method not in ("sigmoid", "isotonic"):
            raise DomainError(f"there is no calibration {method!r}", todo="choose sigmoid or isotonic")
        self.method = method
        self.n_trees = n_trees
        self.max_depth = max_depth
        self.smote = smote
        self.folds = folds
        self.classes_ = np.zeros(0, dtype=str)
        self.forest: CompiledForest | None = None
        self.curves = np.zeros((0, _CURVE_KNOTS))

    def fit(self, features: np.ndarray, labels: np.ndarray, *, seed: int) -> Self:
        """Train the forest and its calibration curves."""
        from sklearn.calibration import CalibratedClassifierCV
        from sklearn.model_selection import StratifiedKFold

        base = RandomForest(self.n_trees, self.max_depth, smote=self.smote)
        least = int(np.unique(labels, return_counts=True)[1].min())
        folds = StratifiedKFold(max(2, min(self.folds, least)), shuffle=True, random_state=seed)
        parts = [np.asarray(labels)[train] for train, _ in folds.split(features, labels)]
        part = min(parts, key=lambda some: np.unique(some, return_counts=True)[1].min())
        calibrated = CalibratedClassifierCV(
            base.estimator(part, seed), method=self.method, cv=folds, ensemble=False
        ).fit(features, labels)
        self.classes_ = np.asarray(calibrated.classes_).astype(str)
        inner = calibrated.calibrated_classifiers_[0]
        self.forest = compile_forest(inner.estimator.named_steps["estimator"])
        knots = np.linspace(0, 1, _CURVE_KNOTS)
        curves = [calibrator.predict(knots) for calibrator in inner.calibrators]
        if len(curves) == 1:  # two classes share one curve, that of the second class
            curves = [1 - curves[0][::-1], curves[0]]
        self.curves = np.stack(curves)
        return self

    def predict_proba(self, features: np.ndarray) -> np.ndarray:
        """Return the probabilities, shape (n, classes)."""
        if self.forest is None:
            raise DomainError("the forest is not trained", todo="call fit(...) first")
        raw = self.forest.sums(features)
        knots = np.linspace(0, 1, _CURVE_KNOTS)
        curved = np.stack([np.interp(raw[:, k], knots, curve) for k, curve in enumerate(self.curves)], axis=1)
        total = curved.sum(axis=1, keepdims=True)
        return np.where(total > 0, curved / np.where(total > 0, total, 1.0), 1 / len(self.classes_))

    def to_state(self) -> dict[str, Any]:
        """Return the compiled forest and the curves."""
        if self.forest is None:
            raise DomainError("the forest is not trained", todo="call fit(...) first")
        return {
            "classifier": self.name,
            "classes": self.classes_,
            "curves": self.curves,
            **self.forest.to_state(),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        back = cls()
        back.classes_ = np.asarray(state["classes"]).astype(str)
        back.curves = np.asarray(state["curves"], dtype=float)
        back.forest = CompiledForest.from_state(state)
        return back
