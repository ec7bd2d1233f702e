"""Leave-one-out errors of a translator, on the tires that several organisations measured."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.tire_table import told_tires
from tire_pipeline.translation.curves.space import PARTS
from tire_pipeline.translation.population.fit_model import PreparedTraining, fit_curve_mixed_model, prepare
from tire_pipeline.translation.population.mixed_effects import Design, posterior_weights
from tire_pipeline.translation.population.model import CurveMixedModel
from tire_pipeline.translation.population.update import TaughtCells, learn_from
from tire_pipeline.translation.predict.shrinkage import shortened


def leave_one_tire_out(
    training: pd.DataFrame,
    target: str,
    *,
    pairs: bool,
    model: CurveMixedModel | None = None,
    made: PreparedTraining | None = None,
    batch: pd.DataFrame | None = None,
) -> pd.DataFrame:
    """Translate each tire that the target and others measured by a model that has not seen it.

    The variances are those of all training data; the effects are found again without the tire.

    Parameters
    ----------
    training : DataFrame
        Tire table with ``category`` and ``tire_id``.
    target : str
    pairs : bool
        Whether the other such tires link the categories.
    model : CurveMixedModel, optional
        Already fitted to ``training`` with the same ``pairs``: saves fitting it again.
    made : PreparedTraining, optional
        What :func:`.population.fit_model.prepare` gave for the same.
    batch : DataFrame, optional
        Source files that are to be translated, and teach as in :mod:`.predict.batch`: tells whether to
        let them. Files of tires that are in ``training`` do not.

    Returns
    -------
    DataFrame
        One row a tire and source: ``tire_id``, ``source``, ``error`` and ``error_unchanged`` (mean squared
        error
        over the features of lateral and longitudinal force, in (1%)^2) and ``ratio``.

    Raises
    ------
    DomainError
        If no tire of the target was measured by anyone else.
    """
    training = training.reset_index(drop=True)
    made = made or prepare(training, pairs=pairs)
    made = replace(made, rows=made.rows.assign(tire_id=told_tires(made.rows)))
    full = model or fit_curve_mixed_model(training, pairs=pairs, made=made)
    own = set(made.rows.loc[made.rows["category"] == target, "tire_id"])
    shared = sorted(own & set(made.rows.loc[made.rows["category"] != target, "tire_id"]))
    if not shared:
        raise DomainError(
            f"no tire of {target} was measured by another category", todo="use the tuning set instead"
        )
    taught = None
    if batch is not None:
        known = batch["tire_id"].isin(training["tire_id"]) | (batch["category"] == target)
        taught = TaughtCells.of_files(full, batch[~known]), TaughtCells.of_training(made)
    return pd.concat([_one(made, full, target, tire, taught) for tire in shared], ignore_index=True)


def _one(
    made: PreparedTraining,
    full: CurveMixedModel,
    target: str,
    tire: str,
    taught: tuple[TaughtCells, TaughtCells] | None,
) -> pd.DataFrame:
    """Translate one such tire; ``taught``: cells of the batch, if one teaches, and of the training files."""
    keep = (made.rows["tire_id"] != tire).to_numpy()
    design = made.design
    columns = design.tire[keep].sum(axis=0) > 1
    without = Design(
        {name: block[keep] for name, block in design.blocks.items()},
        design.tire[keep][:, columns],
        design.files[keep],
    )
    fitted = tuple(
        posterior_weights(without, made.cells.scores[keep, k] / made.scale[k], full.fitted[k].variances)
        for k in range(made.scale.size)
    )
    model = replace(full, fitted=fitted)
    if taught is not None:
        cells, training = taught
        model = learn_from(model, cells, training.part(keep), made.cells.repeats / made.scale)
    left = made.rows.loc[~keep]
    sources = left.loc[left["category"] != target]
    found = shortened(model, model.predict(sources, target))
    measured = made.cells.scores[np.flatnonzero(~keep)[(left["category"] == target).to_numpy()]]
    error, unchanged = (_error(model, scores - measured) for scores in (found.target, found.source))
    return pd.DataFrame(
        {
            "tire_id": tire,
            "source": sources["category"].to_numpy(),
            "error": error,
            "error_unchanged": unchanged,
            "ratio": error / unchanged,
        }
    )


def _error(model: CurveMixedModel, gap: np.ndarray) -> np.ndarray:
    total, features = np.zeros(len(gap)), 0
    for name, part in PARTS.items():
        if part.group in ("lateral", "longitudinal"):
            back = model.space.back[name]
            total += ((gap[:, model.space.slices[name]] @ back) ** 2).sum(axis=1)
            features += back.shape[1]
    return total / features
