"""Find the classes of tires by expectation maximisation, and how many there are by the evidence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from tire_pipeline.progress import track
from tire_pipeline.translation.population.classes.search_input import ClassSearchInput, per_tire
from tire_pipeline.translation.population.classes.search_starts import starts
from tire_pipeline.translation.population.classes.tire_classes import (
    TireClasses,
    fit_shares,
    log_density,
    log_shares,
)
from tire_pipeline.translation.population.mixed_effects import Design, Fitted, posterior_weights

COUNTS = (1, 2, 3, 4)
"""Numbers of classes that are tried. More of them were found on tuning fleets where there are four, and then
the groups of different categories were laid over each other wrongly; fewer do little harm."""

_MAXIMISATION_STEPS = 25
_LITTLE = 0.3  # growth of the evidence at which the climb ends
_SHARE_COST = 2.0  # parameters that a class's share counts as: slopes over the metadata are penalised
_TIRES_A_CLASS = 15  # fewer tires tell no classes
_LEAST_ROW = 0.01  # probability below which a cell is not laid out for a class
_LEAST_VARIANCE = 1e-3


def with_classes(blocks: Mapping[str, np.ndarray], coded: np.ndarray) -> dict[str, np.ndarray]:
    """Add the regressors of classes, (n, k), and of what each category does to each class."""
    organisation = blocks["category"]
    both = (organisation[:, :, None] * coded[:, None, :]).reshape(len(organisation), -1)
    return {**blocks, "class": coded, "category_class": both}


@dataclass
class ClassState:
    """Where a search for classes has come to."""

    probability: np.ndarray  # (n, k), the same for all cells of a tire
    own: np.ndarray
    variances: list[dict[str, float]]
    shares: np.ndarray
    evidence: float = -np.inf


def find_classes(question: ClassSearchInput, seed: int = 0) -> tuple[TireClasses | None, np.ndarray]:
    """Find the classes.

    Parameters
    ----------
    question : ClassSearchInput
    seed : int
        Of the starts.

    Returns
    -------
    TireClasses or None
        None if one class explains the scores as well as several.
    probability : ndarray, shape (n, k)
        Of each cell's tire.
    """
    best: ClassState | None = None
    fewer: np.ndarray | None = None
    tires = int(question.tire.max()) + 1
    for count in COUNTS:
        if count > max(1, tires // _TIRES_A_CLASS):
            break
        tried = track(list(starts(question, count, fewer, seed)), f"sorting tires into {count} classes")
        climbed = [refined_classes(question, start) for start in tried]
        found = max(climbed, key=lambda state: state.evidence)
        fewer = found.probability
        if best is None or found.evidence > best.evidence:
            best = found
        elif count > best.probability.shape[1] + 1:
            break
    assert best is not None
    count = best.probability.shape[1]
    if count == 1:
        return None, np.ones((len(question.response), 1))
    best = _laid_again(question, best)
    usual = best.probability.mean(axis=0)
    return TireClasses(question.scores, best.shares, usual, best.own), best.probability


def _laid_again(question: ClassSearchInput, state: ClassState) -> ClassState:
    """Forget, one category after the other, which tires are of which class, and climb again."""
    organisation = question.design.blocks["category"].argmax(axis=1)
    for category in track(np.unique(organisation), "sorting the tires of each organisation again"):
        own = organisation == category
        probability = state.probability.copy()
        probability[own] = np.exp(log_shares(question.metadata[own], state.shares))
        again = refined_classes(question, probability)
        if again.evidence > state.evidence + _LITTLE:
            state = again
    return state


def refined_classes(question: ClassSearchInput, probability: np.ndarray) -> ClassState:
    """Expectation maximisation from some probabilities."""
    variances = [{**v, "class": 1.0, "category_class": 0.02} for v in question.variances]
    start = np.diag([v["tire"] for v in variances])
    state = ClassState(probability, start, variances, fit_shares(question.metadata, probability))
    before = -np.inf
    for _ in range(_MAXIMISATION_STEPS):
        state = _step(question, state)
        if abs(state.evidence - before) < _LITTLE:
            break
        before = state.evidence
    return state


def _step(question: ClassSearchInput, state: ClassState) -> ClassState:
    """One maximisation of the effects and one expectation of the classes."""
    probability = state.probability
    n, count = probability.shape
    usual = probability.mean(axis=0)
    cell, kind = np.nonzero(probability > _LEAST_ROW)
    coded = np.eye(count) - usual
    design = question.design
    share = probability[cell, kind]
    laid = Design(
        with_classes({name: block[cell] for name, block in design.blocks.items()}, coded[kind]),
        _tire_in_class(design.tire[cell], kind, count, share),
        design.files[cell],
        share,
    )
    every = [with_classes(design.blocks, np.tile(code, (n, 1))) for code in coded]
    regressors = np.stack([np.concatenate(list(blocks.values()), axis=1) for blocks in every], axis=1)
    width = regressors.shape[2]
    fitted, gaps, penalty = [], [], 0.0
    for k, variances in enumerate(state.variances):
        one = posterior_weights(
            laid,
            question.response[cell, k],
            {**variances, "tire_category": question.alone[k], "noise": question.noise[k]},
        )
        fitted.append(one)
        gaps.append(question.response[:, [k]] - regressors @ one.mean[:width])
        penalty += _occam(laid, one)
    gap = per_tire(np.stack(gaps, axis=2), question.tire)
    files = question.design.files
    alone = question.alone[None, :] + question.noise[None, :] / files[:, None]
    alone = per_tire(alone, question.tire) / np.bincount(question.tire)[:, None]
    metadata = question.metadata[question.one_cell]
    logs = log_shares(metadata, state.shares) + log_density(gap, state.own, alone)
    evidence = logsumexp(logs, axis=1, keepdims=True)
    new = np.exp(logs - evidence)
    complexity = _SHARE_COST * 0.5 * np.log(len(metadata)) * (count - 1)
    own = _own_covariance(gap, new, alone, question.linked)
    updated = _updated(laid, fitted, own, question.noise)
    return ClassState(
        new[question.tire],
        own,
        updated,
        fit_shares(metadata, new, state.shares, steps=8),
        float(evidence.sum() + penalty - complexity),
    )


def _tire_in_class(tire: np.ndarray, kind: np.ndarray, count: int, share: np.ndarray) -> np.ndarray:
    """Return columns of a tire's own effect, another for each class that it may be of, (rows, tires * k).

    One effect for all of them would have to explain the difference between the classes, and as a tire that
    several categories measured leaves little noise, it would draw the classes together. A row counts by its
    share, and so must the effect's prior: hence the root.
    """
    own = np.eye(count)[kind] / np.sqrt(share)[:, None]
    return (tire[:, :, None] * own[:, None, :]).reshape(len(tire), -1)


def _occam(design: Design, fitted: Fitted) -> float:
    """What the weights of the effects cost: logarithm of their prior times their posterior's volume."""
    prior = np.concatenate([np.full(b.shape[1], fitted.variances[n]) for n, b in design.blocks.items()])
    own = slice(0, prior.size)
    volume = np.linalg.slogdet(fitted.covariance[own, own])[1]
    return float(0.5 * (volume - np.log(prior).sum() - (fitted.mean[own] ** 2 / prior).sum()))


