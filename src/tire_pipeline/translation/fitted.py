"""Fit the translator: a versioned model that `translate`, `evaluate` and `tire translate` read."""

from __future__ import annotations

from typing import Any

import pandas as pd

from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.translation import make_translator
from tire_pipeline.translation.parameters import TranslateParameters


def fit_translator(
    normalized_table: pd.DataFrame,
    parameters: TranslateParameters,
    normalize: NormalizeParameters,
    target_category: str,
    seed: int,
) -> dict[str, Any]:
    """Learn how each organisation's measurements differ from the target's.

    Parameters
    ----------
    normalized_table : DataFrame
        What the translator learns from. Its categories are the known ones.
    parameters : TranslateParameters
    normalize : NormalizeParameters
    target_category : str
    seed : int

    Returns
    -------
    dict
        State of the fitted translator, with ``nominal_load`` (N), at which it works.

    Raises
    ------
    DomainError
        If there is no file of the target, or none of any other category.
    """
    translator = make_translator(parameters.translator, **parameters.options)
    translator.fit(normalized_table, target=target_category, seed=seed)
    return {**translator.to_state(), "nominal_load": normalize.nominal_load}
