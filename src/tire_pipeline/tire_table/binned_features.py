"""Features -> bin numbers, and the files of each training set."""

from __future__ import annotations

from typing import Any, Literal

import pandas as pd
from pydantic import Field

from tire_pipeline.parameters import Parameters
from tire_pipeline.tire_table import Binning, split_table

_NAME_COLUMNS = ["file", "category", "tire_id"]


class BinParameters(Parameters):
    """Parameters of ``bin``.

    Attributes
    ----------
    bins : int
        Bins a feature.
    method : {"equal_width", "equal_frequency"}
    test_share : float
        Share of the files kept for testing, on both splits.
    """

    bins: int = Field(20, ge=2, le=200)
    method: Literal["equal_width", "equal_frequency"] = "equal_width"
    test_share: float = Field(0.2, gt=0.0, le=0.5)


def split_files(features: pd.DataFrame, parameters: BinParameters, seed: int) -> pd.DataFrame:
    """Training or test for each file, at random and by physical tire."""
    return split_table(features, seed=seed, test_share=parameters.test_share)


def bin_features(
    features: pd.DataFrame, splits: pd.DataFrame, parameters: BinParameters
) -> tuple[pd.DataFrame, pd.DataFrame, dict[str, Any]]:
    """Put every feature into bins, scaled by the training set of each split.

    Parameters
    ----------
    features : DataFrame
        ``file, category, tire_id`` and the features.
    splits : DataFrame
        ``file, random, by_tire``.
    parameters : BinParameters

    Returns
    -------
    binned, binned_by_tire : DataFrame
        Bin numbers, by the training set of the random split and of the split by physical tire.
    binning : dict
        State of the random split's bins: those of the agent.
    """
    binned, first = _binned(features, splits["random"] == "train", parameters)
    by_tire, _ = _binned(features, splits["by_tire"] == "train", parameters)
    return binned, by_tire, first.to_state()


def _binned(
    features: pd.DataFrame, train: pd.Series, parameters: BinParameters
) -> tuple[pd.DataFrame, Binning]:
    values = features.drop(columns=_NAME_COLUMNS)
    binning = Binning.fit(
        values[train.to_numpy()].to_numpy(), parameters.bins, parameters.method, names=list(values.columns)
    )
    numbers = pd.DataFrame(binning.transform(values.to_numpy()), columns=values.columns, index=features.index)
    return pd.concat([features[_NAME_COLUMNS], numbers], axis=1), binning
