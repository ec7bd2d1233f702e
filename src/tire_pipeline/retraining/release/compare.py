"""Candidate against released model, on the same held-out tires."""

from __future__ import annotations

import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.retraining.release.model import CategoryModel

CANDIDATE, RELEASED = "candidate", "released"
BALANCED = "all, balanced"
OVERALL = "all"


def compare_models(
    candidate: CategoryModel, released: CategoryModel | None, held_out: pd.DataFrame
) -> pd.DataFrame:
    """Judge both models on files of the held-out tires.

    Parameters
    ----------
    candidate : CategoryModel
    released : CategoryModel or None
        None if nothing was released yet.
    held_out : DataFrame
        Tire table of the held-out tires, at any nominal load.

    Returns
    -------
    DataFrame
        ``model, category, files, correct, accuracy``: for each category, for all files (``all``), and the
        mean of the categories (``all, balanced``), by which it is decided: there, many files of one category
        cannot hide a loss in another. A category that a model does not know counts as wrong.

    Raises
    ------
    DomainError
        No tire is held out.
    """
    if held_out.empty:
        raise DomainError(
            "no tire is held out, so models cannot be compared",
            todo="add files of more tires, or raise retrain.held_out_share",
        )
    models = {RELEASED: released, CANDIDATE: candidate}
    return pd.concat(
        [_judged(name, model, held_out) for name, model in models.items() if model is not None],
        ignore_index=True,
    )


def not_worse(comparison: pd.DataFrame) -> bool:
    """Whether the candidate's balanced accuracy is at least the released model's (or there is none)."""
    scores = comparison[comparison["category"] == BALANCED].set_index("model")["accuracy"]
    return RELEASED not in scores.index or bool(scores[CANDIDATE] >= scores[RELEASED])


def balanced_accuracy(comparison: pd.DataFrame, model: str) -> float | None:
    """The figure that decides, of one model; None if it was not judged."""
    found = comparison[(comparison["category"] == BALANCED) & (comparison["model"] == model)]
    return float(found["accuracy"].iloc[0]) if len(found) else None


def _judged(name: str, model: CategoryModel, tires: pd.DataFrame) -> pd.DataFrame:
    right = pd.Series(model.predict(tires) == tires["category"].to_numpy(dtype=str))
    groups = right.groupby(tires["category"].to_numpy(dtype=str))
    table = pd.DataFrame({"files": groups.size(), "correct": groups.sum().astype(int)})
    table["accuracy"] = table["correct"] / table["files"]
    table = table.rename_axis("category").reset_index()
    total = {"files": int(table["files"].sum()), "correct": int(table["correct"].sum())}
    last = pd.DataFrame(
        [
            {"category": OVERALL, **total, "accuracy": total["correct"] / total["files"]},
            {"category": BALANCED, **total, "accuracy": table["accuracy"].mean()},
        ]
    )
    table = pd.concat([table, last], ignore_index=True)
    table.insert(0, "model", name)
    return table
