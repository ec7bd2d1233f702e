"""What a target would measure: a mixed model of curve scores, conditioned on the metadata.

For every score: tire (metadata, size, class, what is its own) + category + category x metadata + category's
protocol + category x kind of tire + category x class + tire in this category + noise. The target's
measurement of a tire is then predicted from the source's measurement of it: the source's score, moved by the
difference of the categories' effects, and drawn a little towards what the metadata lets expect, by as much as
the source is noise or its own fit. Stiffness and shape of one output are combined, because their errors
belong together (:mod:`.fit_links`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.numerics.row_products import by_row
from tire_pipeline.translation.curves.space import CurveSpace
from tire_pipeline.translation.population.classes.search import with_classes
from tire_pipeline.translation.population.classes.search_input import per_tire
from tire_pipeline.translation.population.classes.tire_classes import TireClasses
from tire_pipeline.translation.population.evidence import CATEGORY_BLOCKS, probability_of_difference
from tire_pipeline.translation.population.fit_links import FitLinks, linked_blocks
from tire_pipeline.translation.population.kinds import TireKinds, with_kinds
from tire_pipeline.translation.population.metadata import Metadata
from tire_pipeline.translation.population.mixed_effects import NOT_BLOCKS, Fitted
from tire_pipeline.translation.population.protocols.of_files import NO_PROTOCOL_CHANGE, Protocols
from tire_pipeline.translation.population.score_prediction import CategoryReading, predict_block

POPULATION = "population"
"""Block of what the tires that only one category measured have in common, beside its way of measuring: a
supplier measures its own tires. It is told from the bias by tires that several categories measured."""


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
    taught : ndarray, shape (n,)
        By how many files of other tires in the same batch: 0 but for :mod:`.predict.batch`.
    differs : ndarray
        Probability that the source measures otherwise than the target (:mod:`.evidence`).
    """

    source: np.ndarray
    shift: np.ndarray
    shift_variance: np.ndarray
    target: np.ndarray
    variance: np.ndarray
    surprise: np.ndarray
    expected: np.ndarray
    classes: np.ndarray
    taught: np.ndarray
    differs: np.ndarray


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
    kinds : TireKinds or None
        What kind of tire it is.
    scale : ndarray, shape (p,)
        Standard deviation of each score over the training cells.
    fitted : tuple of Fitted
        One a score.
    spread : ndarray, shape (categories, p)
        How much a category spreads what is the tires' own.
    alone : ndarray, shape (categories, p)
        Variance of what one tire does in this category only, scores in their standard deviations.
    links : FitLinks
        What the errors of one fit have to do with each other.
    classes : TireClasses or None
        Classes of tires that no metadata names.
    protocols : Protocols
        Categories that changed how they measure.
    tells_unbiased : bool
        Whether a property is changed only as far as its source probably measures it otherwise. Models that
        were fitted before version 5 change all of it, and translate as they did.
    """

    space: CurveSpace
    metadata: Metadata
    categories: tuple[str, ...]
    pairs: bool
    kinds: TireKinds | None
    scale: np.ndarray
    fitted: tuple[Fitted, ...]
    spread: np.ndarray
    alone: np.ndarray
    links: FitLinks
    classes: TireClasses | None = None
    protocols: Protocols = NO_PROTOCOL_CHANGE
    tells_unbiased: bool = True

    def blocks(
        self, table: pd.DataFrame, category: np.ndarray, protocol: np.ndarray
    ) -> list[dict[str, np.ndarray]]:
        """Blocks of the design, without tire effects and kinds, if ``category`` had measured, for each class.

        ``protocol`` is the protocols' code, (n, changes), see :class:`.protocols.of_files.Protocols`.
        """
        blocks = design_blocks(self.metadata, table, category, self.categories, protocol)
        if POPULATION in self._blocks:
            blocks[POPULATION] = members(table["category"].to_numpy(dtype=str), self.categories)
        if self.classes is None:
            return [blocks]
        codes = self.classes.coded(np.eye(self.classes.count))
        return [with_classes(blocks, np.tile(code, (len(table), 1))) for code in codes]

    def regressors(
        self, every: list[dict[str, np.ndarray]], own: list[np.ndarray] | None = None
    ) -> list[np.ndarray]:
        """Rows of the design without tire effects: for each class, (n, m), from its :meth:`blocks`.

        ``own`` is what is a tire's own in the scores of :attr:`kinds`, (n, q) for each class; 0 if not given.
        """
        if self.kinds is not None:
            none = np.zeros((len(every[0]["level"]), self.kinds.scores.size))
            own = own or [none] * len(every)
            every = [with_kinds(one, self.kinds.of(one, mine)) for one, mine in zip(every, own, strict=True)]
        return [np.concatenate(list(one.values()), axis=1) for one in every]

    def own_scores(self, source: np.ndarray, place: np.ndarray, here: list[np.ndarray]) -> list[np.ndarray]:
        """What is a tire's own in the scores of its kind, for each class (n, q), from its scores (n, p).

        Where the category's spread is 1, as in :func:`.fit_model.prepare`: it is the tire's, whoever
        measures.
        """
        if self.kinds is None:
            return []
        chosen = self.kinds.scores
        own, noise = (
            np.array([self.fitted[k].variances[name] for k in chosen]) for name in ("tire", "noise")
        )
        spread, alone = self.spread[np.ix_(place, chosen)], self.alone[np.ix_(place, chosen)]
        share = spread * own / (spread**2 * own + alone + noise)
        return [share * gap for gap in self._gap(source, chosen, here)]

    def _gap(self, source: np.ndarray, chosen: np.ndarray, here: list[np.ndarray]) -> list[np.ndarray]:
        """Scores less what is expected of each class, each (n, q), in their standard deviations."""
        weights = np.stack([self.fitted[k].mean[: here[0].shape[1]] for k in chosen], axis=1)
        return [source[:, chosen] / self.scale[chosen] - by_row(x, weights) for x in here]

    def class_probability(
        self,
        table: pd.DataFrame,
        source: np.ndarray,
        here: list[np.ndarray],
        tire: np.ndarray | None = None,
    ) -> np.ndarray:
        """Probability of each class of tire, (n, k), given its metadata and its scores (n, p).

        ``tire`` (n,) numbers the tires from 0: files of one tell its class together; without it each file is
        of a tire of its own. Spread and variance alone are the common ones of all categories, as in the
        search for the classes: on tuning fleets each category's own made translations 1% worse.
        """
        if self.classes is None:
            return np.ones((len(table), 1))
        tire = np.arange(len(table)) if tire is None else tire
        telling = self.classes.scores
        gap = per_tire(np.stack(self._gap(source, telling, here), axis=1), tire)
        once = np.array(
            [self.fitted[k].variances["tire_category"] + self.fitted[k].variances["noise"] for k in telling]
        )
        alone = once / np.bincount(tire)[:, None]
        metadata = per_tire(self.metadata.regressors(table), tire)
        return self.classes.probability(metadata, gap, alone)[tire]

    def _reading(self, place: np.ndarray, target: int, block: np.ndarray) -> CategoryReading:
        """How files of the categories ``place`` (n,), and ``target``, read the scores of ``block``."""
        spread, alone = self.spread[:, block], self.alone[:, block]
        here = np.ix_(block, block)
        return CategoryReading(
            spread[place],
            spread[target],
            alone[place],
            alone[target],
            place == target,
            self.links.own[here],
            self.links.error[here],
        )

    def predict(self, table: pd.DataFrame, target: str, *, trust: float = 1.0) -> Prediction:
        """Predict what ``target`` would measure.

        Parameters
        ----------
        table : DataFrame
            n source files, of known categories.
        target : str
        trust : float
            How much of the model's shrinkage towards the expectation is applied: 0 moves by the
            categories' difference only.

        Returns
        -------
        Prediction
        """
        source, _ = self.space.encode(table)
        category = table["category"].to_numpy(dtype=str)
        place = np.array([self.categories.index(name) for name in category])
        blocks = self.blocks(table, category, self.protocols.code(table))
        here = self.regressors(blocks)
        likely = self.class_probability(table, source, here)
        own = self.own_scores(source, place, here)
        here = self.regressors(blocks, own)
        now = self.protocols.newest(target, len(table))
        there = self.regressors(self.blocks(table, np.full(len(table), target), now), own)
        found = np.empty((6, *source.shape))
        for block in linked_blocks(self.space.slices):
            found[:, :, block] = predict_block(
                tuple(self.fitted[k] for k in block),
                source[:, block] / self.scale[block],
                here,
                there,
                likely,
                trust,
                self._reading(place, self.categories.index(target), block),
            )
        shift, shift_variance, aim, variance, surprise, expected = found
        steps = np.stack([one.mean[columns_of(self, "protocol")] for one in self.fitted], axis=1)
        unsure = by_row(self.protocols.unsure(table), steps**2)
        return Prediction(
            source,
            shift * self.scale,
            (shift_variance + unsure) * self.scale**2,
            aim * self.scale,
            (variance + unsure) * self.scale**2,
            surprise,
            expected * self.scale,
            likely,
            np.zeros(len(table)),
            self.probability_of_difference(target)[place],
        )

    def probability_of_difference(self, target: str) -> np.ndarray:
        """How probably each category measures otherwise than ``target``, (categories, p).

        One whose way of measuring changed, or all if the target's did, certainly do.
        """
        if not self.tells_unbiased:
            return np.ones((len(self.categories), len(self.fitted)))
        columns = {name: columns_of(self, name) for name in CATEGORY_BLOCKS if name in self._blocks}
        place = self.categories.index(target)
        found = probability_of_difference(self.fitted, self.space, columns, len(self.categories), place)
        changed = {change.category for change in self.protocols.changes}
        for k, name in enumerate(self.categories):
            if k != place and changed & {name, target}:
                found[k] = 1.0
        return found

    @property
    def _blocks(self) -> list[str]:
        """The blocks of the design, in their order."""
        return [name for name in self.fitted[0].variances if name not in NOT_BLOCKS]

    def to_state(self) -> dict[str, Any]:
        """Return the arrays, strings and numbers that restore it."""
        names = list(self.fitted[0].variances)
        return {
            **self.space.to_state(),
            **self.metadata.to_state(),
            "categories": np.array(self.categories, dtype=str),
            "pairs": bool(self.pairs),
            "tells_unbiased": bool(self.tells_unbiased),
            "scale": self.scale,
            "spread": self.spread,
            "alone": self.alone,
            **self.links.to_state(),
            **(self.kinds.to_state() if self.kinds else {}),
            **(self.classes.to_state() if self.classes else {}),
            **(self.protocols.to_state() if self.protocols.changes else {}),
            "variance_names": np.array(names, dtype=str),
            "variances": np.array([[f.variances[name] for name in names] for f in self.fitted]),
            "weights": np.stack([f.mean for f in self.fitted]),
            "weight_covariances": np.stack([f.covariance for f in self.fitted]),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        names = [str(name) for name in state["variance_names"]]
        fitted = tuple(
            # columns lie as the fit leaves them: sums in another order differ in the last bit
            Fitted(dict(zip(names, map(float, row), strict=True)), mean, np.asfortranarray(covariance))
            for row, mean, covariance in zip(
                state["variances"], state["weights"], state["weight_covariances"], strict=True
            )
        )
        return cls(
            CurveSpace.from_state(state),
            Metadata.from_state(state),
            tuple(str(name) for name in state["categories"]),
            bool(state["pairs"]),
            TireKinds.from_state(state) if "kinds_turn" in state else None,
            np.asarray(state["scale"]),
            fitted,
            np.asarray(state["spread"]),
            np.asarray(state["alone"]),
            FitLinks.from_state(state, len(fitted)),
            TireClasses.from_state(state) if "class_own" in state else None,
            Protocols.from_state(state),
            bool(state.get("tells_unbiased", False)),
        )


def columns_of(model: CurveMixedModel, block: str) -> slice:
    """Where the weights of a block stand."""
    d, organisations = len(model.metadata.names), len(model.categories)
    classes = model.classes.count if model.classes else 0
    widths = {
        "level": 1,
        "metadata": d,
        "size": len(model.metadata.sizes),
        "category": organisations,
        "category_metadata": organisations * d,
        "protocol": len(model.protocols.changes),
        POPULATION: organisations if POPULATION in model._blocks else 0,
        "class": classes,
        "category_class": organisations * classes,
        "category_kind": organisations * (model.kinds.turn.shape[1] if model.kinds else 0),
    }
    start = 0
    for name, width in widths.items():
        if name == block:
            return slice(start, start + width)
        start += width
    raise KeyError(block)


def design_blocks(
    metadata: Metadata,
    table: pd.DataFrame,
    category: np.ndarray,
    categories: tuple[str, ...],
    protocol: np.ndarray,
) -> dict[str, np.ndarray]:
    """Lay out the regressors of n tires as if ``category`` had measured them, by block, each (n, columns).

    ``protocol`` (n, changes) is what :class:`.protocols.of_files.Protocols` gives; left out without columns.
    :data:`POPULATION`, :func:`.classes.search.with_classes` and :func:`.kinds.with_kinds` come after these.
    """
    x = metadata.regressors(table)
    organisation = members(category, categories)
    return {
        "level": np.ones((len(table), 1)),
        "metadata": x,
        "size": metadata.size_indicators(table),
        "category": organisation,
        "category_metadata": (organisation[:, :, None] * x[:, None, :]).reshape(len(organisation), -1),
        **({"protocol": protocol} if protocol.shape[1] else {}),
    }


def members(category: np.ndarray, categories: tuple[str, ...]) -> np.ndarray:
    """Indicators of the categories, (n, categories)."""
    return (category[:, None] == np.array(categories)[None, :]).astype(float)
