"""What a target would measure: a mixed model of curve scores, conditioned on the metadata.

For every score: tire (metadata, size, what is its own) + category + category x metadata + category x kind of
tire +
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

from tire_pipeline.translation.class_search import with_classes
from tire_pipeline.translation.curve_space import CurveSpace
from tire_pipeline.translation.metadata import Metadata
from tire_pipeline.translation.mixed_effects import Fitted
from tire_pipeline.translation.tire_classes import TireClasses


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
    expected : ndarray
        What the target would measure of such a tire, from metadata and class alone.
    classes : ndarray, shape (n, k)
        Probability of each class of tire.
    """

    source: np.ndarray
    shift: np.ndarray
    shift_variance: np.ndarray
    target: np.ndarray
    variance: np.ndarray
    surprise: np.ndarray
    expected: np.ndarray
    classes: np.ndarray


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
    spread : ndarray, shape (categories, p)
        How much more than the average a category spreads what is the tires' own.
    classes : TireClasses or None
        Classes of tires that no metadata names.
    """

    space: CurveSpace
    metadata: Metadata
    categories: tuple[str, ...]
    pairs: bool
    kinds: np.ndarray
    scale: np.ndarray
    fitted: tuple[Fitted, ...]
    spread: np.ndarray
    classes: TireClasses | None = None

    def regressors(self, table: pd.DataFrame, category: np.ndarray) -> list[np.ndarray]:
        """Rows of the design without tire effects, if ``category`` had measured: for each class, (n, m)."""
        blocks = design_blocks(self.metadata, self.kinds, table, category, self.categories)
        if self.classes is None:
            return [np.concatenate(list(blocks.values()), axis=1)]
        codes = self.classes.coded(np.eye(self.classes.count))
        every = [with_classes(blocks, np.tile(code, (len(table), 1))) for code in codes]
        return [np.concatenate(list(one.values()), axis=1) for one in every]

    def class_probability(
        self, table: pd.DataFrame, source: np.ndarray, here: list[np.ndarray]
    ) -> np.ndarray:
        """Probability of each class of tire, (n, k), given its metadata and its scores (n, p)."""
        if self.classes is None:
            return np.ones((len(table), 1))
        telling = self.classes.scores
        weights = np.stack([self.fitted[k].mean[: here[0].shape[1]] for k in telling], axis=1)
        scaled = source[:, telling] / self.scale[telling]
        gap = np.stack([scaled - x @ weights for x in here], axis=1)
        once = [
            self.fitted[k].variances["tire_category"] + self.fitted[k].variances["noise"] for k in telling
        ]
        alone = np.tile(once, (len(table), 1))
        return self.classes.probability(self.metadata.regressors(table), gap, alone)

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
        place = {name: k for k, name in enumerate(self.categories)}
        spread = self.spread[[place[name] for name in table["category"].astype(str)]]
        same = (table["category"].to_numpy(dtype=str) == target).astype(float)
        likely = self.class_probability(table, source, here)
        found = [
            _predict_score(fitted, column / scale, here, there, likely, same, trust, (mine, theirs))
            for fitted, column, scale, mine, theirs in zip(
                self.fitted, source.T, self.scale, spread.T, self.spread[place[target]], strict=True
            )
        ]
        shift, shift_variance, aim, variance, surprise, expected = (
            np.stack(part, axis=1) for part in zip(*found, strict=True)
        )
        return Prediction(
            source,
            shift * self.scale,
            shift_variance * self.scale**2,
            aim * self.scale,
            variance * self.scale**2,
            surprise,
            expected * self.scale,
            likely,
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
            "spread": self.spread,
            **(self.classes.to_state() if self.classes else {}),
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
            np.asarray(state["spread"]),
            TireClasses.from_state(state) if "class_own" in state else None,
        )


def _predict_score(
    fitted: Fitted,
    source: np.ndarray,
    here: list[np.ndarray],
    there: list[np.ndarray],
    likely: np.ndarray,
    same: np.ndarray,
    trust: float,
    spread: tuple[np.ndarray, float],
) -> tuple[np.ndarray, ...]:
    """Shift, its variance, prediction, its variance, surprise, expectation, in deviations of the score.

    Each is what it is for each class of tire, drawn together by the classes' probabilities.
    """
    each = [
        _predict_in_class(fitted, source, mine, theirs, same, trust, spread)
        for mine, theirs in zip(here, there, strict=True)
    ]
    columns = [np.stack(part, axis=1) for part in zip(*each, strict=True)]
    mean = [(likely * values).sum(axis=1) for values in columns]
    for value, variance in ((0, 1), (2, 3)):  # what the class leaves open
        mean[variance] = mean[variance] + (likely * (columns[value] - mean[value][:, None]) ** 2).sum(axis=1)
    return tuple(mean)


def _predict_in_class(
    fitted: Fitted,
    source: np.ndarray,
    here: np.ndarray,
    there: np.ndarray,
    same: np.ndarray,
    trust: float,
    spread: tuple[np.ndarray, float],
) -> tuple[np.ndarray, ...]:
    """As :func:`_predict_score`, for a tire of a known class."""
    count = here.shape[1]
    weights, covariance = fitted.mean[:count], fitted.covariance[:count, :count]
    at_source, at_target = here @ weights, there @ weights
    own = fitted.variances["tire"]
    once = fitted.variances["tire_category"] + fitted.variances["noise"]
    to_here, to_there = here @ covariance, there @ covariance
    mine, theirs = spread
    source_variance = (to_here * here).sum(1) + mine**2 * own + once
    target_variance = (to_there * there).sum(1) + theirs**2 * own + once
    together = (to_here * there).sum(1) + mine * theirs * own + same * fitted.variances["tire_category"]
    apart = there - here
    shift = at_target - at_source
    shift_variance = ((apart @ covariance) * apart).sum(1)
    slope = 1.0 - trust * (1.0 - together / source_variance)
    residual = source - at_source
    target = at_target + slope * residual
    variance = target_variance - 2.0 * slope * together + slope**2 * source_variance
    return shift, shift_variance, target, variance, residual / np.sqrt(source_variance), at_target


def design_blocks(
    metadata: Metadata,
    kinds: np.ndarray,
    table: pd.DataFrame,
    category: np.ndarray,
    categories: tuple[str, ...],
) -> dict[str, np.ndarray]:
    """Lay out the regressors of n tires as if ``category`` had measured them, by block, each (n, columns)."""
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
