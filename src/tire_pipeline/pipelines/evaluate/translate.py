"""Translate the evaluation tires and write them as .tir files; nothing here sees the truth."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import pandas as pd

from tire_pipeline import __version__
from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.pipelines.evaluate.parameters import EvaluateParameters
from tire_pipeline.pipelines.normalize.nodes import NormalizeParameters
from tire_pipeline.progress import track
from tire_pipeline.tir import read_tir, tir_bytes
from tire_pipeline.tire_table import from_models, normalize_table
from tire_pipeline.translation import translator_from_state

Files = Mapping[str, Callable[[], TireModel]]
UNJUDGED = "own files"


def choose_sources(
    evaluation_sources: Files,
    tir_files: Files,
    splits: pd.DataFrame,
    parameters: EvaluateParameters,
    target_category: str,
) -> dict[str, Any]:
    """Say which files are translated: the evaluation tires, or the user's own where there are none.

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
    if not evaluation_sources:
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
    evaluation_sources: Files,
    tir_files: Files,
    agent: dict[str, Any],
    normalize: NormalizeParameters,
    target_category: str,
) -> tuple[pd.DataFrame, dict[str, bytes]]:
    """Translate files and give them back as texts.

    Parameters
    ----------
    chosen : dict
        From :func:`choose_sources`.
    evaluation_sources, tir_files : mapping
    agent : dict
        State of the translator.
    normalize : NormalizeParameters
        The nominal load that the translator works at.
    target_category : str

    Returns
    -------
    table : DataFrame
        Tire tables before and after, at one nominal load: ``set``, ``tire``, ``state`` and the coefficients.
    files : dict of str to bytes
        The translated .tir files, each at its own nominal load.
    """
    files = evaluation_sources if chosen["folder"] == "evaluation" else tir_files
    models = {file: files[file]() for file in track(chosen["files"], "reading files to translate")}
    position = 1 if chosen["folder"] == "evaluation" else 0
    own = from_models((file, file.split("/")[position], model) for file, model in models.items())
    before = normalize_table(own, normalize.nominal_load)
    after = translator_from_state(agent).translate(before)
    method = f"{agent['algorithm']}, {agent['reward']}"
    texts = write_back(models, own, after, target_category, method)
    return _both(before, after, chosen["folder"]), texts


def write_back(
    models: Mapping[str, TireModel],
    own: pd.DataFrame,
    after: pd.DataFrame,
    target: str,
    method: str,
) -> dict[str, bytes]:
    """The translated tires as .tir texts; only coefficients that changed are written anew."""
    back = normalize_table(after, own["FNOMIN"].to_numpy())
    texts = {}
    for index, file in track(list(own["file"].items()), "writing translated files"):
        model = models[file]
        moved = {
            name: float(back.at[index, name])
            for name in model.coefficients
            if name in back.columns and _changed(back.at[index, name], own.at[index, name])
        }
        comments = [
            f"Translated by tire-pipeline {__version__} to category {target}",
            f"Source: {file}",
            f"Method: {method}",
            f"Changed: {' '.join(moved) or 'nothing'}",
        ]
        texts[file] = tir_bytes(model.replace(**moved), comments=comments)
        _read_back(texts[file], moved, file)
    return texts


def _read_back(text: bytes, wanted: Mapping[str, float], file: str) -> None:
    """A file that does not read back as what was meant is not given to anyone."""
    found = read_tir(text, path=file).coefficients
    for name, value in wanted.items():
        if abs(found[name] - value) > 1e-6 * max(abs(value), 1e-6):
            raise DomainError(
                f"{name} was to be {value!r} and reads back as {found[name]!r}",
                where=file,
                todo="report this: the writer and the reader disagree",
            )


def _changed(new: Any, old: Any) -> bool:
    return bool(abs(new - old) > 1e-9 * max(abs(old), 1e-3))


def _both(before: pd.DataFrame, after: pd.DataFrame, folder: str) -> pd.DataFrame:
    parts = []
    for state, table in (("before", before), ("after", after)):
        names = table["file"].str.split("/")
        judged = folder == "evaluation"
        part = table.assign(
            set=names.str[0] if judged else UNJUDGED, tire=names.str[-1].str[:-4], state=state
        )
        parts.append(part)
    return pd.concat(parts, ignore_index=True)
