"""Choosing an equation: screen terms of one factor, multiply and refine the best, enumerate sets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from tire_pipeline.mismatch.proof.nested import FOLDS
from tire_pipeline.mismatch.unnamed_physics.evidence import (
    MOST_TERMS,
    Model,
    costs,
    enumerate_models,
    gains,
    shortest,
)
from tire_pipeline.mismatch.unnamed_physics.library import (
    Term,
    now_factors,
    path_factors,
    products,
    single_terms,
)
from tire_pipeline.mismatch.unnamed_physics.products import Columns, Products, Reduced

Array = np.ndarray
EVERYTHING = np.ones(FOLDS, bool)
BREADTH = 8
"""How many of the best go on: terms that are multiplied by a second factor, and of those by a third one,
terms whose numbers are refined, and pairs to which a third term is added."""
_SUMMED_TERMS = 90
"""Terms of which all sums are kept."""
_STEPS_OF_NUMBERS = (1.8, 1.35, 1.15)
"""Factors by which a number of a term is moved up or down, one after the other, between values of the grid,
of which each is about three times the one before."""
_RADII = (0.1, 2.5)
"""Radii of what may roll along, m."""

Ranked = list[tuple[float, Term]]


@dataclass(frozen=True)
class ChosenModels:
    """Terms that were looked at in full, and the models made of them.

    Parameters
    ----------
    terms : list of Term
    sums : Products
    reduced : list of Reduced
        Of the folds that were looked at.
    models : list of Model
        The likeliest first.
    """

    terms: list[Term]
    sums: Products
    reduced: list[Reduced]
    models: list[Model]

    def best(self, most_terms: int = MOST_TERMS) -> Model | None:
        """The model to name, of so many terms at most."""
        return shortest(self.models, self.terms, most_terms)


def choose(columns: Columns, kept: Array = EVERYTHING, *, refine: bool = True) -> ChosenModels:
    """Look for an equation of the residual.

    Parameters
    ----------
    columns : Columns
    kept : ndarray of bool, shape (folds,)
        Folds that may be looked at.
    refine : bool
        Whether numbers may move between those of the grid.
    """
    problem = columns.problem
    time = problem.table.columns.get("t", np.zeros(1))
    span = (float(time[0]), float(time[-1])) if time[-1] > time[0] else (0.0, 1.0)
    first = single_terms(problem.moves, problem.outputs, span) + _rolling(columns, kept)
    ranked = _screened(columns, first, problem.inflation, kept)
    inflation = _inflation_beside_the_best(columns, ranked)
    found = [ranked]
    factors = now_factors(problem.moves)
    for _ in range(2):
        grown = products(_distinct(found[-1])[:BREADTH], factors)
        found.append(_screened(columns, grown, inflation, kept))
    terms = _best_of(found, _SUMMED_TERMS)
    if refine:
        terms = list(dict.fromkeys([*_refined(columns, terms, inflation, kept), *terms]))
    terms, sums = columns.products(terms)
    reduced = columns.reduced(sums, inflation, kept)
    return ChosenModels(terms, sums, reduced, enumerate_models(terms, reduced, BREADTH))


def _screened(columns: Columns, terms: Sequence[Term], inflation: float, kept: Array) -> Ranked:
    """Rank single terms by their evidence."""
    live, reduced = columns.screened(terms, inflation, kept)
    if not live:
        return []
    score = gains(reduced, np.arange(len(live))[:, None])
    score = score - costs(live, len(live), np.arange(len(live))[:, None])
    return [(float(score[i]), live[i]) for i in np.argsort(-score)]


def _inflation_beside_the_best(columns: Columns, ranked: Ranked) -> float:
    """The inflation of what the best terms leave: what is unexplained must not pass for coloured noise."""
    problem = columns.problem
    if problem.settled:
        return problem.inflation
    best = _distinct(ranked)[:BREADTH]
    return min(problem.inflation, columns.inflation_beside(best)) if best else problem.inflation


def _distinct(ranked: Ranked) -> list[Term]:
    """The best terms, at most two of each set of drivers and way."""
    seen: dict[tuple[str, frozenset[str]], int] = {}
    out = []
    for _, term in ranked:
        key = (term.way, term.drivers)
        seen[key] = seen.get(key, 0) + 1
        if seen[key] <= 2:
            out.append(term)
    return out


def _best_of(found: Sequence[Ranked], most: int) -> list[Term]:
    ranked = sorted((pair for part in found for pair in part), key=lambda pair: -pair[0])
    best = [t for _, t in ranked[: most // 2]]
    already = set(best)
    others = _distinct([pair for pair in ranked if pair[1] not in already])
    return [*best, *others[: most - len(best)]]


def _refined(columns: Columns, terms: Sequence[Term], inflation: float, kept: Array) -> list[Term]:
    """Move the numbers in the best terms with a memory between those of the grid."""
    out: list[Term] = []
    with_number = [t for t in terms if any("{}" in f.text and f.kind == "memory" for f in t.factors)]
    for begun in with_number[:BREADTH]:
        term = begun
        for step in _STEPS_OF_NUMBERS:
            trials = [_moved(term, power) for power in (1.0 / step, 1.0, step)]
            ranked = _screened(columns, trials, inflation, kept)
            if ranked:
                term = ranked[0][1]
        if term != begun:
            out.append(term)
    return out


def _moved(term: Term, power: float) -> Term:
    factors = tuple(
        f.at(f.value * power) if "{}" in f.text and f.kind == "memory" else f for f in term.factors
    )
    return Term(term.way, factors)


def _rolling(columns: Columns, kept: Array) -> list[Term]:
    """Terms that repeat along the road, at the radius at which most power is."""
    p = columns.problem
    way = p.table.columns.get("way")
    if (
        way is None
        or way[-1] - way[0] < 2.0 * np.pi * _RADII[1]
        or "slip_angle" not in p.moves | {"slip_ratio"}
    ):
        return []
    seen = kept[columns.folds]
    out: list[Term] = []
    for base, output, names in (
        ("fy", "fy", ("fy", "force")),
        ("fy_slip", "fy", ("slip angle",)),
        ("fx", "fx", ("fx", "force")),
    ):
        part = columns.part(base)
        if output not in p.outputs or part is None or not part.any():
            continue
        signal = p.rest[output] * part * seen
        radius = _strongest_radius(signal - seen * float(np.mean(signal[seen])), way)
        if radius is None:
            continue
        live = [n for n in names if n != "force" or len(p.outputs) > 1]
        out += [Term(name, (factor,)) for name in live for factor in path_factors(radius)]
    return out


def _strongest_radius(signal: Array, way: Array) -> float | None:
    """Radius (m) at whose turns a signal has most power: on an even grid of the way, then nearby.

    None if the samples are too far apart for any of the turns.
    """
    span, count = float(way[-1] - way[0]), way.size
    even = np.interp(np.linspace(way[0], way[-1], count), way, signal)
    power = np.abs(np.fft.rfft(even, 2 * count))
    rates = np.arange(power.size) * np.pi * (count - 1) / (span * count)
    inside = (rates > 1.0 / _RADII[1]) & (rates < 1.0 / _RADII[0])
    if not inside.any():
        return None
    best, width = float(rates[inside][int(np.argmax(power[inside]))]), float(rates[1])
    near = scipy.optimize.minimize_scalar(
        lambda rate: -abs(signal @ np.exp(1j * rate * way)), bounds=(best - width, best + width)
    )
    return 1.0 / float(near.x)


__all__ = ["EVERYTHING", "ChosenModels", "choose"]
