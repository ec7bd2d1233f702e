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
from tire_pipeline.translation.population.fit_scores import (
    CLASS_PARTS,
    VARIANCE_GUESS,
    fit_score,
    fit_scores,
    makes_differ,
    of_part,
)
from tire_pipeline.translation.population.fit_space import Cells, fit_curve_space
from tire_pipeline.translation.population.kinds import TIRE_BLOCKS, TireKinds, tire_regressors, with_kinds
from tire_pipeline.translation.population.metadata import Metadata
from tire_pipeline.translation.population.mixed_effects import Design, Fitted
from tire_pipeline.translation.population.model import (
    POPULATION,
    CurveMixedModel,
    design_blocks,
    members,
)
from tire_pipeline.translation.population.protocols.of_files import NO_PROTOCOL_CHANGE, Protocols, days_of
from tire_pipeline.translation.population.protocols.search import Dated, find_changes

SPREAD_WIDTH = {"stiffness": 0.02}
"""How far categories may differ in how they spread what is a tire's own, by part: standard deviation of a
logarithm. A fit draws shapes as it likes; what a rig does to a stiff tire more than to a soft one is what its
kind tells (:mod:`.kinds`), and a few dozen tires tell a spread to 10% only."""

_OTHER_WIDTH = 0.2

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
    fitted = fit_scores(made.design, made.cells, made.space, made.scale)
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
    design = Design(blocks, tires, cells.files)
    if tires.shape[1] >= FEWEST_SHARED:  # fewer do not tell what a supplier measures from what it makes
        alone = members(category, categories) * (tires.sum(axis=1) == 0)[:, None]
        apart = Design({**blocks, POPULATION: alone}, tires, cells.files)
        design = apart if makes_differ(apart, cells, space, scale) else design
        blocks = design.blocks
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
        one = fit_score(made.design, made.cells, made.space, made.scale, k, VARIANCE_GUESS)
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
        fit_score(plain, cells, space, scale, k, VARIANCE_GUESS, alone_known=True)
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
        width = of_part(space, k, SPREAD_WIDTH, _OTHER_WIDTH)
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
    fitted = [fit_score(design, cells, space, scale, k, VARIANCE_GUESS) for k in told]
    ends = np.cumsum([block.shape[1] for block in design.blocks.values()])
    of_tire = np.concatenate(
        [np.full(block.shape[1], name in TIRE_BLOCKS) for name, block in design.blocks.items()]
    )
    weights = np.stack([one.mean[: ends[-1]][of_tire] for one in fitted], axis=1)
    own = np.stack([design.tire @ one.mean[ends[-1] :] for one in fitted], axis=1)
    return TireKinds.find(chosen, tire_regressors(design.blocks), weights, count), own
