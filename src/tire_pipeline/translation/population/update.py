"""What the files that are to be translated teach about the categories that measured them.

Whoever translates hundreds of a supplier's files holds hundreds of measurements that no training file has:
not the target's, but the supplier's side of the bias, who spreads what by how much, and which errors of a fit
belong together. The weights of the mixed model are Gaussian, so further cells update them exactly (conjugate
updating; Gelman et al., *Bayesian Data Analysis*, 14.8), without the training data; the variances of the
effects, the classes and the protocols stay as the training data gave them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.tire_table import told_tires
from tire_pipeline.translation.population.category_spread import FREEDOM
from tire_pipeline.translation.population.classes.search_input import per_tire
from tire_pipeline.translation.population.fit_model import PreparedTraining, own_and_links
from tire_pipeline.translation.population.mixed_effects import Fitted
from tire_pipeline.translation.population.model import CurveMixedModel


@dataclass(frozen=True)
class TaughtCells:
    """Files of one tire in one category, averaged, as the mixed model takes them.

    Attributes
    ----------
    design : ndarray, shape (c, m)
        Regressors without tire effects.
    scores : ndarray, shape (c, p)
        In their standard deviations.
    category : ndarray of int, shape (c,)
        Place among the model's categories.
    tire : ndarray of int, shape (c,)
        Cells of one number are of one tire, as far as that may be used.
    files : ndarray, shape (c,)
        How many files.
    """

    design: np.ndarray
    scores: np.ndarray
    category: np.ndarray
    tire: np.ndarray
    files: np.ndarray

    @classmethod
    def of_training(cls, made: PreparedTraining) -> Self:
        """Lay out the training cells."""
        linked, column = np.nonzero(made.design.tire)
        tire = made.design.tire.shape[1] + np.arange(len(made.rows))
        tire[linked] = column
        return cls(
            np.concatenate(list(made.design.blocks.values()), axis=1),
            made.cells.scores / made.scale,
            made.design.blocks["category"].argmax(axis=1),
            tire,
            np.asarray(made.cells.files, dtype=float),
        )

    @classmethod
    def of_files(cls, model: CurveMixedModel, table: pd.DataFrame) -> Self:
        """Lay out n files of known categories; ``model.pairs`` says whether tires link them.

        A file counts for each class with that class's probability, which all files of its tire tell together.
        Given metadata and class, its tire is of the mean kind, as for a training file of a tire that one
        category measured.
        """
        source, _ = model.space.encode(table)
        category = table["category"].to_numpy(dtype=str)
        names = pd.Series(told_tires(table), table.index)
        cell = pd.factorize(category + "|" + names)[0]
        alike = pd.factorize(names)[0] if model.pairs else cell
        every = model.regressors(model.blocks(table, category, model.protocols.code(table)))
        likely = model.class_probability(table, source, every, alike)
        design = sum(likely[:, [k]] * one for k, one in enumerate(every))
        place = np.array([model.categories.index(name) for name in category])
        first = np.unique(cell, return_index=True)[1]
        tire = alike[first]
        return cls(
            per_tire(np.asarray(design), cell),
            per_tire(source / model.scale, cell),
            place[first],
            tire,
            np.bincount(cell).astype(float),
        )

    def __len__(self) -> int:
        return len(self.scores)

    def part(self, rows: np.ndarray) -> TaughtCells:
        """Return some of the cells, by their places or a mask."""
        return TaughtCells(**{name: value[rows] for name, value in vars(self).items()})

    def shared(self) -> np.ndarray:
        """Return an indicator column for each tire that more than one cell is of, (c, t)."""
        names, count = np.unique(self.tire, return_counts=True)
        return np.asarray(self.tire[:, None] == names[count > 1][None, :], dtype=float)

    def to_state(self) -> dict[str, Any]:
        """Return the arrays that restore it."""
        return {f"taught_{name}": value for name, value in vars(self).items()}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        names = ("design", "scores", "category", "tire", "files")
        return cls(*(np.asarray(state[f"taught_{name}"]) for name in names))


def learn_from(
    model: CurveMixedModel, cells: TaughtCells, training: TaughtCells, repeats: np.ndarray
) -> CurveMixedModel:
    """Let a fitted model learn from further cells.

    Parameters
    ----------
    model : CurveMixedModel
        As the training data gave it.
    cells : TaughtCells
        Of tires that the training data has not; none: the model stays as it is.
    training : TaughtCells
        What the model was fitted to.
    repeats : ndarray, shape (n, p)
        Training files less their cell's location, scores in their standard deviations.

    Returns
    -------
    CurveMixedModel
        With other weights, spreads, variances alone and links.
    """
    if not len(cells):
        return model
    first = replace(model, fitted=updated_weights(model, cells))
    both = _joined(training, cells)
    weights = np.stack([one.mean[: both.design.shape[1]] for one in first.fitted], axis=1)
    gaps = both.scores - both.design @ weights
    spread, alone, links = own_and_links(
        first.fitted,
        gaps,
        both.category,
        both.shared(),
        both.files,
        repeats,
        model.space,
        len(model.categories),
    )
    second = replace(model, spread=spread, alone=alone, links=links)
    return replace(second, fitted=updated_weights(second, cells))


def _joined(training: TaughtCells, cells: TaughtCells) -> TaughtCells:
    parts = [vars(training), {**vars(cells), "tire": cells.tire + training.tire.max() + 1}]
    return TaughtCells(**{name: np.concatenate([part[name] for part in parts]) for name in parts[0]})


def updated_weights(model: CurveMixedModel, cells: TaughtCells) -> tuple[Fitted, ...]:
    """Posterior of every score's weights given the cells; tire effects of the training tires left out."""
    order = np.argsort(cells.tire, kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(cells.tire[order])) + 1)
    found = []
    for k, one in enumerate(model.fitted):
        count = cells.design.shape[1]
        mean, covariance = one.mean[:count], one.covariance[:count, :count]
        gap = cells.scores[:, k] - cells.design @ mean
        reach = np.sqrt(one.variances["tire"]) * model.spread[cells.category, k]
        error = model.alone[cells.category, k] + one.variances["noise"] / cells.files
        expected = reach**2 + error + ((cells.design @ covariance) * cells.design).sum(axis=1)
        inflation = np.sqrt(np.maximum((FREEDOM - 2.0 + gap**2 / expected) / (FREEDOM + 1.0), 1.0))
        white = _whitened(np.column_stack([cells.design, gap]), groups, reach, error, inflation)
        design, response = white[:, :-1], white[:, -1]
        posterior = np.linalg.inv(np.linalg.inv(covariance) + design.T @ design)
        posterior = 0.5 * (posterior + posterior.T)
        found.append(Fitted(one.variances, mean + posterior @ (design.T @ response), posterior))
    return tuple(found)


def _whitened(
    rows: np.ndarray, groups: list[np.ndarray], reach: np.ndarray, error: np.ndarray, inflation: np.ndarray
) -> np.ndarray:
    """Rows divided by the root of their covariance: what is a tire's own is common to its cells."""
    out = np.empty_like(rows)
    for group in groups:
        covariance = np.outer(reach[group], reach[group]) + np.diag(error[group])
        covariance = covariance * np.outer(inflation[group], inflation[group])
        out[group] = np.linalg.solve(np.linalg.cholesky(covariance), rows[group])
    return out
