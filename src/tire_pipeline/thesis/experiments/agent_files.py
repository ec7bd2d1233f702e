"""Nodes of the grid: train the agents of a cell, judge them. Stored results are not computed again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from functools import partial
from inspect import getsource
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.code_hash import code_hash
from tire_pipeline.errors import DomainError
from tire_pipeline.evaluation.target_measurements import measured
from tire_pipeline.files.read_later import FilesToMake, StoredFiles
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.progress import track
from tire_pipeline.tasks import Labelled
from tire_pipeline.thesis.experiments import agents as thesis_agents
from tire_pipeline.thesis.experiments import files
from tire_pipeline.thesis.parameters import ReproduceThesisParameters
from tire_pipeline.tire_table import from_models, normalize_table
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.translation.thesis.grid import Cell

Models = Mapping[str, Callable[[], TireModel]]

FORM_OF = {"power_series_stable": "power_series"}
FITTING_CODE = ("representations",)
TRAINING_CODE = ("translation/thesis", "representations", "classifiers", "tire_table")
JUDGING_CODE = ("translation/thesis", "representations", "evaluation", "magic_formula")


def read_sources(
    evaluation_sources: Models,
    parameters: ReproduceThesisParameters,
    normalize: NormalizeParameters,
    target_category: str,
) -> pd.DataFrame:
    """Read the evaluation tires as the other categories measured them.

    Returns
    -------
    DataFrame
        Tire table at one nominal load, with ``set`` and ``tire``.

    Raises
    ------
    DomainError
        If a set is not there.
    """
    parts = []
    for name in parameters.sets:
        wanted = [
            f for f in evaluation_sources if f.split("/")[0] == name and _category(f) != target_category
        ]
        if not wanted:
            raise DomainError(
                f"there are no evaluation tires in {name}",
                where="evaluation_sources",
                todo="run `kedro run --pipeline make_fleet` first, or set reproduce_thesis.sets",
            )
        models = {file: evaluation_sources[file]() for file in track(wanted, f"reading set {name}")}
        table = from_models((file, _category(file), model) for file, model in models.items())
        tires = table["file"].str.split("/").str[-1].str[:-4]
        parts.append(table.assign(set=name, tire=tires))
    return normalize_table(pd.concat(parts, ignore_index=True), normalize.nominal_load)


def _category(file: str) -> str:
    return file.split("/")[1]


def fitter(name: str) -> Callable[..., FilesToMake]:
    """Return the node function that fits one representation, once a seed for all its cells."""

    def fit_representation(
        normalized_table: pd.DataFrame, splits: pd.DataFrame, parameters: ReproduceThesisParameters
    ) -> FilesToMake:
        """Fit on the files that the agents are trained on."""
        training = _training(normalized_table, splits)
        options = parameters.representation_options(name)
        kind = FORM_OF.get(name, name)
        key = files.key_of(code_hash(*FITTING_CODE), training, name, options)
        return {
            f"{key}/seed_{seed}.npz": Labelled(
                f"seed {seed}", partial(files.represented, training, kind, seed, options)
            )
            for seed in parameters.agents.seeds
        }

    return fit_representation


def trainer(cell: Cell) -> Callable[..., FilesToMake]:
    """Return the node function that trains the agents of one cell, one a seed."""

    def train_agents(
        normalized_table: pd.DataFrame,
        splits: pd.DataFrame,
        fitted: StoredFiles,
        parameters: ReproduceThesisParameters,
        target_category: str,
    ) -> FilesToMake:
        """Train on the files of the random split's training part, as in the thesis."""
        training = _training(normalized_table, splits)
        options: dict[str, Any] = {"target": target_category, "total_steps": parameters.agents.total_steps}
        data = files.key_of(code_hash(*TRAINING_CODE), training, asdict(cell), options)
        work: FilesToMake = {}
        for name, read in fitted.items():
            seed = seed_of(name)
            key = files.key_of(data, name)
            task = partial(files.trained, training, cell, seed, read, **options)
            work[f"{key}/seed_{seed}.npz"] = Labelled(f"seed {seed}", task)
        return work

    return train_agents


def _training(table: pd.DataFrame, splits: pd.DataFrame) -> pd.DataFrame:
    part = splits.set_index("file").loc[table["file"], "random"].to_numpy()
    return table[part == "train"].reset_index(drop=True)


def seed_of(name: str) -> int:
    """The seed in the name of a stored file."""
    return int(name.rpartition("_")[2].removesuffix(".npz"))


def judge_of(cell: Cell) -> Callable[..., FilesToMake]:
    """Return the node function that judges the agents of one cell."""

    def judge(
        trained: StoredFiles,
        thesis_sources: pd.DataFrame,
        evaluation_truth: Models,
        normalize: NormalizeParameters,
        target_category: str,
    ) -> FilesToMake:
        """Compare with the target's measurements; no agent sees the comparison."""
        references = references_of(evaluation_truth, "first", thesis_sources, normalize, target_category)
        data = files.key_of(code_hash(*JUDGING_CODE), getsource(thesis_agents), thesis_sources, references)
        work: FilesToMake = {}
        for name, read in trained.items():
            seed = seed_of(name)
            key = files.key_of(data, name)
            task = partial(files.judged, read, cell, seed, thesis_sources, references)
            work[f"{key}/seed_{seed}.npz"] = Labelled(f"seed {seed}", task)
        return work

    return judge


def judge_floor(
    thesis_sources: pd.DataFrame,
    evaluation_truth: Models,
    normalize: NormalizeParameters,
    target_category: str,
) -> pd.DataFrame:
    """The floor: the error of the target's own second measurement."""
    first, again = (
        references_of(evaluation_truth, which, thesis_sources, normalize, target_category)
        for which in ("first", "second")
    )
    return thesis_agents.judged_floor(thesis_sources, first, again)


def references_of(
    truth: Models, which: str, sources: pd.DataFrame, normalize: NormalizeParameters, target: str
) -> pd.DataFrame:
    """The target's measurements, row by row the tires of ``sources``."""
    parts = []
    for name in dict.fromkeys(sources["set"]):
        tires = sources.loc[sources["set"] == name, "tire"]
        parts.append(measured(truth, f"{which}/{name}/{target}", tires, normalize.nominal_load))
    table = pd.concat(parts, ignore_index=True)
    assert np.array_equal(table["tire"].to_numpy(), sources["tire"].to_numpy())
    return table
