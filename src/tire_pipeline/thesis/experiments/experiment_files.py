"""Nodes of the experiments on classifiers: say which parts there are; the dataset runs those not stored."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from inspect import getsource
from itertools import product
from typing import Any

import pandas as pd

from tire_pipeline.classifiers.score_on_splits import SPLITS, split_rows
from tire_pipeline.classifiers.tuning import (
    ANN_GRID,
    ann_combinations,
    random_combinations,
)
from tire_pipeline.code_hash import code_hash
from tire_pipeline.files.read_later import FilesToMake, StoredFiles
from tire_pipeline.tasks import Labelled
from tire_pipeline.thesis.experiments import classifier_experiments as experiments
from tire_pipeline.thesis.experiments import files
from tire_pipeline.thesis.experiments.classifier_experiments import FURTHER_CLASSIFIERS, THESIS_CLASSIFIERS
from tire_pipeline.thesis.parameters import AnnSearchParameters, ReproduceThesisParameters

CODE = ("classifiers", "representations", "tire_table")
_JOBS = ["batch_size", "optimizer"]


def _code() -> str:
    return code_hash(*CODE) + files.key_of(getsource(experiments))


def _part(
    name: str, function: Callable[..., Any], table: pd.DataFrame, *arguments: Any, **options: Any
) -> FilesToMake:
    key = files.key_of(_code(), name, table, *arguments, options)
    task = partial(files.computed, function, table, *arguments, **options)
    return {f"{name}_{key}.npz": Labelled(name.replace("_", " "), task)}


def count_classes(
    normalized_table: pd.DataFrame, splits: pd.DataFrame, parameters: ReproduceThesisParameters, seed: int
) -> FilesToMake:
    """Figures 4.1 and 4.2."""
    rows = {split: split_rows(normalized_table, splits, split) for split in SPLITS}
    key = files.key_of(_code(), normalized_table, splits, seed)
    return {
        f"{key}.npz": partial(files.computed, experiments.class_counts, normalized_table, rows, seed=seed)
    }


def search_at_random(
    normalized_table: pd.DataFrame, parameters: ReproduceThesisParameters, seed: int
) -> FilesToMake:
    """Random search over the ANN's hyperparameters (Table 5.1), on folds of both kinds."""
    combinations = _epochs(random_combinations(parameters.ann.random, seed=seed), parameters.ann)
    work: FilesToMake = {}
    for split in SPLITS:
        work |= network_parts(f"{split}", normalized_table, split, combinations, seed)
    return work


def search_the_grid(
    searched: StoredFiles, normalized_table: pd.DataFrame, parameters: ReproduceThesisParameters, seed: int
) -> FilesToMake:
    """Search the grid of the ANN's hyperparameters (Table 5.3): whole, or what the random search leaves.

    Parameters
    ----------
    searched : mapping
        Parts of :func:`search_at_random`.
    normalized_table : DataFrame
    parameters : ReproduceThesisParameters
    seed : int
    """
    found = together(searched)["ann"]
    work: FilesToMake = {}
    for split in SPLITS:
        if split not in parameters.ann.whole_grid:
            own = found[found["split"] == split]
            combinations = ann_combinations(experiments.kept_values(own, best=parameters.ann.best))
        else:
            combinations = _epochs(ann_combinations(), parameters.ann)
        work |= network_parts(f"{split}", normalized_table, split, combinations, seed)
    return work


def _epochs(combinations: pd.DataFrame, parameters: AnnSearchParameters) -> pd.DataFrame:
    """Other numbers of epochs than Table 4.2's, in its order, for a quick run."""
    if parameters.epochs is None:
        return combinations
    other = dict(zip(ANN_GRID["epochs"], parameters.epochs, strict=False))
    kept = combinations[combinations["epochs"].isin(list(other))]
    return kept.assign(epochs=kept["epochs"].map(other)).reset_index(drop=True)


