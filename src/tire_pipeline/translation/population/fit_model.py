"""Fit the mixed model of curve scores to a training table."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.progress import track
from tire_pipeline.tire_table import told_tires
from tire_pipeline.translation.curves.space import PARTS, CurveSpace
from tire_pipeline.translation.population.category_spread import (
    FEWEST_SHARED,
    Residuals,
    category_spreads,
    shared_cells,
)
from tire_pipeline.translation.population.classes.search import find_classes, with_classes
from tire_pipeline.translation.population.classes.search_input import ClassSearchInput
from tire_pipeline.translation.population.classes.tire_classes import TireClasses
from tire_pipeline.translation.population.fit_links import Deviations, FitLinks, find_links, linked_blocks
from tire_pipeline.translation.population.fit_space import Cells, fit_curve_space
from tire_pipeline.translation.population.kinds import TIRE_BLOCKS, TireKinds, tire_regressors, with_kinds
from tire_pipeline.translation.population.metadata import Metadata
from tire_pipeline.translation.population.mixed_effects import Design, Fitted, fit_mixed_effects
from tire_pipeline.translation.population.model import (
    POPULATION,
    CurveMixedModel,
    design_blocks,
    members,
)
from tire_pipeline.translation.population.protocols.of_files import NO_PROTOCOL_CHANGE, Protocols, days_of
from tire_pipeline.translation.population.protocols.search import Dated, find_changes

VARIANCE_GUESS = {
    "level": 100.0,
    "metadata": 0.1,
    "size": 0.05,
    "category": 0.1,
    "category_metadata": 0.01,
    "protocol": 0.03,
    POPULATION: 0.03,
    "category_kind": 0.01,
    "class": 0.5,
    "category_class": 0.01,
    "tire": 0.1,
}
"""Where the search for the variances begins, in units of a score's own variance."""

TIRE_CATEGORY_SHARE = {"shape": 2.0, "aligning": 9.0}
"""Variance of what one tire does in one category alone, over that of the noise, if no tire tells, by part.
The shape of a curve depends on what else was fitted; stiffness and friction hardly do."""

_OTHER_SHARE = 0.5

SPREAD_WIDTH = {"stiffness": 0.02}
"""How far categories may differ in how they spread what is a tire's own, by part: standard deviation of a
logarithm. A fit draws shapes as it likes; what a rig does to a stiff tire more than to a soft one is what its
kind tells (:mod:`.kinds`), and a few dozen tires tell a spread to 10% only."""

_OTHER_WIDTH = 0.2

_POOLED_VARIANCES = ("category", "category_metadata", "category_kind", "category_class")
_POOLED_WIDTH = 1.0
_PRIOR_WIDTH = 3.0

CLASS_PARTS = {
    "cornering stiffness": 0,
    "lateral friction": 1,
    "slip stiffness": 2,
    "longitudinal friction": 1,
}
"""The parts whose scores tell classes of tires apart, and the property that each is of. Within a class
properties are taken to differ independently of each other: what links them is the class (latent
class analysis)."""

CLASS_BLOCKS = ("level", "metadata", "size", "category", "protocol", POPULATION)
"""The blocks of the model in which classes are looked for."""

CHANGE_GROUPS = ("lateral", "longitudinal")
"""The outputs that are searched for a change of protocol."""

KIND_PARTS = ("cornering stiffness", "lateral friction")
"""The parts whose scores say what kind of tire it is: what a soft rig does depends on its stiffness."""


def _tire_columns(cells: pd.DataFrame, pairs: bool) -> np.ndarray:
    """One column for each tire that several categories measured, if these may be used."""
    tires = told_tires(cells)
    names, count = np.unique(tires, return_counts=True)
    shared = names[count > 1] if pairs else names[:0]
    return (tires[:, None] == shared[None, :]).astype(float)


def fit_curve_mixed_model(
    training: pd.DataFrame, *, pairs: bool, kinds: int = 2, made: PreparedTraining | None = None
) -> CurveMixedModel:
    """Fit the model to a training table.

    Parameters
    ----------
    training : DataFrame
        Tire table with ``category`` and ``tire_id``.
    pairs : bool
        Use it that several categories measured a tire.
    kinds : int
        Numbers that say what kind of tire it is, for interactions.
    made : PreparedTraining, optional
        What :func:`prepare` gave for the same, if it is there already.

    Returns
    -------
    CurveMixedModel
    """
    made = made or prepare(training, pairs=pairs, kinds=kinds)
    fitted = _fit_scores(made.design, made.cells, made.space, made.scale)
    return made.model(fitted)


