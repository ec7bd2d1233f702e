"""Every row can go back to the nominal load it came from."""

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tire_table import from_models, normalize_table

COEFFICIENTS = {"PCY1": 1.3, "PDY1": 1.0, "PDY2": -0.1, "PEY1": -0.5, "PKY1": -20.0, "PKY2": 2.0}


def test_there_and_back_gives_every_row_its_own_load():
    own = np.array([3500.0, 5200.0, 8000.0])
    models = [TireModel.from_coefficients({**COEFFICIENTS, "FNOMIN": load}) for load in own]
    table = from_models((f"A/{i}.tir", "A", model) for i, model in enumerate(models))
    there = normalize_table(table, 6000.0)
    assert (there["FNOMIN"] == 6000.0).all()
    back = normalize_table(there, own)
    np.testing.assert_array_equal(back["FNOMIN"], own)
    pd.testing.assert_frame_equal(back[table.columns], table, rtol=1e-12)
