"""What a target would measure: a mixed model of curve scores, conditioned on the metadata.

For every score: tire (metadata, size, what is its own) + category + category x metadata + category x kind of tire +
noise. The target's measurement of a tire is then predicted from the source's measurement of it: the source's
score, moved by the difference of the categories' effects, and drawn a little towards what the metadata lets
expect, by as much as the source is noise.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.translation.curve_space import Cells, CurveSpace, fit_curve_space
from tire_pipeline.translation.metadata import Metadata
from tire_pipeline.translation.mixed_effects import Design, Fitted, fit_mixed_effects

GUESS = {
    "level": 100.0,
    "metadata": 0.1,
    "size": 0.05,
    "category": 0.1,
    "category_metadata": 0.01,
    "category_kind": 0.01,
    "tire": 0.2,
}
"""Where the search for the variances begins, in units of a score's own variance."""

TIRE_CATEGORY_SHARE = 0.4
"""Variance of what one tire does in one category alone, over that of the noise, if no tire tells."""

KIND_SCORES = {
    "cornering stiffness": 1,
    "lateral friction": 2,
    "lateral shape": 1,
    "longitudinal friction": 1,
}
"""The scores whose metadata-predicted values say what kind of tire it is."""


@dataclass(frozen=True)
class Prediction:
    """What the target would measure, in scores; arrays (n, p).

    Attributes
    ----------
    source : ndarray
        Scores of the source files.
    shift : ndarray
        Target's effect less the source's, for this tire.
    shift_variance : ndarray
        Of the estimate of ``shift``.
    target : ndarray
        Predicted scores of the target's file.
    variance : ndarray
        Of the target's file about ``target``, its noise included.
    surprise : ndarray
        Source's score less its expectation, over the standard deviation of that.
    """

    source: np.ndarray
    shift: np.ndarray
    shift_variance: np.ndarray
    target: np.ndarray
    variance: np.ndarray
    surprise: np.ndarray


