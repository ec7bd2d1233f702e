"""Tuning as in the thesis, section 4.4.1: the ANN's grid (Tables 4.2, 5.1 to 5.4), the forest's curves.

Cross-validation is stratified on shuffled rows as in the thesis, or by physical tire where the tires are
given. SMOTE, if asked for, is applied to the training part of each fold.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.methods.ann import network_probabilities, standard_scale
from tire_pipeline.classifiers.methods.oversampling import oversample
from tire_pipeline.tasks import Map, all_done, in_turn

TUNING_FOLDS = 4

ANN_GRID: dict[str, tuple[Any, ...]] = {
    "learning_rate": (0.0001, 0.001, 0.01, 0.1),
    "weight_decay": (0.001, 0.01, 0.1, 0.0),
    "epochs": (200, 250, 300, 350),
    "batch_size": (32, 64, 128),
    "optimizer": ("AdamW", "SGD", "RMSprop"),
    "loss": ("CrossEntropyLoss", "MSELoss", "NLLLoss"),
}
"""Table 4.2: 4 x 4 x 4 x 3 x 3 x 3 = 1,728 combinations."""

_BLOCK = 16


def ann_combinations(grid: dict[str, tuple[Any, ...]] | None = None) -> pd.DataFrame:
    """Return all combinations of a grid, one a row."""
    grid = ANN_GRID if grid is None else grid
    return pd.DataFrame(list(product(*grid.values())), columns=list(grid))


def random_combinations(n: int, *, seed: int) -> pd.DataFrame:
    """Draw combinations of Table 4.2 for the random search, none twice."""
    return ann_combinations().sample(n=n, random_state=seed).reset_index(drop=True)


def narrowed_grid(scores: pd.DataFrame, *, best: int = 20) -> dict[str, tuple[Any, ...]]:
    """Keep the values that the best combinations of a random search use more than once.

    Parameters
    ----------
    scores : DataFrame
        From :func:`tune_ann`.
    best : int
        So many combinations by accuracy.

    Returns
    -------
    dict
        As ``ANN_GRID``; the most frequent value where none comes twice.
    """
    top = scores.nlargest(best, "accuracy")
    grid = {}
    for name, values in ANN_GRID.items():
        counts = top[name].value_counts()
        kept = set(counts[counts > 1].index) or {counts.index[0]}
        grid[name] = tuple(value for value in values if value in kept)
    return grid


def folds_of(
    labels: np.ndarray, *, seed: int, tires: np.ndarray | None = None, folds: int = TUNING_FOLDS
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return (training rows, test rows) of each fold: at random, or with no tire on both sides."""
    from sklearn.model_selection import StratifiedGroupKFold, StratifiedKFold

    cls = StratifiedKFold if tires is None else StratifiedGroupKFold
    splitter = cls(folds, shuffle=True, random_state=seed)
    return list(splitter.split(np.zeros(len(labels)), labels, tires))


def tune_ann(
    features: np.ndarray,
    labels: np.ndarray,
    combinations: pd.DataFrame,
    *,
    seed: int = 0,
    tires: np.ndarray | None = None,
    smote: bool = False,
    work: Map = in_turn,
) -> pd.DataFrame:
    """Cross-validate combinations of hyperparameters, many networks side by side.

    What need not be trained twice is not: combinations that differ in the number of epochs only
    are one training looked at several times, and CrossEntropyLoss and NLLLoss are the same function of a
    softmax output, so one training serves both.

    Parameters
    ----------
    features : ndarray, shape (n, d)
    labels : ndarray of str, shape (n,)
    combinations : DataFrame
        Columns of ``ANN_GRID``.
    seed : int
        Of the folds, the networks and SMOTE.
    tires : ndarray, optional
        Physical tire of each row: folds by tire.
    smote : bool
    work : Map
        Trains the networks, some together.

    Returns
    -------
    DataFrame
        The combinations with ``accuracy`` and ``f1`` (weighted), means over the folds, best first.
    """
    classes, numbers = np.unique(np.asarray(labels).astype(str), return_inverse=True)
    parts = [
        _fold(np.asarray(features, dtype=float), numbers, train, test, smote, seed)
        for train, test in folds_of(numbers, seed=seed, tires=tires)
    ]
    tried = combinations.copy()
    tried["trained_loss"] = tried["loss"].replace("NLLLoss", "CrossEntropyLoss")
    jobs = []
    for (batch, optimizer, loss), group in tried.groupby(["batch_size", "optimizer", "trained_loss"]):
        pairs = list(product(set(zip(group["learning_rate"], group["weight_decay"], strict=True)), parts))
        pairs.sort(key=lambda pair: pair[0])
        epochs = sorted({int(number) for number in group["epochs"]})
        for start in range(0, len(pairs), _BLOCK):
            block = pairs[start : start + _BLOCK]
            jobs.append((int(batch), optimizer, loss, epochs, block, len(classes), seed))
    tasks = {f"{number}": partial(_train_block, *job) for number, job in enumerate(jobs)}
    rows = [row for done in all_done(work, tasks, "tuning the ANN").values() for row in done.result()]
    keys = ["batch_size", "optimizer", "trained_loss", "learning_rate", "weight_decay", "epochs"]
    means = pd.DataFrame(rows).groupby(keys, as_index=False)[["accuracy", "f1"]].mean()
    scored = tried.merge(means, on=keys, how="left").drop(columns="trained_loss")
    return scored.sort_values(["accuracy", "f1"], ascending=False, ignore_index=True)


