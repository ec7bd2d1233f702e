"""Predict which organisation measured a tire: three classifiers, each on both splits."""

from __future__ import annotations

from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.evaluate import ClassifierScores, evaluate_classifier
from tire_pipeline.classifiers.parameters import TrainClassifierParameters
from tire_pipeline.tasks import Labelled, Map, all_done, in_turn

SPLITS = ("random", "by_tire")
SPLIT_WORDS = {"random": "random split", "by_tire": "split by physical tire"}
NAMES = ("ann", "random_forest", "naive_bayes")
CLASSIFIER_WORDS = {"ann": "neural network", "random_forest": "random forest", "naive_bayes": "naive Bayes"}
_NOT_FEATURES = ["file", "category", "tire_id"]


def split_rows(table: pd.DataFrame, splits: pd.DataFrame, split: str) -> tuple[np.ndarray, np.ndarray]:
    """Row numbers of the training and the test part of one split."""
    part = splits.set_index("file").loc[table["file"], split].to_numpy()
    return np.flatnonzero(part == "train"), np.flatnonzero(part == "test")


def score_classifiers(
    features: pd.DataFrame,
    splits: pd.DataFrame,
    parameters: TrainClassifierParameters,
    seed: int,
    *,
    work: Map = in_turn,
) -> pd.DataFrame:
    """Accuracy and weighted F1 of each classifier on both splits (thesis, Table 5.6).

    Parameters
    ----------
    features : DataFrame
        ``file, category, tire_id`` and the features, without bins.
    splits : DataFrame
        ``file, random, by_tire``.
    parameters : TrainClassifierParameters
    seed : int
    work : Map
        Does the trainings.

    Returns
    -------
    DataFrame
        ``features, classifier, split, smote, accuracy, accuracy_std, f1, f1_std, trainings``.
    """
    values, labels = _arrays(features)
    seeds = range(seed, seed + parameters.trainings)
    tasks = {}
    for name, split in product(NAMES, SPLITS):
        rows = split_rows(features, splits, split)
        options = {"seeds": seeds, **parameters.options(name)}
        label = f"{CLASSIFIER_WORDS[name]}, {SPLIT_WORDS[split]}"
        task = partial(evaluate_classifier, name, values, labels, *rows, **options)
        tasks[label] = Labelled(label, task, steps=name == "ann")
    done = all_done(work, tasks, "training classifiers").values()
    scored = [
        _score_row("as they are", name, split, parameters, each.result())
        for (name, split), each in zip(product(NAMES, SPLITS), done, strict=True)
    ]
    return pd.DataFrame(scored)


def train_forest(
    binned_features: pd.DataFrame,
    binned_features_by_tire: pd.DataFrame,
    splits: pd.DataFrame,
    parameters: TrainClassifierParameters,
    seed: int,
) -> tuple[dict[str, Any], pd.DataFrame, pd.DataFrame, pd.DataFrame]:
    """Train the agent's forest on bins, and measure it on both splits.

    Parameters
    ----------
    binned_features, binned_features_by_tire : DataFrame
        Bin numbers, by the training set of each split.
    splits : DataFrame
    parameters : TrainClassifierParameters
    seed : int

    Returns
    -------
    classifier : dict
        State of the forest trained on the random split (the thesis' one).
    scores : DataFrame
        As :func:`score_classifiers`.
    per_class : DataFrame
        ``split, category, precision, recall, f1, rows``.
    confusion : DataFrame
        ``split, true, predicted, share``: shares of each true category.
    """
    seeds = range(seed, seed + parameters.trainings)
    results: dict[str, ClassifierScores] = {}
    for split, table in zip(SPLITS, (binned_features, binned_features_by_tire), strict=True):
        values, labels = _arrays(table)
        train, test = split_rows(table, splits, split)
        results[split] = evaluate_classifier(
            "random_forest", values, labels, train, test, seeds=seeds, **parameters.options("random_forest")
        )
    scores = [_score_row("in bins", "random_forest", s, parameters, r) for s, r in results.items()]
    per_class = pd.concat(
        [r.per_class.rename_axis("category").reset_index().assign(split=s) for s, r in results.items()]
    )
    first = ["split", "category"]
    per_class = per_class[first + [c for c in per_class.columns if c not in first]]
    state = results["random"].classifiers[0].to_state()
    return state, pd.DataFrame(scores), per_class, _confusion(results)


def join_scores(features: pd.DataFrame, bins: pd.DataFrame) -> pd.DataFrame:
    """One table of scores."""
    return pd.concat([features, bins], ignore_index=True)


def _confusion(results: dict[str, ClassifierScores]) -> pd.DataFrame:
    parts = []
    for split, result in results.items():
        shares = result.confusion.div(result.confusion.sum(axis=1), axis=0).fillna(0.0)
        long = shares.rename_axis(index="true", columns="predicted").stack().rename("share")
        parts.append(long.reset_index().assign(split=split))
    return pd.concat(parts, ignore_index=True)[["split", "true", "predicted", "share"]]


def _arrays(table: pd.DataFrame) -> tuple[np.ndarray, np.ndarray]:
    values = table.drop(columns=_NOT_FEATURES).to_numpy(dtype=float)
    return values, table["category"].to_numpy(dtype=str)


def _score_row(
    features: str, name: str, split: str, parameters: TrainClassifierParameters, result: ClassifierScores
) -> dict[str, Any]:
    return {
        "features": features,
        "classifier": name,
        "split": split,
        "smote": parameters.smote,
        "accuracy": result.accuracy,
        "accuracy_std": float(result.scores["accuracy"].std(ddof=0)),
        "f1": result.f1,
        "f1_std": float(result.scores["f1"].std(ddof=0)),
        "trainings": parameters.trainings,
    }
