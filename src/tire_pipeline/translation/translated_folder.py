"""The user's files -> files as the target would have measured them, with a verdict for each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from fnmatch import fnmatch
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.suppliers import (
    BY_FOLDER,
    UNKNOWN_SUPPLIER,
    category_of,
    with_suppliers,
)
from tire_pipeline.errors import DomainError, TirePipelineError, did_you_mean
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.progress import track
from tire_pipeline.tasks import Map, in_blocks, in_turn
from tire_pipeline.tir import tir_bytes
from tire_pipeline.tir.format.values import COMPUTED_DIGITS
from tire_pipeline.tire_table import from_models, normalize_table
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.translation import translator_from_state
from tire_pipeline.translation.curves.of_files import file_curves
from tire_pipeline.translation.of_models import at_own_load
from tire_pipeline.translation.parameters import TranslateParameters
from tire_pipeline.translation.result import UNKNOWN, TranslationResult

Files = Mapping[str, Callable[[], TireModel]]


def read_sources(
    files_to_translate: Files,
    normalized_table: pd.DataFrame,
    parameters: TranslateParameters,
    normalize: NormalizeParameters,
    seed: int,
    *,
    work: Map = in_turn,
) -> tuple[dict[str, TireModel], pd.DataFrame, pd.DataFrame]:
    """Read the files to translate, and say of each who supplied it.

    Parameters
    ----------
    files_to_translate : mapping
        ``category/.../name.tir`` to the function that reads it.
    normalized_table : DataFrame
        The training files. Their categories are the known ones.
    parameters : TranslateParameters
    normalize : NormalizeParameters
    seed : int
    work : Map
        Does the reading.

    Returns
    -------
    models : dict of str to TireModel
        Those that could be read.
    sources : DataFrame
        The same as a tire table at one nominal load, with suppliers (:func:`.suppliers.with_suppliers`).
    unreadable : DataFrame
        ``file, source, supplier, verdict, reason`` of the others.

    Raises
    ------
    DomainError
        If not one file could be read, or none is of those that were asked for.
    """
    wanted = chosen_files(files_to_translate, parameters.only)
    models, problems = _read(wanted, parameters.trials, work)
    known = set(normalized_table["category"])
    own = from_models((file, category_of(file, known), model) for file, model in models.items())
    sources = normalize_table(own, normalize.nominal_load)
    sources = with_suppliers(sources, normalized_table, classify=parameters.classify, seed=seed)
    for row in problems:
        row["source"] = category_of(row["file"], known) or UNKNOWN_SUPPLIER
        row["supplier"] = BY_FOLDER if row["source"] in known else UNKNOWN_SUPPLIER
    return (
        models,
        sources,
        pd.DataFrame(problems, columns=["file", "source", "supplier", "verdict", "reason"]),
    )


def chosen_files(files: Files, only: list[str]) -> dict[str, Callable[[], TireModel]]:
    """Choose files by their path, one of its folders, or a pattern; one that matches none is an error."""
    if not only:
        return dict(files)

    def matches(file: str, pattern: str) -> bool:
        *folders, name = file.split("/")
        return pattern in folders or fnmatch(file, pattern) or fnmatch(name, pattern)

    for pattern in only:
        if not any(matches(file, pattern) for file in files):
            folders = sorted({file.rpartition("/")[0] for file in files if "/" in file})
            raise DomainError(
                f"only = {pattern!r} matches none of {len(files)} files",
                where="translate",
                todo=did_you_mean(pattern, [*folders, *files], f"suppliers are {', '.join(folders[:20])}"),
            )
    return {file: load for file, load in files.items() if any(matches(file, pattern) for pattern in only)}


def translate_all(
    translator: dict[str, Any],
    models: dict[str, TireModel],
    sources: pd.DataFrame,
    unreadable: pd.DataFrame,
    parameters: TranslateParameters,
) -> tuple[dict[str, bytes], pd.DataFrame, pd.DataFrame, pd.DataFrame, pd.DataFrame, dict[str, Any]]:
    """Translate every file whose supplier is known, and give each a verdict.

    Parameters
    ----------
    translator : dict
        State of a fitted translator.
    models, sources, unreadable
        From :func:`read_sources`.
    parameters : TranslateParameters

    Returns
    -------
    files : dict of str to bytes
        The translated ``.tir`` files, no others.
    report : DataFrame
        One row a file: how its supplier is known, verdict, reason, distance, expected RMS error over that of
        the unchanged file, band of the bias, and that in words with what it usually comes from.
    coefficients : DataFrame
        One row a coefficient that moved.
    bands : DataFrame
        ``file, output, normal_load, slip, middle, low, high``: curves of the translated files with their 90%
        band.
    protocols : DataFrame
        Categories that changed how they measure.
    curves : dict
        Of every file, for the page (:func:`.translation.curves.of_files.file_curves`).
    """
    fitted = translator_from_state(translator)
    result = _named_suppliers(fitted.translation(sources, farthest=parameters.farthest), sources)
    own = from_models((file, "", model) for file, model in models.items())
    curves = file_curves(list(own["file"]), models, result)
    translated, comments = at_own_load(result, models, own)
    texts = {
        file: tir_bytes(model, comments=comments[file], digits=COMPUTED_DIGITS)
        for file, model in track(translated.items(), "writing translated files")
    }
    report = pd.concat([result.report, unreadable], ignore_index=True) if len(unreadable) else result.report
    report = report.reset_index(drop=True)
    return texts, report, result.coefficients, _bands(result, own), result.protocols, curves


def _named_suppliers(result: TranslationResult, source: pd.DataFrame) -> TranslationResult:
    """The result with how each supplier is known, and what to do where it is not."""
    report = result.report.copy()
    report.insert(1, "supplier", source["supplier"].to_numpy())
    unknown = (report["verdict"] == UNKNOWN).to_numpy()
    report.loc[unknown, "source"] = UNKNOWN_SUPPLIER
    report.loc[unknown, "reason"] = source["supplier_note"].to_numpy()[unknown]
    targets = (report["supplier"] != BY_FOLDER) & (report["source"] == report["target"])
    report.loc[targets, "reason"] = "classified as the target's own"
    return replace(result, report=report)


def _read(files: Files, most: int, work: Map) -> tuple[dict[str, TireModel], list[dict[str, str]]]:
    models: dict[str, TireModel] = {}
    problems = []
    wanted = dict(list(files.items())[: most or None])
    done = {each.name: each for each in in_blocks(work, wanted, "reading files to translate")}
    for file in wanted:
        error = done[file].error
        if error is None:
            models[file] = done[file].result()
            continue
        cause = error if isinstance(error, TirePipelineError) else error.__cause__ or error
        if not isinstance(cause, TirePipelineError | OSError):
            raise error
        problems.append({"file": file, "verdict": "refused", "reason": f"cannot be read: {cause}"})
    if not models:
        raise DomainError(
            f"none of {len(wanted)} files could be read; the first: {problems[0]['reason']}",
            where="translate",
            todo="correct them, then run again",
        )
    return models, problems


def _bands(result: TranslationResult, own: pd.DataFrame) -> pd.DataFrame:
    """Bands of the translated files as one long table."""
    parts = []
    for output, every in result.bands.items():
        known = np.isfinite(every.low).any(axis=(1, 2))
        band = replace(every, middle=every.middle[known], low=every.low[known], high=every.high[known])
        n, loads, slips = band.middle.shape
        files = own["file"].to_numpy()[known]
        parts.append(
            pd.DataFrame(
                {
                    "file": np.repeat(files, loads * slips),
                    "output": output,
                    "normal_load": np.tile(np.repeat(band.normal_load, slips), n),
                    "slip": np.tile(band.slip, n * loads),
                    **{name: getattr(band, name).ravel() for name in ("middle", "low", "high")},
                }
            )
        )
    columns = ["file", "output", "normal_load", "slip", "middle", "low", "high"]
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame(columns=columns)
