"""The loads at which the curves of a fleet are compared: those of car tires, times a factor of the fleet.

A Magic Formula 5.2 is homogeneous: force over nominal load depends on load over nominal load alone. So
tires that carry six times as much are compared at six times the load by writing them as tires of a sixth of
it: one factor for all tires, whoever measured them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
import pandas as pd

from tire_pipeline.tire_table import normalize_table
from tire_pipeline.tire_table.one_nominal_load import OWN_LOAD
from tire_pipeline.translation.curves.features import LOADS

LOAD_FACTOR = "load_factor"
"""Column with the factor, beside tires that :meth:`LoadScale.scaled` gave."""

_STEPS_TO_DOUBLE = 2  # coarse, so that the loads stay when a few files come


@dataclass(frozen=True)
class LoadScale:
    """By how much the loads are larger than those of car tires.

    Attributes
    ----------
    factor : float
        1 for car tires, whose nominal loads lie about the mean of ``LOADS``, and where the files'
        own nominal loads are not known.
    """

    factor: float = 1.0

    @classmethod
    def fit(cls, training: pd.DataFrame) -> Self:
        """Learn from the nominal loads that the training files themselves state."""
        if OWN_LOAD not in training:
            return cls()
        usual = float(training[OWN_LOAD].median())
        steps = round(_STEPS_TO_DOUBLE * np.log2(usual / LOADS.mean()))
        return cls(2.0 ** (steps / _STEPS_TO_DOUBLE))

    def scaled(self, table: pd.DataFrame) -> pd.DataFrame:
        """Write tires as tires that carry loads of car tires; what a file lacks stays lacking."""
        if self.factor == 1.0:
            return table
        nominal = table["FNOMIN"].to_numpy(dtype=float)
        found = normalize_table(table, nominal * self.factor)
        same = [name for name in found if name in table and table[name].dtype.kind == "f"]
        known = found[same].where(table[same].notna().to_numpy())
        found = pd.concat([found.drop(columns=same), known], axis=1)[list(found)]
        found = found.assign(FNOMIN=nominal, **{LOAD_FACTOR: self.factor})
        return found.assign(**{OWN_LOAD: table[OWN_LOAD] / self.factor}) if OWN_LOAD in table else found

    def unscaled(self, table: pd.DataFrame) -> pd.DataFrame:
        """Undo :meth:`scaled`, but for its columns beside the coefficients."""
        if self.factor == 1.0:
            return table
        nominal = table["FNOMIN"].to_numpy(dtype=float)
        return normalize_table(table.assign(FNOMIN=nominal * self.factor), nominal)
