"""The scores of each category, beside those of the thesis."""

from __future__ import annotations

import pandas as pd

from tire_pipeline.classifiers.score_on_splits import SPLITS
from tire_pipeline.thesis.published import published_table


def per_class_table(frame: pd.DataFrame) -> pd.DataFrame:
    """Scores of each category in the thesis and here.

    Parameters
    ----------
    frame : DataFrame
        Of one classifier: ``split, category, precision, recall, f1``.

    Returns
    -------
    DataFrame
        The thesis' categories, then those that only the user's files have: these may have any name.
    """
    table = published_table("5.8").frame
    table = table.assign(category=table["Class"].str[-1])
    table = table.rename(columns={"Precision": "precision", "Recall": "recall", "F1 score": "F1"})
    table = table[["category", "precision", "recall", "F1"]].add_suffix(", thesis")
    table = table.rename(columns={"category, thesis": "category"})
    own = sorted(set(frame["category"]) - set(table["category"]))
    table = pd.concat([table, pd.DataFrame({"category": own}, dtype="str")], ignore_index=True)
    for split in SPLITS:
        part = frame[frame["split"] == split].set_index("category")
        for column, label in (("precision", "precision"), ("recall", "recall"), ("f1", "F1")):
            short = "random" if split == "random" else "by tire"
            table[f"{label}, {short}"] = table["category"].map(part[column])
    return table
