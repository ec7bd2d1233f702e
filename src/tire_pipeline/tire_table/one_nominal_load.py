"""Bring all tires to one nominal load (thesis, Appendix B)."""

from __future__ import annotations

import pandas as pd
from pydantic import Field

from tire_pipeline.parameters import Parameters
from tire_pipeline.tire_table import normalize_table


class NormalizeParameters(Parameters):
    """Parameters of ``normalize``.

    Attributes
    ----------
    nominal_load : float
        N.
    """

    nominal_load: float = Field(6000.0, gt=0.0)


def to_one_nominal_load(tire_table: pd.DataFrame, parameters: NormalizeParameters) -> pd.DataFrame:
    """The same forces, written with one nominal load."""
    return normalize_table(tire_table, parameters.nominal_load)