@dataclass(frozen=True)
class PreparedTraining:
    """Training data as the mixed model takes them.

    Attributes
    ----------
    rows : DataFrame
        One file of each cell.
    cells : Cells
    design : Design
    space, metadata, categories, kinds, scale, classes, protocols
        As in :class:`CurveMixedModel`.
    """

    rows: pd.DataFrame
    cells: Cells
    design: Design
    space: CurveSpace
    metadata: Metadata
    categories: tuple[str, ...]
    kinds: TireKinds | None
    scale: np.ndarray
    classes: TireClasses | None
    protocols: Protocols = NO_PROTOCOL_CHANGE

    def model(self, fitted: tuple[Fitted, ...]) -> CurveMixedModel:
        """Return the model with these weights."""
        category = self.design.blocks["category"]
        spread, alone, links = own_and_links(
            fitted,
            _gaps(self.design, self.cells, self.scale, fitted),
            category.argmax(axis=1),
            self.design.tire,
            self.cells.files,
            self.cells.repeats / self.scale,
            self.space,
            category.shape[1],
        )
        return CurveMixedModel(
            self.space,
            self.metadata,
            self.categories,
            bool(self.design.tire.shape[1]),
            self.kinds,
            self.scale,
            fitted,
            spread,
            alone,
            links,
            self.classes,
            self.protocols,
        )


def prepare(
    training: pd.DataFrame,
    *,
    pairs: bool,
    kinds: int = 2,
    space_and_cells: tuple[CurveSpace, Cells] | None = None,
) -> PreparedTraining:
    """Find the curve space (unless it is given), average cells, find classes, set up the design.

    Where files have dates, categories are searched for a change of protocol, too; if there is one, classes
    and design are laid out again with it.
    """
    space_and_cells = space_and_cells or fit_curve_space(training)
    made = _prepare(training, NO_PROTOCOL_CHANGE, pairs, kinds, space_and_cells)
    protocols = _protocols(training, made)
    return _prepare(training, protocols, pairs, kinds, space_and_cells) if protocols.changes else made


def _prepare(
    training: pd.DataFrame,
    protocols: Protocols,
    pairs: bool,
    kinds: int,
    space_and_cells: tuple[CurveSpace, Cells],
) -> PreparedTraining:
    """As :func:`prepare`, for protocols that are known."""
    space, cells = space_and_cells
    rows = training.iloc[cells.row].reset_index(drop=True)
    metadata = Metadata.fit(training)
    categories = tuple(np.unique(training["category"].to_numpy(dtype=str)))
    tires = _tire_columns(rows, pairs)
    scale = np.maximum(cells.scores.std(axis=0), 1e-9)
    category = rows["category"].to_numpy(dtype=str)
    code = np.zeros((len(rows), len(protocols.changes)))
    np.add.at(code, cells.cell, protocols.code(training))
    blocks = design_blocks(metadata, rows, category, categories, code / cells.files[:, None])
    if tires.shape[1] >= FEWEST_SHARED:  # fewer do not tell what a supplier measures from what it makes
        blocks[POPULATION] = members(category, categories) * (tires.sum(axis=1) == 0)[:, None]
    design = Design(blocks, tires, cells.files)
    classes, probability = _classes(design, cells, space, scale, metadata.regressors(rows))
    if classes is not None:
        design = Design(with_classes(blocks, classes.coded(probability)), tires, cells.files)
    found = None
    if kinds:
        found, own = _kinds(design, cells, space, scale, kinds)
        design = Design(with_kinds(design.blocks, found.of(design.blocks, own)), tires, cells.files)
    return PreparedTraining(
        rows, cells, design, space, metadata, categories, found, scale, classes, protocols
    )