@dataclass(frozen=True)
class CurveMixedModel:
    """The fitted model.

    Attributes
    ----------
    space : CurveSpace
    metadata : Metadata
    categories : tuple of str
    pairs : bool
        Whether tires that several categories measured link these.
    kinds : ndarray, shape (metadata + sizes, k)
        Metadata to kind of tire.
    scale : ndarray, shape (p,)
        Standard deviation of each score over the training cells.
    fitted : tuple of Fitted
        One a score.
    """

    space: CurveSpace
    metadata: Metadata
    categories: tuple[str, ...]
    pairs: bool
    kinds: np.ndarray
    scale: np.ndarray
    fitted: tuple[Fitted, ...]

    def regressors(self, table: pd.DataFrame, category: np.ndarray) -> np.ndarray:
        """Rows of the design without tire effects, if ``category`` had measured, (n, m)."""
        blocks = _blocks(self.metadata, self.kinds, table, category, self.categories)
        return np.concatenate(list(blocks.values()), axis=1)

    def predict(self, table: pd.DataFrame, target: str, *, trust: float = 1.0) -> Prediction:
        """Predict what ``target`` would measure.

        Parameters
        ----------
        table : DataFrame
            n source files, of known categories.
        target : str
        trust : float
            How much of the model's drawing towards the expectation is followed: 0 moves by the
            categories' difference only.

        Returns
        -------
        Prediction
        """
        source, _ = self.space.encode(table)
        here = self.regressors(table, table["category"].to_numpy(dtype=str))
        there = self.regressors(table, np.full(len(table), target))
        same = (table["category"].to_numpy(dtype=str) == target).astype(float)
        found = [
            _predict_score(fitted, column / scale, here, there, same, trust)
            for fitted, column, scale in zip(self.fitted, source.T, self.scale, strict=True)
        ]
        shift, shift_variance, aim, variance, surprise = (
            np.stack(part, axis=1) for part in zip(*found, strict=True)
        )
        return Prediction(
            source,
            shift * self.scale,
            shift_variance * self.scale**2,
            aim * self.scale,
            variance * self.scale**2,
            surprise,
        )

    def to_state(self) -> dict[str, Any]:
        """Give arrays, strings and numbers that bring it back."""
        names = list(self.fitted[0].variances)
        return {
            **self.space.to_state(),
            **self.metadata.to_state(),
            "categories": np.array(self.categories, dtype=str),
            "pairs": bool(self.pairs),
            "kinds": self.kinds,
            "scale": self.scale,
            "variance_names": np.array(names, dtype=str),
            "variances": np.array([[f.variances[name] for name in names] for f in self.fitted]),
            "weights": np.stack([f.mean for f in self.fitted]),
            "weight_covariances": np.stack([f.covariance for f in self.fitted]),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Bring back what :meth:`to_state` gave."""
        names = [str(name) for name in state["variance_names"]]
        fitted = tuple(
            Fitted(dict(zip(names, map(float, row), strict=True)), mean, covariance)
            for row, mean, covariance in zip(
                state["variances"], state["weights"], state["weight_covariances"], strict=True
            )
        )
        return cls(
            CurveSpace.from_state(state),
            Metadata.from_state(state),
            tuple(str(name) for name in state["categories"]),
            bool(state["pairs"]),
            np.asarray(state["kinds"]),
            np.asarray(state["scale"]),
            fitted,
        )


def _predict_score(
    fitted: Fitted, source: np.ndarray, here: np.ndarray, there: np.ndarray, same: np.ndarray, trust: float
) -> tuple[np.ndarray, ...]:
    """Shift, its variance, prediction, its variance, surprise; all in units of the score's deviation."""
    count = here.shape[1]
    weights, covariance = fitted.mean[:count], fitted.covariance[:count, :count]
    at_source, at_target = here @ weights, there @ weights
    own = fitted.variances["tire"]
    once = fitted.variances["tire_category"] + fitted.variances["noise"]
    to_here, to_there = here @ covariance, there @ covariance
    source_variance = (to_here * here).sum(1) + own + once
    target_variance = (to_there * there).sum(1) + own + once
    together = (to_here * there).sum(1) + own + same * fitted.variances["tire_category"]
    apart = there - here
    shift = at_target - at_source
    shift_variance = ((apart @ covariance) * apart).sum(1)
    slope = 1.0 - trust * (1.0 - together / source_variance)
    residual = source - at_source
    target = at_target + slope * residual
    variance = target_variance - 2.0 * slope * together + slope**2 * source_variance
    return shift, shift_variance, target, variance, residual / np.sqrt(source_variance)


def _blocks(
    metadata: Metadata,
    kinds: np.ndarray,
    table: pd.DataFrame,
    category: np.ndarray,
    categories: tuple[str, ...],
) -> dict[str, np.ndarray]:
    x = metadata.regressors(table)
    size = metadata.size_indicators(table)
    actor = (category[:, None] == np.array(categories)[None, :]).astype(float)
    blocks = {"level": np.ones((len(table), 1)), "metadata": x, "size": size, "category": actor}
    blocks["category_metadata"] = _products(actor, x)
    if kinds.shape[1]:
        blocks["category_kind"] = _products(actor, np.concatenate([x, size], axis=1) @ kinds)
    return blocks


def _products(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    return (left[:, :, None] * right[:, None, :]).reshape(len(left), -1)


def _tire_columns(cells: pd.DataFrame, pairs: bool) -> np.ndarray:
    """One column for each tire that several categories measured, if these may be used."""
    tires = cells["tire_id"].to_numpy(dtype=str)
    names, count = np.unique(tires, return_counts=True)
    shared = names[count > 1] if pairs else names[:0]
    return (tires[:, None] == shared[None, :]).astype(float)


def fit_curve_mixed_model(training: pd.DataFrame, *, pairs: bool, kinds: int = 3) -> CurveMixedModel:
    """Fit the model to a training table.

    Parameters
    ----------
    training : DataFrame
        Tire table with ``category`` and ``tire_id``.
    pairs : bool
        Use it that several categories measured a tire.
    kinds : int
        Numbers that say what kind of tire it is, for interactions.

    Returns
    -------
    CurveMixedModel
    """
    space, cells = fit_curve_space(training)
    rows = training.iloc[cells.row].reset_index(drop=True)
    metadata = Metadata.fit(training)
    categories = tuple(np.unique(training["category"].to_numpy(dtype=str)))
    tires = _tire_columns(rows, pairs)
    scale = np.maximum(cells.scores.std(axis=0), 1e-9)
    turn = np.zeros((len(metadata.names) + len(metadata.sizes), 0))
    if kinds and metadata.names:
        turn = _kinds(rows, cells, metadata, categories, tires, scale, space, kinds)
    blocks = _blocks(metadata, turn, rows, rows["category"].to_numpy(dtype=str), categories)
    design = Design(blocks, tires, cells.files)
    fitted = tuple(_fit_score(design, cells, space, scale, k) for k in range(scale.size))
    return CurveMixedModel(space, metadata, categories, bool(tires.shape[1]), turn, scale, fitted)


def _fit_score(design: Design, cells: Cells, space: CurveSpace, scale: np.ndarray, k: int) -> Fitted:
    noise = float(space.noise[k] / scale[k] ** 2)
    alone = TIRE_CATEGORY_SHARE * noise
    guess = {**GUESS, "tire_category": alone}
    estimated = design.tire.shape[1] >= 4
    return fit_mixed_effects(
        design,
        cells.scores[:, k] / scale[k],
        noise=noise,
        guess=guess,
        tire_category=None if estimated else alone,
    )


def _kinds(
    rows: pd.DataFrame,
    cells: Cells,
    metadata: Metadata,
    categories: tuple[str, ...],
    tires: np.ndarray,
    scale: np.ndarray,
    space: CurveSpace,
    count: int,
) -> np.ndarray:
    """Find the directions in the metadata along which the tires themselves differ most."""
    category = rows["category"].to_numpy(dtype=str)
    none = np.zeros((len(metadata.names) + len(metadata.sizes), 0))
    design = Design(_blocks(metadata, none, rows, category, categories), tires, cells.files)
    own = slice(1, 1 + len(none))
    weights = []
    for part, first in KIND_SCORES.items():
        start = space.slices[part].start
        weights += [_fit_score(design, cells, space, scale, start + k).mean[own] for k in range(first)]
    x = np.concatenate([metadata.regressors(rows), metadata.size_indicators(rows)], axis=1)
    predicted = x @ np.stack(weights, axis=1)
    _, size, axes = np.linalg.svd(predicted - predicted.mean(axis=0), full_matrices=False)
    keep = min(count, int((size > 1e-6 * size[0]).sum()))
    return np.stack(weights, axis=1) @ axes[:keep].T / (size[:keep] / np.sqrt(len(x)))
