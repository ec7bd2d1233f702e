"""Gradient-boosted trees."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np

from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest, compile_trees
from tire_pipeline.classifiers.methods.oversampling import with_smote
from tire_pipeline.errors import DomainError


class GradientBoosting:
    """scikit-learn's GradientBoostingClassifier, compiled to arrays once it is trained.

    Parameters
    ----------
    n_rounds, max_depth : int
    learning_rate : float
    smote : bool
        Balance the training rows with SMOTE first.
    """

    name: ClassVar[str] = "gradient_boosting"

    def __init__(
        self,
        n_rounds: int = 60,
        max_depth: int = 4,
        learning_rate: float = 0.2,
        *,
        smote: bool = True,
    ) -> None:
        self.n_rounds = n_rounds
        self.max_depth = max_depth
        self.learning_rate = learning_rate
        self.smote = smote
        self.classes_ = np.zeros(0, dtype=str)
        self.forest: CompiledForest | None = None
        self.start = np.zeros(0)

    def fit(self, features: np.ndarray, labels: np.ndarray, *, seed: int) -> Self:
        """Train and compile."""
        from sklearn.ensemble import GradientBoostingClassifier

        boosting = GradientBoostingClassifier(
            n_estimators=self.n_rounds,
            max_depth=self.max_depth,
            learning_rate=self.learning_rate,
            subsample=0.7,
            random_state=seed,
        )
        pipeline = with_smote(boosting, labels, smote=self.smote, seed=seed).fit(features, labels)
        fitted = pipeline.named_steps["estimator"]
        self.classes_ = np.asarray(fitted.classes_).astype(str)
        outputs = fitted.estimators_.shape[1]
        trees, values = [], []
        for column in range(outputs):
            for tree in (estimator.tree_ for estimator in fitted.estimators_[:, column]):
                value = np.zeros((tree.node_count, outputs))
                value[:, column] = self.learning_rate * tree.value[:, 0, 0]
                trees.append(tree)
                values.append(value)
        self.forest = compile_trees(trees, values)
        first = np.asarray(features)[:1]
        scores = np.reshape(fitted.decision_function(first), (1, outputs))
        self.start = (scores - self.forest.sums(first))[0]
        return self

    def predict_proba(self, features: np.ndarray) -> np.ndarray:
        """Return the probabilities, shape (n, classes)."""
        if self.forest is None:
            raise DomainError("the trees are not trained", todo="call fit(...) first")
        scores = self.start + self.forest.sums(features)
        if scores.shape[1] == 1:
            scores = np.concatenate([np.zeros_like(scores), scores], axis=1)
        return softmax(scores)

    def to_state(self) -> dict[str, Any]:
        """Return the compiled trees and the start scores."""
        if self.forest is None:
            raise DomainError("the trees are not trained", todo="call fit(...) first")
        return {
            "classifier": self.name,
            "classes": self.classes_,
            "start": self.start,
            **self.forest.to_state(),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        back = cls()
        back.classes_ = np.asarray(state["classes"]).astype(str)
        back.start = np.asarray(state["start"])
        back.forest = CompiledForest.from_state(state)
        return back


def softmax(scores: np.ndarray) -> np.ndarray:
    """Return probabilities along the last axis."""
    powers = np.exp(scores - scores.max(axis=-1, keepdims=True))
    shares: np.ndarray = powers / powers.sum(axis=-1, keepdims=True)
    return shares
