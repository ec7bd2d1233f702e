"""The target's own measurements of evaluation tires."""

from __future__ import annotations

import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.tire_table import from_models, normalize_table
from tire_pipeline.tire_table.read_blocks import TireFiles


def measured(truth: TireFiles, folder: str, tires: pd.Series, nominal_load: float) -> pd.DataFrame:
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
