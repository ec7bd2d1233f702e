"""Compare translations with the target's own measurement: the only place that reads the sealed truth."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.evaluation import curves_of, evaluate_translations
from tire_pipeline.evaluation.all_translators import NO_CHANGE, UNJUDGED
from tire_pipeline.evaluation.target_measurements import measured
from tire_pipeline.progress import track
from tire_pipeline.representations.coefficients import DATASETS
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.tire_table.read_blocks import TireFiles

ORACLE = "oracle"
FLOOR = "floor"
BIASED = (*DATASETS["lateral"], *DATASETS["longitudinal"])
_SUMMARY_COLUMNS = ["set", "translator", "metric", "rms", "ratio", "improved", "worst", "files"]


def judge(
    translated_table: pd.DataFrame,
    evaluation_truth: TireFiles,
    normalize: NormalizeParameters,
    target_category: str,
) -> tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame]:
    """Errors of every translator's files, beside no change, an oracle and the floor.

    Parameters
    ----------
    translated_table : DataFrame
        From ``translate_files``.
    evaluation_truth : mapping
        ``first|second/<set>/<category>/<tire>.tir`` to the function that reads it.
    normalize : NormalizeParameters
    target_category : str

    Returns
    -------
    per_file : DataFrame
        ``set, translator, file`` and errors after and before.
    summary : DataFrame
        ``set, translator, metric, rms, ratio, improved, worst, files``; ``rms`` is the root of the mean
        squared error over all files, ``ratio`` that of the squared errors to no change. Translators are those
        of the table, no change, oracle (:func:`shifted_by_truth`) and floor.
    references : DataFrame
        The target's measurements of the tires of the first set, for figures.

    Raises
    ------
    DomainError
        If the target's measurement of a tire is missing.
    """
    per_file, summaries, references = [], [], []
    for name, part in translated_table.groupby("set", sort=False):
        if name == UNJUDGED:
            continue
        tires = part.loc[part["state"] == "before", "tire"].reset_index(drop=True)
        folders = (f"{again}/{name}/{target_category}" for again in ("first", "second"))
        load = normalize.nominal_load
        first, second = (measured(evaluation_truth, folder, tires, load) for folder in folders)
        errors, summary = _judge_set(str(name), part, first, second)
        per_file += errors
        summaries += summary
        references.append(first.drop_duplicates("tire").assign(set=name))
    if not summaries:
        no_files = pd.DataFrame(columns=["set", "file"])
        return no_files, pd.DataFrame(columns=_SUMMARY_COLUMNS), translated_table.head(0)
    found = [pd.concat(parts, ignore_index=True) for parts in (per_file, summaries, references)]
    return found[0], found[1][_SUMMARY_COLUMNS], found[2]


def _judge_set(
    name: str, part: pd.DataFrame, first: pd.DataFrame, second: pd.DataFrame
) -> tuple[list[pd.DataFrame], list[pd.DataFrame]]:
    """Errors by file and summaries of one set, by translator, from the target's two measurements."""
    before = part[part["state"] == "before"].reset_index(drop=True)
    written = {
        str(who): table.reset_index(drop=True)
        for who, table in part[part["state"] == "after"].groupby("translator", sort=False)
    }
    tables = written | {NO_CHANGE: before, ORACLE: shifted_by_truth(before, first), FLOOR: second}
    reference, unchanged = curves_of(first), curves_of(before)
    per_file, summaries = [], []
    for translator, table in track(tables.items(), f"judging set {name}", total=len(tables)):
        after = unchanged if translator == NO_CHANGE else curves_of(table)
        result = evaluate_translations(after, unchanged, reference)
        errors = result.per_file.reset_index(drop=True)
        rows = result.summary.reset_index(names="metric")
        rms = [float(np.sqrt(errors[m].mean())) if m in errors else np.nan for m in rows["metric"]]
        summaries.append(rows.assign(set=name, translator=translator, rms=rms))
        if translator in written:
            said = before[["set", "file", "category", "tire"]].assign(translator=translator)
            per_file.append(pd.concat([said, errors], axis=1))
    return per_file, summaries


def shifted_by_truth(before: pd.DataFrame, first: pd.DataFrame) -> pd.DataFrame:
    """What one constant shift a category could reach: the mean difference of the coefficients of both forces.

    It is taken from the truth. Coefficients of the aligning torque are left as they are: they compensate each
    other, so that their means are no tire.

    Parameters
    ----------
    before, first : DataFrame
        Sources and the target's measurements of the same tires, row by row, at one nominal load.
    """
    names = [c for c in BIASED if c in before.columns and c in first.columns]
    difference = first[names].fillna(0.0) - before[names].fillna(0.0)
    shift = difference.groupby(before["category"]).transform("mean")
    shifted = before.copy()
    shifted[names] = before[names] + shift
    return shifted