def _own_covariance(
    gap: np.ndarray, probability: np.ndarray, alone: np.ndarray, linked: np.ndarray
) -> np.ndarray:
    total = np.einsum("nk,nka,nkb->ab", probability, gap, gap) / len(gap) - np.diag(alone.mean(axis=0))
    values, axes = np.linalg.eigh(total * linked)
    return np.asarray((axes * np.maximum(values, _LEAST_VARIANCE)) @ axes.T)


def _updated(
    design: Design, fitted: list[Fitted], own: np.ndarray, noise: np.ndarray
) -> list[dict[str, float]]:
    """Variances of the effects; what a category does to a class is pooled over the scores."""
    squares: list[dict[str, float]] = []
    for one in fitted:
        square = one.mean**2 + np.diag(one.covariance)
        start, found = 0, {}
        for name, block in design.blocks.items():
            stop = start + block.shape[1]
            found[name] = max(float(square[start:stop].mean()), 1e-6)
            start = stop
        squares.append(found)
    common = float(np.mean([s["category_class"] / v for s, v in zip(squares, noise, strict=True)]))
    return [
        {
            **found,
            "level": one.variances["level"],
            "category_class": common * float(v),
            "tire": max(float(own[k, k]), 1e-4),
        }
        for k, (found, one, v) in enumerate(zip(squares, fitted, noise, strict=True))
    ]
