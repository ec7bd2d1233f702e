"""How good a classifier is: accuracy, weighted F1, confusion matrix, per class, over trainings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.base import Classifier, make_classifier

TRAININGS = 10
"""Trainings that the thesis averages over (section 4.4.1)."""


@dataclass(frozen=True)
class ClassifierScores:
    """Ten trainings of one classifier on one split.

    Attributes
    ----------
    scores : DataFrame
        One row a training: ``seed``, ``accuracy``, ``f1`` (weighted).
    confusion : DataFrame
        True class (rows) by predicted class (columns), shares of all test rows (Figure 5.3),
        mean of the trainings.
    per_class : DataFrame
        ``precision``, ``recall``, ``f1``, ``rows`` of each class (Table 5.8), mean of the trainings.
    classifiers : list
        The trained classifiers, in the order of the seeds.
    """

    scores: pd.DataFrame
    confusion: pd.DataFrame
    per_class: pd.DataFrame
    classifiers: list[Classifier]

    @property
    def accuracy(self) -> float:
        """Mean accuracy."""
        return float(self.scores["accuracy"].mean())

    @property
    def f1(self) -> float:
        """Mean weighted F1."""
        return float(self.scores["f1"].mean())


def evaluate_classifier(
    name: str,
    features: np.ndarray,
    labels: np.ndarray,
    train: np.ndarray,
    test: np.ndarray,
    *,
    seeds: Sequence[int] = tuple(range(TRAININGS)),
    **options: object,
) -> ClassifierScores:
    """Train a classifier once a seed on one part and measure it on the other.

    Parameters
    ----------
    name : str
        One of ``CLASSIFIERS``.
    features : ndarray, shape (n, d)
    labels : ndarray of str, shape (n,)
    train, test : ndarray of int
        Rows of the two parts.
    seeds : sequence of int
    **options
        Passed to the classifier.
    """
    features, labels = np.asarray(features), np.asarray(labels).astype(str)
    trained = train_many(name, features[train], labels[train], seeds, **options)
    classes = np.unique(labels)
    measured = [
        _measure(one, features[test], labels[test], classes, seed)
        for one, seed in zip(trained, seeds, strict=True)
    ]
    scores = pd.DataFrame([scores for scores, _, _ in measured])
    confusion = np.mean([matrix for _, matrix, _ in measured], axis=0)
    per_class = sum(table for _, _, table in measured) / len(measured)
    return ClassifierScores(
        scores=scores,
        confusion=pd.DataFrame(confusion, index=classes, columns=classes),
        per_class=per_class,
        classifiers=trained,
    )


def train_many(
    name: str,
    features: np.ndarray,
    labels: np.ndarray,
    seeds: Sequence[int],
    **options: object,
) -> list[Classifier]:
    """Train one classifier for each seed; networks side by side."""
    first = make_classifier(name, **options)
    if hasattr(first, "fit_many"):
        many: list[Classifier] = first.fit_many(features, labels, seeds)
        return many
    return [make_classifier(name, **options).fit(features, labels, seed=seed) for seed in seeds]


def compare_classifiers(
    features: np.ndarray,
    labels: np.ndarray,
    splits: Mapping[str, tuple[np.ndarray, np.ndarray]],
    *,
    names: Sequence[str] = ("ann", "naive_bayes", "random_forest"),
    seeds: Sequence[int] = tuple(range(TRAININGS)),
) -> pd.DataFrame:
    """Return the thesis' Table 5.6 on every split: each classifier with and without SMOTE.

    Parameters
    ----------
    splits : mapping
        Name of the split -> (training rows, test rows).

    Returns
    -------
    DataFrame
        ``split``, ``classifier``, ``smote``, ``accuracy``, ``accuracy_std``, ``f1``, ``f1_std``.
    """
    rows = []
    for split, (train, test) in splits.items():
        for name in names:
            for smote in (False, True):
                result = evaluate_classifier(name, features, labels, train, test, seeds=seeds, smote=smote)
                rows.append(
                    {
                        "split": split,
                        "classifier": name,
                        "smote": smote,
                        "accuracy": result.accuracy,
                        "accuracy_std": float(result.scores["accuracy"].std(ddof=0)),
                        "f1": result.f1,
                        "f1_std": float(result.scores["f1"].std(ddof=0)),
                    }
                )
    return pd.DataFrame(rows)


def _measure(
    classifier: Classifier,
    features: np.ndarray,
    labels: np.ndarray,
    classes: np.ndarray,
    seed: int,
) -> tuple[dict[str, float], np.ndarray, pd.DataFrame]:
    from sklearn.metrics import (
        accuracy_score,
        confusion_matrix,
        f1_score,
        precision_recall_fscore_support,
    )

    predicted = classifier.classes_[classifier.predict_proba(features).argmax(axis=1)]
    scores = {
        "seed": seed,
        "accuracy": float(accuracy_score(labels, predicted)),
        "f1": float(f1_score(labels, predicted, average="weighted", zero_division=0)),
    }
    matrix = confusion_matrix(labels, predicted, labels=classes, normalize="all")
    columns = precision_recall_fscore_support(labels, predicted, labels=classes, zero_division=0)
    names = ("precision", "recall", "f1", "rows")
    table = pd.DataFrame(dict(zip(names, columns, strict=True)), index=classes)
    return scores, matrix, table
