"""Random forest, the thesis' best classifier: 30 trees of depth 10 (Tables 5.5 and 5.7)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np

from tire_pipeline.classifiers.methods.compiled_forest import CompiledForest, compile_forest
from tire_pipeline.classifiers.methods.oversampling import with_smote
from tire_pipeline.errors import DomainError


class RandomForest:
    """scikit-learn's forest, compiled to arrays once it is trained.

    Parameters
    ----------
    n_trees, max_depth : int
    smote : bool
        Balance the training rows with SMOTE first.
    """

    name: ClassVar[str] = "random_forest"

    def __init__(self, n_trees: int = 30, max_depth: int | None = 10, *, smote: bool = True) -> None:
        self.n_trees = n_trees
        self.max_depth = max_depth
        self.smote = smote
        self.classes_ = np.zeros(0, dtype=str)
        self.forest: CompiledForest | None = None

    def estimator(self, labels: np.ndarray, seed: int) -> Any:
        """Return the untrained imbalanced-learn pipeline: SMOTE, then the forest."""
        from sklearn.ensemble import RandomForestClassifier

        forest = RandomForestClassifier(
            n_estimators=self.n_trees, max_depth=self.max_depth, random_state=seed, n_jobs=1
        )
        return with_smote(forest, labels, smote=self.smote, seed=seed)

    def fit(self, features: np.ndarray, labels: np.ndarray, *, seed: int) -> Self:
        """Train and compile."""
        pipeline = self.estimator(labels, seed).fit(features, labels)
        fitted = pipeline.named_steps["estimator"]
        self.classes_ = np.asarray(fitted.classes_).astype(str)
        self.forest = compile_forest(fitted)
        return self

    def predict_proba(self, features: np.ndarray) -> np.ndarray:
        """Return the probabilities, shape (n, classes)."""
        if self.forest is None:
            raise DomainError("the forest is not trained", todo="call fit(...) first")
        return self.forest.sums(features)

    def to_state(self) -> dict[str, Any]:
        """Return the compiled forest."""
        if self.forest is None:
            raise DomainError("the forest is not trained", todo="call fit(...) first")
        return {"classifier": self.name, "classes": self.classes_, **self.forest.to_state()}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        back = cls()
        back.classes_ = np.asarray(state["classes"]).astype(str)
        back.forest = CompiledForest.from_state(state)
        return back