def network_parts(
    name: str, table: pd.DataFrame, split: str, combinations: pd.DataFrame, seed: int
) -> FilesToMake:
    """Say how networks of each batch size and optimizer are tuned, one part each."""
    work: FilesToMake = {}
    for (batch, optimizer), part in combinations.groupby(_JOBS):
        part = part.reset_index(drop=True)
        label = f"{name}_{batch}_{optimizer}"
        work |= _part(label, experiments.tuned_networks, table, split, part, seed=seed)
    return work


def tune_forest(
    normalized_table: pd.DataFrame, parameters: ReproduceThesisParameters, seed: int
) -> FilesToMake:
    """Figures 5.1 and 5.2, on folds of both kinds."""
    work: FilesToMake = {}
    for split in SPLITS:
        options = {**parameters.forest.model_dump(), "seed": seed}
        work |= _part(split, experiments.tuned_forest, normalized_table, split, **options)
    return work


def compare_classifiers(
    normalized_table: pd.DataFrame, splits: pd.DataFrame, parameters: ReproduceThesisParameters, seed: int
) -> FilesToMake:
    """Tables 5.6 and 5.8, Figure 5.3 and reliability, each classifier with and without SMOTE."""
    work: FilesToMake = {}
    for split, name, smote in product(SPLITS, (*THESIS_CLASSIFIERS, *FURTHER_CLASSIFIERS), (False, True)):
        own = name in THESIS_CLASSIFIERS
        trainings = parameters.trainings if own else parameters.further_trainings
        work |= _rows(
            f"{split}_{name}_{'smote' if smote else 'plain'}",
            experiments.compared,
            normalized_table,
            splits,
            split=split,
            classifier=name,
            smote=smote,
            seeds=list(range(seed, seed + trainings)),
        )
    return work


def measure_bins(
    normalized_table: pd.DataFrame, splits: pd.DataFrame, parameters: ReproduceThesisParameters, seed: int
) -> FilesToMake:
    """Figures 5.5 to 5.8 and Table 5.9."""
    work: FilesToMake = {}
    for split, name in product(SPLITS, ("latent", "coefficients", "key_attributes", "power_series")):
        work |= _rows(
            f"{split}_{name}",
            experiments.by_bins,
            normalized_table,
            splits,
            split=split,
            representation=name,
            bins=list(parameters.bins),
            seeds=list(range(seed, seed + parameters.trainings)),
            options=parameters.representation_options(name),
        )
    return work


def measure_latent_features(
    normalized_table: pd.DataFrame, splits: pd.DataFrame, parameters: ReproduceThesisParameters, seed: int
) -> FilesToMake:
    """Figure 5.4."""
    work: FilesToMake = {}
    for split, count in product(SPLITS, parameters.latent_counts):
        work |= _rows(
            f"{split}_{count}",
            experiments.by_latent_features,
            normalized_table,
            splits,
            split=split,
            count=count,
            bins=10,
            seeds=list(range(seed, seed + parameters.trainings)),
            options={"epochs": parameters.latent_epochs},
        )
    return work


def measure_condition(normalized_table: pd.DataFrame) -> FilesToMake:
    """Condition numbers of the power series."""
    return _part("power_series", experiments.power_series_condition, normalized_table)


def _rows(
    name: str,
    function: Callable[..., Any],
    table: pd.DataFrame,
    splits: pd.DataFrame,
    *,
    split: str,
    **options: Any,
) -> FilesToMake:
    """A part that trains and tests on the rows of one split."""
    rows = split_rows(table, splits, split)
    key = files.key_of(_code(), name, table, *rows, options)
    task = partial(files.computed, function, table, rows, split=split, **options)
    return {f"{name}_{key}.npz": Labelled(name.replace("_", " "), task)}


def together(*folders: StoredFiles) -> dict[str, pd.DataFrame]:
    """Tables of all parts, appended by name."""
    parts: dict[str, list[pd.DataFrame]] = {}
    for folder in folders:
        for read in folder.values():
            for name, frame in files.unpack_frames(read()).items():
                parts.setdefault(name, []).append(frame)
    return {name: pd.concat(frames, ignore_index=True) for name, frames in parts.items()}