def _protocols(training: pd.DataFrame, made: PreparedTraining) -> Protocols:
    """Search what the model leaves of each cell for changes of protocol, by the forces' scores."""
    day = days_of(training)
    if np.isnat(day).all():
        return NO_PROTOCOL_CHANGE
    x = np.concatenate(list(made.design.blocks.values()), axis=1)
    parts = {n: place for n, place in made.space.slices.items() if PARTS[n].group in CHANGE_GROUPS}
    gap = np.zeros_like(made.cells.scores)
    searched = np.concatenate([np.arange(s.start, s.stop) for s in parts.values()])
    for k in track(searched, "looking for changes of protocol"):
        one = _fit_score(made.design, made.cells, made.space, made.scale, k, VARIANCE_GUESS)
        gap[:, k] = made.cells.scores[:, k] / made.scale[k] - x @ one.mean[: x.shape[1]]
    dated = Dated(gap, made.rows["category"].to_numpy(dtype=str), day, made.cells.cell)
    return Protocols(find_changes(dated, parts))


def _classes(
    design: Design, cells: Cells, space: CurveSpace, scale: np.ndarray, metadata: np.ndarray
) -> tuple[TireClasses | None, np.ndarray]:
    """Classes of tires, by the scores of stiffness and friction.

    What a tire does in one category alone is taken by its share of the noise even where tires that several
    categories measured could tell: without classes, what a category does to a class would be counted into it.
    """
    telling = np.concatenate([np.arange(s.start, s.stop) for s in (space.slices[n] for n in CLASS_PARTS)])
    kind = np.concatenate(
        [np.full(space.slices[n].stop - space.slices[n].start, k) for n, k in CLASS_PARTS.items()]
    )
    blocks = {name: design.blocks[name] for name in CLASS_BLOCKS if name in design.blocks}
    plain = Design(blocks, design.tire, design.files)
    fitted = [
        _fit_score(plain, cells, space, scale, k, VARIANCE_GUESS, alone_known=True)
        for k in track(telling, "fitting what tells classes of tires")
    ]
    linked = np.concatenate([np.zeros((len(cells.row), 1)), design.tire], axis=1).argmax(axis=1)
    same = np.where(linked > 0, linked, -1 - np.arange(len(cells.row)))
    question = ClassSearchInput(
        plain,
        cells.scores[:, telling] / scale[telling],
        np.unique(same, return_inverse=True)[1],
        metadata,
        space.noise[telling] / scale[telling] ** 2,
        np.array([f.variances["tire_category"] for f in fitted]),
        tuple(f.variances for f in fitted),
        telling,
        kind[:, None] == kind[None, :],
    )
    return find_classes(question)


def _of_part(space: CurveSpace, k: int, values: dict[str, float], other: float) -> float:
    """Value of the part that score ``k`` belongs to, by a word of its name."""
    part = next(name for name, place in space.slices.items() if place.start <= k < place.stop)
    return next((value for word, value in values.items() if word in part), other)


def _fit_scores(design: Design, cells: Cells, space: CurveSpace, scale: np.ndarray) -> tuple[Fitted, ...]:
    """Fit every score twice: the second time the size of the bias is expected as it was found in all of them.

    Six categories tell little about the variance of their effects on one score; all scores together do.
    """
    numbers = track(range(scale.size), "fitting each property of the curves")
    first = [_fit_score(design, cells, space, scale, k, VARIANCE_GUESS) for k in numbers]
    noise = space.noise / scale**2
    common = {
        name: float(np.exp(np.mean(np.log(np.array([f.variances[name] for f in first]) / noise))))
        for name in _POOLED_VARIANCES
        if name in first[0].variances
    }
    guesses = [{**VARIANCE_GUESS, **{name: common[name] * one for name in common}} for one in noise]
    again = track(guesses, "fitting each with what all have in common")
    return tuple(
        _fit_score(design, cells, space, scale, k, guess, tuple(common)) for k, guess in enumerate(again)
    )


def _fit_score(
    design: Design,
    cells: Cells,
    space: CurveSpace,
    scale: np.ndarray,
    k: int,
    guess: dict[str, float],
    pooled: tuple[str, ...] = (),
    alone_known: bool = False,
) -> Fitted:
    noise = float(space.noise[k] / scale[k] ** 2)
    alone = _of_part(space, k, TIRE_CATEGORY_SHARE, _OTHER_SHARE) * noise
    guess = {**guess, "tire_category": alone}
    estimated = design.tire.shape[1] >= FEWEST_SHARED and not alone_known
    return fit_mixed_effects(
        design,
        cells.scores[:, k] / scale[k],
        noise=noise,
        guess=guess,
        width={name: _POOLED_WIDTH if name in pooled else _PRIOR_WIDTH for name in guess},
        tire_category=None if estimated else alone,
    )


