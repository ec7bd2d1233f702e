"""Bring all tires to one nominal load (thesis, Appendix B)."""

from __future__ import annotations

import pandas as pd
from pydantic import Field

from tire_pipeline.parameters import Parameters
from tire_pipeline.tire_table import normalize_table

OWN_LOAD = "own_nominal_load"
"""Column with the nominal load that a file itself states, N, beside coefficients at another one."""


class NormalizeParameters(Parameters):
    """Parameters of ``normalize``.

    Attributes
    ----------
    nominal_load : float
        N.
    """

    nominal_load: float = Field(6000.0, gt=0.0)


def to_one_nominal_load(tire_table: pd.DataFrame, parameters: NormalizeParameters) -> pd.DataFrame:
    """The same forces, written with one nominal load, beside the one that each file states."""
    table = normalize_table(tire_table, parameters.nominal_load)
    return table.assign(**{OWN_LOAD: tire_table["FNOMIN"].to_numpy(dtype=float)})
