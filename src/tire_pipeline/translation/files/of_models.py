"""Tire models translated by a translator that has learned already."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.progress import track
from tire_pipeline.tire_table import from_models, normalize_table
from tire_pipeline.tire_table.one_nominal_load import OWN_LOAD
from tire_pipeline.translation.base import Translator, judging
from tire_pipeline.translation.decode.scores_to_coefficients import COEFFICIENTS
from tire_pipeline.translation.judge.verdict import FARTHEST_DISTANCE, NEEDED_TO_TRANSLATE
from tire_pipeline.translation.result import EDGE, TRANSLATED, TranslationResult, comment_lines


def translate_models(
    translator: Translator,
    models: Mapping[str, tuple[str, TireModel]],
    *,
    nominal_load: float,
    farthest: float = EDGE,
) -> tuple[TranslationResult, dict[str, TireModel], dict[str, list[str]]]:
    """Translate models, and give each back at its own nominal load.

    Parameters
    ----------
    translator : Translator
        Fitted; one that gives verdicts.
    models : mapping of str to (str, TireModel)
        File -> the category that measured it, and the model.
    nominal_load : float
        The nominal load of the table that the translator has learned from (N).
    farthest : float
        Tires farther from the training data are refused; 1 is the edge of the training data, 3 the most.

    Returns
    -------
    result : TranslationResult
        One row a model, in the order of the file names.
    translated : dict of str to TireModel
        Those with the verdict "translated".
    comments : dict of str to list of str
        What was done, as comment lines of each of their files.

    Raises
    ------
    DomainError
        A category is unknown to the translator, or the translator gives no verdicts.
    """
    judge = judging(translator)
    known = judge.categories
    for file, (category, _) in models.items():
        if category not in known:
            raise DomainError(
                f"the translator has seen no files of {category!r}",
                where=file,
                todo=f"say who measured the tire: one of {', '.join(known)}",
            )
    gated = judge.with_verdict(farthest=min(farthest, FARTHEST_DISTANCE), gate=True)  # agents never refuse
    own = from_models((file, category, model) for file, (category, model) in models.items())
    source = at_one_load(own, nominal_load).assign(category_probability=1.0)
    result = gated.translation(source)
    translated, comments = at_own_load(result, {file: model for file, (_, model) in models.items()}, own)
    return result, translated, comments


def at_one_load(own: pd.DataFrame, nominal_load: float) -> pd.DataFrame:
    """Return a tire table at one nominal load (N), with the one that each file states beside it.

    What a file lacks of that which a translation needs stays lacking: the change of load gives a level that
    is not stated a share of its slope over load, which is no tire's.
    """
    table = normalize_table(own, nominal_load)
    needed = [name for name in NEEDED_TO_TRANSLATE if name in table]
    table[needed] = table[needed].mask(own.reindex(columns=needed).isna().to_numpy())
    return table.assign(**{OWN_LOAD: own["FNOMIN"].to_numpy(dtype=float)})


def at_own_load(
    result: TranslationResult, models: Mapping[str, TireModel], own: pd.DataFrame
) -> tuple[dict[str, TireModel], dict[str, list[str]]]:
    """Give translated tires back at the nominal load of their files.

    Parameters
    ----------
    result : TranslationResult
    models : mapping of str to TireModel
        The source files.
    own : DataFrame
        Their tire table as it was read, row by row that of ``result``.

    Returns
    -------
    translated : dict of str to TireModel
        Those with the verdict "translated".
    comments : dict of str to list of str
        What was done, as comment lines of each of their files.
    """
    back = normalize_table(result.table, own["FNOMIN"].to_numpy())
    translated, comments = {}, {}
    for row, file in enumerate(track(own["file"], "putting files back to their own loads")):
        if result.report["verdict"].iloc[row] != TRANSLATED:
            continue
        model = models[file]
        values = {n: float(back[n].iloc[row]) for n in COEFFICIENTS if n in back}
        changed = {n: v for n, v in values.items() if np.isfinite(v) and v != model.coefficients.get(n)}
        translated[file] = model.replace(**changed)
        comments[file] = comment_lines(result, row, COEFFICIENTS)
    return translated, comments
