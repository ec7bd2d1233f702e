"""The thesis' experiments on classifiers in parts that can be run, stored and resumed one by one.

Every function gives tables by name; their rows say which split and configuration they are of, so that
the parts of one experiment are put together by appending.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.evaluate import evaluate_classifier
from tire_pipeline.classifiers.experiments import (
    accuracy_by_bins,
    accuracy_by_latent_features,
    class_distribution,
)
from tire_pipeline.classifiers.reliability import expected_calibration_error, reliability_curve
from tire_pipeline.classifiers.tuning import narrowed_grid, tune_ann, tune_forest_depth, tune_forest_trees
from tire_pipeline.representations import make_representation
from tire_pipeline.representations.power_series_condition import condition_numbers

TrainingAndTestRows = tuple[np.ndarray, np.ndarray]

THESIS_CLASSIFIERS = ("ann", "naive_bayes", "random_forest")
FURTHER_CLASSIFIERS = ("gradient_boosting", "calibrated")


def features_of(table: pd.DataFrame) -> np.ndarray:
    """Return the 11 lateral coefficients that the thesis' classifiers see, shape (n, 11)."""
    return make_representation("coefficients").fit(table).encode(table)


def tires_of(table: pd.DataFrame, split: str) -> np.ndarray | None:
    """Return the physical tires for folds by tire, nothing for folds at random."""
    return table["tire_id"].to_numpy() if split == "by_tire" else None


def _labels(table: pd.DataFrame) -> np.ndarray:
    return table["category"].to_numpy().astype(str)


def class_counts(
    table: pd.DataFrame, splits: Mapping[str, TrainingAndTestRows], *, seed: int
) -> dict[str, pd.DataFrame]:
    """Files of each category, before and after SMOTE (Figures 4.1, 4.2)."""
    return {"class_counts": class_distribution(features_of(table), _labels(table), splits, seed=seed)}


def tuned_networks(
    table: pd.DataFrame, split: str, combinations: pd.DataFrame, *, seed: int
) -> dict[str, pd.DataFrame]:
    """Cross-validated accuracy of the ANN's hyperparameters (Tables 5.1, 5.3).

    Parameters
    ----------
    table : DataFrame
        Tire table at one nominal load.
    split : {"random", "by_tire"}
        Kind of the folds.
    combinations : DataFrame
        Columns of Table 4.2.
    seed : int
    """
    scores = tune_ann(
        features_of(table), _labels(table), combinations, seed=seed, tires=tires_of(table, split)
    )
    return {"ann": scores.assign(split=split)}


def kept_values(scores: pd.DataFrame, *, best: int = 20) -> dict[str, tuple[Any, ...]]:
    """Return the values that the best combinations share (Table 5.2), also those that Table 4.2 lacks."""
    kept = narrowed_grid(scores, best=best)
    top = scores.nlargest(best, "accuracy")
    return {name: values or tuple(sorted(set(top[name]))) for name, values in kept.items()}


def tuned_forest(
    table: pd.DataFrame, split: str, *, trees: int, most_trees: int, most_depth: int, seed: int
) -> dict[str, pd.DataFrame]:
    """Cross-validated accuracy over trees, then over depth with ``trees`` trees (Figures 5.1, 5.2)."""
    features, labels, tires = features_of(table), _labels(table), tires_of(table, split)
    by_trees = tune_forest_trees(features, labels, most=most_trees, seed=seed, tires=tires)
    by_depth = tune_forest_depth(features, labels, trees=trees, most=most_depth, seed=seed, tires=tires)
    return {"forest_trees": by_trees.assign(split=split), "forest_depth": by_depth.assign(split=split)}


def compared(
    table: pd.DataFrame,
    rows: TrainingAndTestRows,
    *,
    split: str,
    classifier: str,
    smote: bool,
    seeds: Sequence[int],
    options: Mapping[str, Any] | None = None,
) -> dict[str, pd.DataFrame]:
    """Train one classifier several times and measure it (Tables 5.6, 5.8, Figure 5.3), and its calibration.

    Returns
    -------
    dict of DataFrame
        ``scores`` (one row a training), ``per_class``, ``confusion`` (shares of all test rows),
        ``reliability`` (all trainings together), ``calibration`` (``ece``, mean over the trainings).
    """
    features, labels = features_of(table), _labels(table)
    train, test = rows
    own = dict(options or {})
    result = evaluate_classifier(classifier, features, labels, train, test, seeds=seeds, smote=smote, **own)
    which = {"split": split, "classifier": classifier, "smote": smote}
    given = [(one, one.predict_proba(features[test])) for one in result.classifiers]
    curves = [reliability_curve(shares, labels[test], one.classes_) for one, shares in given]
    everything = np.concatenate([shares for _, shares in given])
    truth = np.tile(labels[test], len(given))
    pooled = reliability_curve(everything, truth, result.classifiers[0].classes_)
    confusion = result.confusion.rename_axis(index="true", columns="predicted").stack().rename("share")
    errors = [expected_calibration_error(curve) for curve in curves]
    return {
        "scores": result.scores.assign(**which),
        "per_class": result.per_class.rename_axis("category").reset_index().assign(**which),
        "confusion": confusion.reset_index().assign(**which),
        "reliability": pooled.assign(**which),
        "calibration": pd.DataFrame({"seed": list(seeds), "ece": errors}).assign(**which),
    }


def by_bins(
    table: pd.DataFrame,
    rows: TrainingAndTestRows,
    *,
    split: str,
    representation: str,
    bins: Sequence[int],
    seeds: Sequence[int],
    options: Mapping[str, Any] | None = None,
) -> dict[str, pd.DataFrame]:
    """Accuracy of the forest against the number of bins (Figures 5.5 to 5.8, Table 5.9)."""
    chosen = {representation: dict(options or {})}
    return {
        "bins": accuracy_by_bins(table, {split: rows}, representations=chosen, bins=bins, seeds=list(seeds))
    }


def by_latent_features(
    table: pd.DataFrame,
    rows: TrainingAndTestRows,
    *,
    split: str,
    count: int,
    bins: int,
    seeds: Sequence[int],
    options: Mapping[str, Any] | None = None,
) -> dict[str, pd.DataFrame]:
    """Accuracy of the forest on ``count`` latent features (Figure 5.4)."""
    return {
        "latent": accuracy_by_latent_features(
            table, {split: rows}, counts=(count,), bins=bins, seeds=list(seeds), **dict(options or {})
        )
    }


def power_series_condition(table: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """How ill-conditioned both forms of the power series are."""
    return {"condition": condition_numbers(table)}
