"""Choose the translator whose files are written, by tires that are judged nowhere else; write its files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline import __version__
from tire_pipeline.errors import DomainError
from tire_pipeline.evaluation import THESIS_METRICS, curves_of, evaluate_translations
from tire_pipeline.evaluation.all_translators import read_chosen, translated_by, translators
from tire_pipeline.evaluation.parameters import EvaluateParameters
from tire_pipeline.evaluation.target_measurements import measured
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.progress import track
from tire_pipeline.tir import read_tir, tir_bytes
from tire_pipeline.tir.format.values import COMPUTED_DIGITS
from tire_pipeline.tire_table import from_models, normalize_table
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.tire_table.read_blocks import TireFiles
from tire_pipeline.translation.result import TRANSLATED

TUNING = "tuning"


def choose_best(
    evaluation_sources: TireFiles,
    tuning_truth: TireFiles,
    agent: dict[str, Any],
    our_agent: dict[str, Any],
    translator: dict[str, Any],
    parameters: EvaluateParameters,
    normalize: NormalizeParameters,
    target_category: str,
) -> dict[str, Any]:
    """Choose the translator with the smallest RMS error on tuning tires.

    The figure is the mean of the RMS ratios of lateral force, cornering stiffness and peak friction. Without
    tuning tires it is the translator that ``translate`` uses, which hidden tires of other fleets chose
    (`benchmarks/bench_translation.py`).

    Parameters
    ----------
    evaluation_sources : mapping
        ``tuning/<category>/<tire>.tir`` among others.
    tuning_truth : mapping
        ``<category>/<tire>.tir`` as the target measured them.
    agent, our_agent, translator : dict
        States of the fitted translators.
    parameters : EvaluateParameters
    normalize : NormalizeParameters
    target_category : str

    Returns
    -------
    dict
        ``name``, ``tires`` (how many chose it, 0 without) and ``rms_ratio`` by translator.
    """
    states = translators(agent, our_agent, translator)
    tires, files = _tuning_files(
        evaluation_sources, tuning_truth, target_category, parameters.tires_to_choose_by
    )
    if not tires:
        return {"name": list(states)[-1], "tires": 0, "rms_ratio": {}}
    own = from_models((file, file.split("/")[1], evaluation_sources[file]()) for file in files)
    before = normalize_table(own, normalize.nominal_load)
    names = before["file"].str.split("/").str[-1].str[:-4]
    truth = measured(tuning_truth, target_category, names, normalize.nominal_load)
    reference, unchanged = (curves_of(each, lateral_only=True) for each in (truth, before))
    ratios = {}
    for name, state in track(states.items(), "choosing the best translator", total=len(states)):
        after = curves_of(translated_by(state, before), lateral_only=True)
        found = evaluate_translations(after, unchanged, reference).summary["ratio"]
        ratios[name] = float(np.sqrt(found.loc[list(THESIS_METRICS)]).mean())
    return {"name": min(ratios, key=lambda name: ratios[name]), "tires": len(tires), "rms_ratio": ratios}


def _tuning_files(
    sources: TireFiles, truth: TireFiles, target: str, most: int
) -> tuple[list[str], list[str]]:
    """Up to ``most`` tuning tires that the target measured, and the other categories' files of them."""
    files = [file for file in sources if file.split("/")[0] == TUNING and file.split("/")[1] != target]
    tires = sorted({file.split("/")[-1] for file in files})
    tires = [tire for tire in tires if f"{target}/{tire}" in truth][:most]
    return tires, [file for file in files if file.split("/")[-1] in tires]


def write_best(
    translated_table: pd.DataFrame,
    best: dict[str, Any],
    chosen: dict[str, Any],
    evaluation_sources: TireFiles,
    tir_files: TireFiles,
    target_category: str,
) -> dict[str, bytes]:
    """Write the best translator's files; those that it refuses or leaves alone are not written.

    Parameters
    ----------
    translated_table : DataFrame
        From :func:`.all_translators.translate_files`.
    best : dict
        From :func:`choose_best`.
    chosen : dict
        From :func:`.all_translators.choose_sources`.
    evaluation_sources, tir_files : mapping
    target_category : str

    Returns
    -------
    dict of str to bytes
        The translated ``.tir`` files, each at its own nominal load.
    """
    models, own = read_chosen(chosen, evaluation_sources, tir_files)
    after = translated_table[translated_table["translator"] == best["name"]].reset_index(drop=True)
    act = (after["verdict"] == TRANSLATED).to_numpy()
    own, after = own[act].reset_index(drop=True), after[act].reset_index(drop=True)
    return write_back(models, own, after, target_category, best["name"])


def write_back(
    models: Mapping[str, TireModel],
    own: pd.DataFrame,
    after: pd.DataFrame,
    target: str,
    method: str,
) -> dict[str, bytes]:
    """Return the translated tires as .tir texts; only coefficients that changed are rewritten."""
    if not len(own):
        return {}
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
        texts[file] = tir_bytes(model.replace(**moved), comments=comments, digits=COMPUTED_DIGITS)
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
