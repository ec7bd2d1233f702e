"""New files -> candidate -> released, if it is not worse on the held-out tires."""

from __future__ import annotations

import datetime
import hashlib
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from pydantic import Field

from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.classifiers.parameters import TrainClassifierParameters
from tire_pipeline.files.objects import Objects
from tire_pipeline.files.rows_on_disk import FramesOfRows
from tire_pipeline.parameters import Parameters
from tire_pipeline.representations.encoded_tires import RepresentParameters, unfitted
from tire_pipeline.retraining import (
    CategoryModel,
    Judged,
    ModelRegistry,
    Store,
    compare_models,
    drift_of_features,
    held_out_rows,
    ingest_in_steps,
    judge,
    not_worse,
    settled_difference,
    train_model,
)
from tire_pipeline.retraining.release.compare import CANDIDATE, RELEASED, balanced_accuracy
from tire_pipeline.retraining.release.record import UNCHANGED, check_split
from tire_pipeline.retraining.scan.folder_difference import check_removed
from tire_pipeline.tasks import Map, in_turn
from tire_pipeline.tire_table import TableInPieces
from tire_pipeline.tire_table.binned_features import BinParameters
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters


class RetrainParameters(Parameters):
    """Parameters of ``retrain``.

    Attributes
    ----------
    settle_seconds : float
        A file that changed less than this long ago is still growing.
    most_wait_seconds : float
        How long a run waits for growing files before it leaves them to the next.
    rehash_all : bool
        Read all files, whatever their size and dates.
    most_removed_share : float
        Stop if more of the known files are gone.
    held_out_share : float
        Of the physical tires.
    split_seed : int
        Which tires are held out.
    """

    settle_seconds: float = Field(5.0, ge=0.0)
    most_wait_seconds: float = Field(60.0, ge=0.0)
    rehash_all: bool = False
    most_removed_share: float = Field(0.5, ge=0.0, le=1.0)
    held_out_share: float = Field(0.2, gt=0.0, lt=1.0)
    split_seed: int = 0

    @property
    def split(self) -> str:
        """Names the held-out tires."""
        return f"share {self.held_out_share:g}, seed {self.split_seed}"


def read_new_files(
    ingested: Store, tir_folder: Path | Objects, parameters: RetrainParameters, *, work: Map = in_turn
) -> Iterator[tuple[Store, FramesOfRows]]:
    """Read new and changed files, and none of the others.

    Parameters
    ----------
    ingested : Store
        As the last run left it.
    tir_folder : Path or Objects
    parameters : RetrainParameters
    work : Map
        Does the hashing and the reading.

    Yields
    ------
    store : Store
        Stored at once, whatever happens later in the run: while many files are read, every minute.
    report : iterable of DataFrame
        ``file, category, status, reason`` of all files that are not simply as before.
    """
    found = settled_difference(
        tir_folder,
        ingested.manifest,
        settle_seconds=parameters.settle_seconds,
        most_wait_seconds=parameters.most_wait_seconds,
        rehash_all=parameters.rehash_all,
        work=work,
    )
    check_removed(found, ingested.manifest, parameters.most_removed_share, str(tir_folder))
    yield from ingest_in_steps(ingested, tir_folder, found, work=work)


def report_on_files(files_taken_up: FramesOfRows) -> FramesOfRows:
    """Store the report once all files are read: a table with versions is stored once a run."""
    return files_taken_up


def stored_table(ingested: Store) -> TableInPieces:
    """The tire table of all files read so far, as it is stored now."""
    return ingested.partition.table


def hold_out(
    normalized: pd.DataFrame, tire_table: pd.DataFrame, parameters: RetrainParameters
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Training tires at one nominal load, and held-out tires as they were read."""
    held = held_out_rows(tire_table, share=parameters.held_out_share, seed=parameters.split_seed)
    return normalized[~held].reset_index(drop=True), tire_table[held].reset_index(drop=True)


def train_candidate(
    training: pd.DataFrame,
    normalize: NormalizeParameters,
    represent: RepresentParameters,
    bins: BinParameters,
    train_classifier: TrainClassifierParameters,
    seed: int,
) -> CategoryModel:
    """Represent, bin and train the forest on the training tires."""
    return train_model(
        training,
        unfitted(represent),
        RandomForest(**train_classifier.options("random_forest")),
        nominal_load=normalize.nominal_load,
        bins=bins.bins,
        method=bins.method,
        seed=seed,
    )


def compare(
    candidate: CategoryModel, registry: ModelRegistry, held_out: pd.DataFrame, parameters: RetrainParameters
) -> pd.DataFrame:
    """Judge candidate and released model on the same held-out tires."""
    check_split(registry.release, parameters.split)
    return compare_models(candidate, registry.model, held_out)


def measure_drift(
    candidate: CategoryModel, normalized: pd.DataFrame, store: Store, registry: ModelRegistry
) -> pd.DataFrame:
    """Drift of the files that came since the last candidate was judged, per category and feature."""
    since = registry.release.judged.sequence if registry.release.judged else store.manifest.sequence
    incoming = normalized["file"].isin(store.manifest.read_after(since)).to_numpy()
    names = list(candidate.representation.feature_names)
    features = pd.DataFrame(candidate.representation.encode(normalized), columns=names)
    return drift_of_features(features, normalized["category"].to_numpy(dtype=str), np.asarray(incoming))


def decide(
    candidate: CategoryModel,
    registry: ModelRegistry,
    comparison: pd.DataFrame,
    store: Store,
    parameters: RetrainParameters,
    *settings: Any,
) -> tuple[ModelRegistry, dict[str, Any]]:
    """Release the candidate if it is not worse.

    Parameters
    ----------
    candidate : CategoryModel
    registry : ModelRegistry
    comparison : DataFrame
        From :func:`compare`.
    store : Store
    parameters : RetrainParameters
    *settings
        All other parameters that shaped the candidate.

    Returns
    -------
    registry : ModelRegistry
    outcome : dict
        ``event, model, reason`` and both balanced accuracies.
    """
    figures = {name: balanced_accuracy(comparison, name) for name in (CANDIDATE, RELEASED)}
    judged = Judged(
        digest=store.manifest.digest,
        settings=_digest(parameters.split, *settings),
        sequence=store.manifest.sequence,
        split=parameters.split,
    )
    now = datetime.datetime.now(datetime.UTC).isoformat(timespec="milliseconds")
    name = now.replace(":", ".").replace("+00.00", "Z")
    release = judge(registry.release, name, judged, better=not_worse(comparison), time=now, figures=figures)
    if release is registry.release:
        reason = "these files and parameters were judged before"
        return registry, {"event": UNCHANGED, "model": release.current, "reason": reason, **figures}
    return ModelRegistry(release, candidate), dict(release.last_event)


def _digest(*settings: Any) -> str:
    plain = [each.model_dump() if isinstance(each, Parameters) else each for each in settings]
    return hashlib.sha256(json.dumps(plain, sort_keys=True, default=str).encode()).hexdigest()
