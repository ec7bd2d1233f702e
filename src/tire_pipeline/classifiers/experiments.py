"""The thesis' experiments on classifiers, as tables: Figures 4.1, 4.2, 5.4 to 5.8 and Table 5.9."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.evaluate import TRAININGS, evaluate_classifier
from tire_pipeline.classifiers.methods.oversampling import oversample
from tire_pipeline.progress import track
from tire_pipeline.representations import make_representation
from tire_pipeline.tire_table import Binning

Splits = Mapping[str, tuple[np.ndarray, np.ndarray]]

REPRESENTATION_NAMES = ("coefficients", "key_attributes", "latent", "power_series")
BINS_TRIED = tuple(range(2, 41, 2))
LATENT_COUNTS = tuple(range(1, 17))


def class_distribution(
    features: np.ndarray, labels: np.ndarray, splits: Splits, *, seed: int = 0
) -> pd.DataFrame:
    """Count the rows of every category: all, and the training part before and after SMOTE.

    Returns
    -------
    DataFrame
        ``split``, ``category``, ``all``, ``training``, ``training_smote``.
    """
    labels = np.asarray(labels).astype(str)
    parts = []
    for split, (train, _) in splits.items():
        _, more = oversample(np.asarray(features)[train], labels[train], smote=True, seed=seed)
        counts = pd.DataFrame(
            {
                "all": pd.Series(labels).value_counts(),
                "training": pd.Series(labels[train]).value_counts(),
                "training_smote": pd.Series(more).value_counts(),
            }
        ).fillna(0)
        counts = counts.astype(int).rename_axis("category").sort_index().reset_index()
        counts.insert(0, "split", split)
        parts.append(counts)
    return pd.concat(parts, ignore_index=True)


def accuracy_by_bins(
    table: pd.DataFrame,
    splits: Splits,
    *,
    representations: Mapping[str, Mapping[str, Any]] | Sequence[str] = REPRESENTATION_NAMES,
    bins: Iterable[int] = BINS_TRIED,
    seeds: Sequence[int] = tuple(range(TRAININGS)),
) -> pd.DataFrame:
    """Measure the forest on every representation for every number of bins (Figures 5.5 to 5.8).

    Parameters
    ----------
    table : DataFrame
        Tire table at one nominal load.
    splits : mapping
        Name -> (training rows, test rows). Representation and bins are fitted on the training rows.
    representations : sequence of names, or mapping from name to options
    bins : iterable of int
    seeds : sequence of int
        One forest each.

    Returns
    -------
    DataFrame
        ``split``, ``representation``, ``bins``, ``features``, ``accuracy``, ``accuracy_std``, ``f1``,
        ``f1_std``. The rows with 10 bins are Table 5.9.
    """
    options = (
        representations if isinstance(representations, Mapping) else {name: {} for name in representations}
    )
    rows = []
    for split, (train, test) in splits.items():
        for name, own in options.items():
            representation = make_representation(name, **own).fit(table.iloc[train], seed=seeds[0])
            features = representation.encode(table)
            for count in track(list(bins), f"bins of {name}, {split} split"):
                scores = _binned_scores(features, table, train, test, count, seeds)
                rows.append({"split": split, "representation": name, "bins": count, **scores})
    return pd.DataFrame(rows)


def accuracy_by_latent_features(
    table: pd.DataFrame,
    splits: Splits,
    *,
    counts: Iterable[int] = LATENT_COUNTS,
    bins: int = 10,
    seeds: Sequence[int] = tuple(range(TRAININGS)),
    **options: Any,
) -> pd.DataFrame:
    """Measure the forest on 1 to 16 latent features (Figure 5.4).

    Returns
    -------
    DataFrame
        As :func:`accuracy_by_bins`; ``features`` is the number of latent features.
    """
    rows = []
    for split, (train, test) in splits.items():
        for count in track(list(counts), f"latent features, {split} split"):
            latent = make_representation("latent", n_features=count, **options)
            features = latent.fit(table.iloc[train], seed=seeds[0]).encode(table)
            scores = _binned_scores(features, table, train, test, bins, seeds)
            rows.append({"split": split, "representation": "latent", "bins": bins, **scores})
    return pd.DataFrame(rows)


def _binned_scores(
    features: np.ndarray,
    table: pd.DataFrame,
    train: np.ndarray,
    test: np.ndarray,
    count: int,
    seeds: Sequence[int],
) -> dict[str, float]:
    binned = Binning.fit(features[train], count).transform(features)
    labels = table["category"].to_numpy().astype(str)
    result = evaluate_classifier("random_forest", binned, labels, train, test, seeds=seeds)
    return {
        "features": features.shape[1],
        "accuracy": result.accuracy,
        "accuracy_std": float(result.scores["accuracy"].std(ddof=0)),
        "f1": result.f1,
        "f1_std": float(result.scores["f1"].std(ddof=0)),
    }