def tune_forest_trees(
    features: np.ndarray,
    labels: np.ndarray,
    *,
    most: int = 100,
    seed: int = 0,
    tires: np.ndarray | None = None,
    smote: bool = False,
) -> pd.DataFrame:
    """Cross-validate forests of 1 to ``most`` trees without a limit on depth (Figure 5.1).

    A forest of k trees is the first k trees of a larger one with the same seed, so each fold needs
    one forest.

    Returns
    -------
    DataFrame
        ``trees``, ``accuracy``, ``f1``: means over the folds.
    """
    rows = []
    for train, test in folds_of(labels, seed=seed, tires=tires):
        forest = _forest(features, labels, train, most, None, smote, seed)
        total = np.zeros((len(test), len(forest.classes_)))
        inputs = np.asarray(features)[test].astype(np.float32)
        for count, tree in enumerate(forest.estimators_, 1):
            total += tree.predict_proba(inputs)
            scores = _scores(labels[test], forest.classes_[total.argmax(axis=1)])
            rows.append({"trees": count, **scores})
    return pd.DataFrame(rows).groupby("trees", as_index=False).mean()


def tune_forest_depth(
    features: np.ndarray,
    labels: np.ndarray,
    *,
    trees: int = 30,
    most: int = 100,
    seed: int = 0,
    tires: np.ndarray | None = None,
    smote: bool = False,
) -> pd.DataFrame:
    """Cross-validate forests of depth 1 to ``most`` (Figure 5.2).

    Once no tree reaches its limit, larger limits give the same forest; it is not trained again.

    Returns
    -------
    DataFrame
        ``depth``, ``accuracy``, ``f1``: means over the folds.
    """
    rows = []
    for train, test in folds_of(labels, seed=seed, tires=tires):
        scores, deepest = {}, most + 1
        for depth in range(1, most + 1):
            if depth <= deepest:
                forest = _forest(features, labels, train, trees, depth, smote, seed)
                predicted = forest.predict(np.asarray(features)[test])
                scores = _scores(labels[test], predicted)
                reached = max(tree.get_depth() for tree in forest.estimators_)
                deepest = depth if reached < depth else most + 1
            rows.append({"depth": depth, **scores})
    return pd.DataFrame(rows).groupby("depth", as_index=False).mean()


def _forest(
    features: np.ndarray,
    labels: np.ndarray,
    train: np.ndarray,
    trees: int,
    depth: int | None,
    smote: bool,
    seed: int,
) -> Any:
    from tire_pipeline.classifiers.methods.random_forest import RandomForest

    part = np.asarray(labels)[train]
    pipeline = RandomForest(trees, depth, smote=smote).estimator(part, seed)
    return pipeline.fit(np.asarray(features)[train], part).named_steps["estimator"]


def _scores(wanted: np.ndarray, predicted: np.ndarray) -> dict[str, float]:
    from sklearn.metrics import accuracy_score, f1_score

    return {
        "accuracy": float(accuracy_score(wanted, predicted)),
        "f1": float(f1_score(wanted, predicted, average="weighted", zero_division=0)),
    }


def _fold(
    features: np.ndarray,
    numbers: np.ndarray,
    train: np.ndarray,
    test: np.ndarray,
    smote: bool,
    seed: int,
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Scaled training rows, their classes, scaled test rows, their classes."""
    rows, wanted = oversample(features[train], numbers[train], smote=smote, seed=seed)
    mean, scale = standard_scale(rows)
    return (rows - mean) / scale, wanted, (features[test] - mean) / scale, numbers[test]


Block = list[tuple[tuple[float, float], tuple[np.ndarray, ...]]]
"""Learning rate and weight decay of each network, and its fold as :func:`_fold` gives it."""


def _train_block(
    batch_size: int,
    optimizer: str,
    loss: str,
    epochs: list[int],
    block: Block,
    n_classes: int,
    seed: int,
) -> list[dict[str, Any]]:
    """Train networks of one batch size, optimiser and loss; score them after each number of epochs."""
    from tire_pipeline.classifiers.methods.network_batch import TrainingSet, train_networks
    from tire_pipeline.numerics.small_networks import one_torch_thread

    with one_torch_thread():
        trained = train_networks(
            [TrainingSet(rows, wanted) for _, (rows, wanted, _, _) in block],
            n_classes=n_classes,
            learning_rates=[rate for (rate, _), _ in block],
            weight_decays=[decay for (_, decay), _ in block],
            seeds=[seed] * len(block),
            optimizer=optimizer,
            loss=loss,
            batch_size=batch_size,
            epochs=epochs,
        )
    shared = {"batch_size": batch_size, "optimizer": optimizer, "trained_loss": loss}
    return [
        {**shared, **row, "epochs": number}
        for number, networks in trained.items()
        for row in _block_scores(block, networks)
    ]


def _block_scores(block: Block, networks: list[Any]) -> Iterator[dict[str, float]]:
    """Score each network of a block on the test rows of its fold."""
    for ((rate, decay), (_, _, test, wanted)), layers in zip(block, networks, strict=True):
        with np.errstate(all="ignore"):  # a rate of 0.1 lets some networks run away
            predicted = network_probabilities(test, layers).argmax(axis=1)
        yield {"learning_rate": rate, "weight_decay": decay, **_scores(wanted, predicted)}
