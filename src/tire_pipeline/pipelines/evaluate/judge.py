"""Compare translations with the target's own measurement: the only place that reads the truth."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.evaluation import evaluate_translations
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.pipelines.evaluate.translate import UNJUDGED
from tire_pipeline.pipelines.normalize.nodes import NormalizeParameters
from tire_pipeline.representations.coefficients import DATASETS
from tire_pipeline.tire_table import from_models, normalize_table

Files = Mapping[str, Callable[[], TireModel]]
BIASED = (*DATASETS["lateral"], *DATASETS["longitudinal"])
_COLUMNS = ["set", "translator", "metric", "ratio", "improved", "worst", "files"]


def judge(
    translated_table: pd.DataFrame,
    evaluation_truth: Files,
    normalize: NormalizeParameters,
    target_category: str,
) -> tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame]:
    """Errors of the agent's translations, beside no change, an oracle and the floor.

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
        ``set, file`` and errors after and before.
    summary : DataFrame
        ``set, translator, metric, ratio, improved, worst, files``; translators are agent, no change,
        oracle (:func:`shifted_by_truth`) and floor.
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
        before, after = (part[part["state"] == state].reset_index(drop=True) for state in ("before", "after"))
        tires = before["tire"]
        first, second = (
            measured(evaluation_truth, f"{again}/{name}/{target_category}", tires, normalize.nominal_load)
            for again in ("first", "second")
        )
        judged = {
            translator: evaluate_translations(table, before, first)
            for translator, table in (
                ("agent", after),
                ("no change", before),
                ("oracle", shifted_by_truth(before, first)),
                ("floor", second),
            )
        }
        for translator, result in judged.items():
            rows = result.summary.reset_index(names="metric")
            summaries.append(rows.assign(set=name, translator=translator))
        errors = judged["agent"].per_file.reset_index(drop=True)
        per_file.append(pd.concat([before[["set", "file", "category", "tire"]], errors], axis=1))
        references.append(first.drop_duplicates("tire").assign(set=name))
    if not summaries:
        return pd.DataFrame(columns=["set", "file"]), pd.DataFrame(columns=_COLUMNS), translated_table.head(0)
    return (
        pd.concat(per_file, ignore_index=True),
        pd.concat(summaries, ignore_index=True)[_COLUMNS],
        pd.concat(references, ignore_index=True),
    )


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


def measured(truth: Files, folder: str, tires: pd.Series, nominal_load: float) -> pd.DataFrame:
    """The target's measurements in one folder of the truth, row by row those of ``tires``."""
    names = [f"{folder}/{tire}.tir" for tire in dict.fromkeys(tires)]
    absent = [name for name in names if name not in truth]
    if absent:
        raise DomainError(
            f"the target's measurement {absent[0]} is missing ({len(absent)} of {len(names)})",
            where="evaluation_truth",
            todo="put it there, or set target_category to the category that measured these tires",
        )
    table = normalize_table(
        from_models((name, folder.split("/")[-1], truth[name]()) for name in names), nominal_load
    )
    table["tire"] = table["file"].str.split("/").str[-1].str[:-4]
    return table.set_index("tire").loc[tires].reset_index()
