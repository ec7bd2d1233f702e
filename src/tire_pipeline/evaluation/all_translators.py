"""Translate the evaluation tires by every translator; nothing here sees the truth."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.evaluation.parameters import EvaluateParameters
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.progress import track
from tire_pipeline.tire_table import from_models, normalize_table
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.tire_table.read_blocks import TireFiles
from tire_pipeline.translation import translator_from_state

UNJUDGED = "own files"
THESIS_AGENT = "thesis' agent"
OUR_AGENT = "our agent"
NO_CHANGE = "no change"


def choose_sources(
    evaluation_sources: TireFiles,
    tir_files: TireFiles,
    splits: pd.DataFrame,
    parameters: EvaluateParameters,
    target_category: str,
) -> dict[str, Any]:
    """Choose the files to translate: the evaluation tires, or the user's own if there are none.

    Evaluation tires of which no organisation is among the user's (those of the demonstration fleet, beside
    own files) say nothing about the translation and do not count.

    Parameters
    ----------
    evaluation_sources : mapping
        ``<set>/<category>/<tire>.tir`` to the function that reads it.
    tir_files : mapping
        ``<category>/.../<name>.tir`` likewise.
    splits : DataFrame
        ``file, random, by_tire``: own files are taken from the test part by physical tire.
    parameters : EvaluateParameters
    target_category : str

    Returns
    -------
    dict
        ``folder`` (evaluation or tir) and ``files``.

    Raises
    ------
    DomainError
        If a set that was asked for is not there, though others are.
    """
    categories = {file.split("/")[0] for file in tir_files} - {target_category}
    if not categories & {file.split("/")[1] for file in evaluation_sources}:
        new = splits.loc[splits["by_tire"] == "test", "file"]
        own = [file for file in new if file in tir_files and file.split("/")[0] != target_category]
        return {"folder": "tir", "files": own[: parameters.most_files_without_evaluation]}
    sets = {file.split("/")[0] for file in evaluation_sources}
    absent = [name for name in parameters.sets if name not in sets]
    if absent:
        raise DomainError(
            f"there are no evaluation tires in {', '.join(absent)}; there are: {', '.join(sorted(sets))}",
            where="evaluate",
            todo="set evaluate.sets to some of these",
        )
    wanted = [
        file
        for file in evaluation_sources
        if file.split("/")[0] in parameters.sets and file.split("/")[1] != target_category
    ]
    return {"folder": "evaluation", "files": wanted}


def translate_files(
    chosen: dict[str, Any],
    evaluation_sources: TireFiles,
    tir_files: TireFiles,
    agent: dict[str, Any],
    our_agent: dict[str, Any],
    translator: dict[str, Any],
    normalize: NormalizeParameters,
) -> pd.DataFrame:
    """Translate the chosen files by the thesis' agent, by our agent and by the translator.

    Parameters
    ----------
    chosen : dict
        From :func:`choose_sources`.
    evaluation_sources, tir_files : mapping
    agent, our_agent, translator : dict
        States of the fitted translators.
    normalize : NormalizeParameters
        The nominal load that the translators work at.

    Returns
    -------
    DataFrame
        Tires before and after, at one nominal load: ``set``, ``tire``, ``translator`` ("no change" before),
        ``state``, ``verdict``, ``expected_rms_ratio`` (the translator's own estimate, NaN if it has none)
        and the coefficients.
    """
    _, own = read_chosen(chosen, evaluation_sources, tir_files)
    before = normalize_table(own, normalize.nominal_load)
    states = translators(agent, our_agent, translator)
    parts = [before.assign(translator=NO_CHANGE, state="before", verdict="", expected_rms_ratio=float("nan"))]
    for name, state in track(states.items(), "translating by each translator", total=len(states)):
        parts.append(translated_by(state, before).assign(translator=name, state="after"))
    table = pd.concat(parts, ignore_index=True)
    names = table["file"].str.split("/")
    judged = chosen["folder"] == "evaluation"
    return table.assign(set=names.str[0] if judged else UNJUDGED, tire=names.str[-1].str[:-4])


def translators(
    agent: dict[str, Any], our_agent: dict[str, Any], translator: dict[str, Any]
) -> dict[str, dict[str, Any]]:
    """Name the states as tables and pages do."""
    name = str(translator["translator"]).replace("_", " ")
    return {THESIS_AGENT: agent, OUR_AGENT: our_agent, name: translator}


def read_chosen(
    chosen: dict[str, Any], evaluation_sources: TireFiles, tir_files: TireFiles
) -> tuple[dict[str, TireModel], pd.DataFrame]:
    """Read the chosen files, as models and as a tire table."""
    files = evaluation_sources if chosen["folder"] == "evaluation" else tir_files
    models = {file: files[file]() for file in track(chosen["files"], "reading files to translate")}
    position = 1 if chosen["folder"] == "evaluation" else 0
    return models, from_models((file, file.split("/")[position], model) for file, model in models.items())


def translated_by(state: Mapping[str, Any], before: pd.DataFrame) -> pd.DataFrame:
    """Translate a table; with ``verdict`` and ``expected_rms_ratio`` if the translator gives them."""
    result = translator_from_state(state).translation(before, bands=False)
    said = result.report[["verdict", "expected_rms_ratio"]]
    return result.table.assign(**{name: said[name].to_numpy() for name in said})