def own_and_links(
    fitted: tuple[Fitted, ...],
    gaps: np.ndarray,
    category: np.ndarray,
    shared: np.ndarray,
    files: np.ndarray,
    repeats: np.ndarray,
    space: CurveSpace,
    categories: int,
) -> tuple[np.ndarray, np.ndarray, FitLinks]:
    """How much a category spreads what is the tires' own, its variance alone, and how errors belong together.

    Parameters
    ----------
    fitted : tuple of Fitted
    gaps : ndarray, shape (c, p)
        Cells less their expectation, what is the tire's own left in, scores in their standard deviations.
    category : ndarray of int, shape (c,)
    shared : ndarray, shape (c, t)
        A column for each tire that several categories measured.
    files : ndarray, shape (c,)
    repeats : ndarray, shape (n, p)
        Files less their cell's location, in the same unit.
    space : CurveSpace
    categories : int
        How many there are.

    Returns
    -------
    spread, alone : ndarray, shape (categories, p)
    links : FitLinks
    """
    place = shared_cells(shared, category, categories)
    spread, alone = (np.ones((categories, len(fitted))) for _ in range(2))
    for k, one in enumerate(fitted):
        residuals = Residuals(gaps[:, k], category, one.variances["noise"] / files, place)
        width = _of_part(space, k, SPREAD_WIDTH, _OTHER_WIDTH)
        spread[:, k], alone[:, k] = category_spreads(
            residuals, one.variances["tire"], one.variances["tire_category"], width
        )
    own, once, noise = (
        np.array([one.variances[name] for one in fitted]) for name in ("tire", "tire_category", "noise")
    )
    linked = np.flatnonzero(shared.any(axis=1))
    apart = gaps[linked] - _means_of(gaps[linked], shared[linked])
    apart -= _means_of(apart, np.eye(categories)[category[linked]])
    apart /= np.sqrt(alone[category[linked]] + noise)
    error = once + noise * (1.0 / files).mean()
    found = Deviations(gaps, repeats, apart, own, error)
    return spread, alone, find_links(found, linked_blocks(space.slices))


def _gaps(design: Design, cells: Cells, scale: np.ndarray, fitted: tuple[Fitted, ...]) -> np.ndarray:
    """Cells less their expectation, what is the tire's own left in, (cells, p)."""
    x = np.concatenate(list(design.blocks.values()), axis=1)
    return cells.scores / scale - x @ np.stack([one.mean[: x.shape[1]] for one in fitted], axis=1)


def _means_of(values: np.ndarray, member: np.ndarray) -> np.ndarray:
    """Mean of each row's group, (n, p); ``member`` (n, groups) are indicators."""
    count = np.maximum(member.sum(axis=0), 1.0)
    return np.asarray(member @ ((member.T @ values) / count[:, None]))


def _kinds(
    design: Design, cells: Cells, space: CurveSpace, scale: np.ndarray, count: int
) -> tuple[TireKinds, np.ndarray]:
    """Find what says the kind of tire, and what is each cell's tire's own in it, (cells, q).

    The latter is known only for tires that several categories measured: elsewhere it is part of the very
    score that it would explain.
    """
    chosen = np.concatenate([np.arange(s.start, s.stop) for s in (space.slices[n] for n in KIND_PARTS)])
    told = track(chosen, "fitting what tells kinds of tires")
    fitted = [_fit_score(design, cells, space, scale, k, VARIANCE_GUESS) for k in told]
    ends = np.cumsum([block.shape[1] for block in design.blocks.values()])
    of_tire = np.concatenate(
        [np.full(block.shape[1], name in TIRE_BLOCKS) for name, block in design.blocks.items()]
    )
    weights = np.stack([one.mean[: ends[-1]][of_tire] for one in fitted], axis=1)
    own = np.stack([design.tire @ one.mean[ends[-1] :] for one in fitted], axis=1)
    return TireKinds.find(chosen, tire_regressors(design.blocks), weights, count), own
