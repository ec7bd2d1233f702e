"""Tires -> features."""

from __future__ import annotations

from typing import Any, Literal

import pandas as pd
from pydantic import Field

from tire_pipeline.parameters import Parameters
from tire_pipeline.representations import Representation, make_representation
from tire_pipeline.representations.coefficients import DATASETS


class RepresentParameters(Parameters):
    """Parameters of ``represent``.

    Attributes
    ----------
    representation : str
        How tires become features.
    dataset : str
        Which coefficients, for ``coefficients`` (thesis, Table 4.1).
    latent_features : int
        For ``latent``.
    """

    representation: Literal["coefficients", "key_attributes", "latent", "power_series"] = "coefficients"
    dataset: Literal["lateral_without_camber", "lateral", "longitudinal", "aligning", "full"] = (
        "lateral_without_camber"
    )
    latent_features: int = Field(8, ge=1, le=64)


def unfitted(parameters: RepresentParameters) -> Representation:
    """The representation that the parameters ask for, not fitted yet."""
    options: dict[str, dict[str, Any]] = {
        "coefficients": {"dataset": parameters.dataset},
        "latent": {"n_features": parameters.latent_features},
    }
    name = parameters.representation
    return make_representation(name, **options.get(name, {}))


def needed_coefficients(parameters: RepresentParameters) -> list[str]:
    """Coefficients that a file must have to be represented."""
    chosen = parameters.representation == "coefficients"
    return list(DATASETS[parameters.dataset if chosen else "lateral_without_camber"])


def encode_tires(
    normalized_table: pd.DataFrame, parameters: RepresentParameters, seed: int
) -> tuple[pd.DataFrame, dict[str, Any]]:
    """Features of every tire.

    Parameters
    ----------
    normalized_table : DataFrame
        Tire table at one nominal load.
    parameters : RepresentParameters
    seed : int
        For representations that are learned.

    Returns
    -------
    features : DataFrame
        ``file, category, tire_id`` and one column a feature.
    state : dict
        The fitted representation.
    """
    representation = unfitted(parameters).fit(normalized_table, seed=seed)
    values = pd.DataFrame(
        representation.encode(normalized_table),
        columns=list(representation.feature_names),
        index=normalized_table.index,
    )
    names = normalized_table[["file", "category", "tire_id"]]
    return pd.concat([names, values], axis=1), representation.to_state()
