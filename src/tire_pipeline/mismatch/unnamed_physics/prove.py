"""The proof of an equation: sweeps that neither its choice nor its fit has seen.

The folds interleave sweeps. For each fold the whole choice (screen, products, sets) is repeated without it,
and the equation so found predicts it, in newtons, as it will be used: without the formula's misfit beside it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from tire_pipeline.mismatch.model.channels import CHANCE, DOES_NOTHING
from tire_pipeline.mismatch.proof.nested import FOLDS
from tire_pipeline.mismatch.unnamed_physics.choose import ChosenModels, choose
from tire_pipeline.mismatch.unnamed_physics.evidence import MOST_TERMS, coefficients
from tire_pipeline.mismatch.unnamed_physics.library import WAY, Term
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import Unexplained
from tire_pipeline.mismatch.unnamed_physics.products import Columns

Array = np.ndarray
_LEAST_GONE = 0.03
"""Least share of the squared mismatch that has to go on unseen sweeps."""
_LEVEL_OF_PROOF = CHANCE / (3 * MOST_TERMS)
"""Of the test over sweeps, of which a force has nine: two views of all forces and one of it alone, each with
one term, two and three."""
_SIGNS_DRAWN = round(CHANCE**-3)
"""Of signs: with so many a chance at the level of proof is known to a fifth of itself."""
_NEAR_MOST = 1.0 - CHANCE


@dataclass(frozen=True)
class Proven:
    """The predictions, in each fold, of equations chosen without it.

    Parameters
    ----------
    predicted : mapping of ndarray, shape (n,)
        Output -> what they add, N, each sample by the equation that has not seen it.
    choices : int
        Folds in which an equation was chosen at all.
    better, sweeps : int
    p_value : float
        Chance of a gain as large where there is none: of the force that is least sure.
    share : float
        Of the squared mismatch that goes, mean of the outputs that become better.
    outputs : tuple of str
        Those that surely become better.
    """

    predicted: Mapping[str, Array]
    choices: int
    better: int
    sweeps: int
    p_value: float
    share: float
    outputs: tuple[str, ...]

    @property
    def added(self) -> dict[str, Array]:
        """What is added to the forces that surely become better, N."""
        return {o: self.predicted[o] for o in self.outputs} if self.holds else {}

    @property
    def holds(self) -> bool:
        """Whether the equation is kept."""
        return bool(self.outputs and self.choices > FOLDS // 2)


def proven(columns: Columns) -> list[Proven]:
    """Choose without each fold in turn, and predict it: with one term, with two at most, with three."""
    problem = columns.problem
    predicted = [{o: np.zeros(problem.table.size) for o in problem.outputs} for _ in range(MOST_TERMS)]
    choices, of_all = [0] * MOST_TERMS, [True] * MOST_TERMS
    for fold in range(FOLDS):
        choice = choose(columns, np.arange(FOLDS) != fold, refine=False)
        rows = columns.folds == fold
        for k in range(MOST_TERMS):
            model = choice.best(k + 1)
            if model is None:
                continue
            choices[k] += 1
            of_all[k] &= all(set(WAY[choice.terms[i].way].base) >= set(predicted[k]) for i in model.terms)
            for o, force in forces_of(columns, choice, model.terms).items():
                predicted[k][o][rows] = force[rows]
    return [judged(columns, *each) for each in zip(predicted, choices, of_all, strict=True)]


def best_of(proofs: Sequence[Proven]) -> int:
    """Return which choice to keep: the first that comes near the most that goes unseen.

    This one choice, of six (two views, up to three terms), does see the sweeps; the level of the test counts
    it.
    """
    shares = [p.share if p.holds else 0.0 for p in proofs]
    return next(k for k, share in enumerate(shares) if share >= _NEAR_MOST * max(shares))


def judged(columns: Columns, predicted: Mapping[str, Array], choices: int, of_all: bool = False) -> Proven:
    """Compare the errors with and without what was predicted, force by force and sweep by sweep.

    Where each term acts on all forces (``of_all``) by one coefficient, nothing is free any more once one
    force is sure: the others are tested once, and not as one of nine.
    """
    problem = columns.problem
    sweeps = int(problem.block.max()) + 1
    gain, gone, chance = {}, {}, {}
    for o in (o for o in problem.outputs if np.any(predicted[o])):
        before, after = problem.rest[o], problem.rest[o] - predicted[o]
        size = max(float(np.mean(before**2)), 1e-300)
        gain[o] = np.bincount(problem.block, (before**2 - after**2) / size, sweeps)
        gone[o] = 1.0 - float(np.mean(after**2)) / size
        chance[o] = chance_of_no_gain(gain[o])
    enough = [o for o in gain if gone[o] >= _LEAST_GONE]
    sure = any(chance[o] < _LEVEL_OF_PROOF for o in enough)
    level = CHANCE if of_all and sure else _LEVEL_OF_PROOF
    good = tuple(o for o in enough if chance[o] < level)
    if not good:
        return Proven(predicted, choices, 0, sweeps, min(chance.values(), default=1.0), 0.0, ())
    better = int(np.sum(sum(gain[o] for o in good) > 0.0))
    share = float(np.mean([gone[o] for o in good]))
    return Proven(predicted, choices, better, sweeps, max(chance[o] for o in good), share, good)


def surely_less(problem: Unexplained, before: Mapping[str, Array], after: Mapping[str, Array]) -> bool:
    """Whether all forces together surely have a smaller error on sweeps that are predicted without them.

    Surely: the mean gain of a sweep is above zero by a test over the sweeps. A gain that a few
    sweeps make and others lose is no gain elsewhere. And the gain is as large a part of the squared mismatch
    as an equation has to remove at all: what says the same in another form differs surely, but by little.

    Parameters
    ----------
    problem : Unexplained
    before, after : mapping of ndarray, shape (n,)
        Output -> residual, N. Each force counts over its largest.
    """

    def squared(left: Mapping[str, Array]) -> Array:
        return np.sum([(left[o] / problem.largest[o]) ** 2 for o in after], axis=0)

    gain = squared(before) - squared(after)
    enough = gain.mean() >= _LEAST_GONE * squared(problem.rest).mean()
    return bool(enough) and chance_of_no_gain(np.bincount(problem.block, gain)) < CHANCE


def chance_of_no_gain(gain: Array) -> float:
    """Return the chance of a mean gain as large where there is none.

    Where an equation does nothing, each sweep is as likely to become worse as better: the chance is the share
    of all signs of the gains whose sum is as large (Fisher's randomisation test, *The Design of Experiments*,
    1935). A few sweeps with large gains do not hide that nearly all of them gain. Too few sweeps have too few
    signs; there a one-sided t test serves.

    Parameters
    ----------
    gain : ndarray, shape (sweeps,)
        What goes of the squared error, sweep by sweep; one sweep alone proves nothing.
    """
    if gain.size < 2:
        return 1.0
    if 2.0**-gain.size > _LEVEL_OF_PROOF:
        return _chance_by_t(gain)
    signs = np.random.default_rng(0).choice((-1.0, 1.0), (_SIGNS_DRAWN, gain.size))
    as_large = signs @ gain >= gain.sum() - np.finfo(float).eps * np.abs(gain).sum() * gain.size
    return float((1 + as_large.sum()) / (1 + _SIGNS_DRAWN))


def _chance_by_t(gain: Array) -> float:
    error = float(gain.std(ddof=1)) / np.sqrt(gain.size)
    if error == 0.0:
        return 0.0 if gain.mean() > 0.0 else 1.0
    return float(scipy.special.stdtr(gain.size - 1, -gain.mean() / error))


def forces_of(columns: Columns, choice: ChosenModels, terms: tuple[int, ...]) -> dict[str, Array]:
    """Return what a set of terms adds, N, with its fitted coefficients."""
    values = fitted(choice, terms)[0]
    out = {o: np.zeros(columns.problem.table.size) for o in columns.problem.outputs}
    for i, value in zip(terms, values, strict=True):
        column = columns.of(choice.terms[i])
        assert column is not None  # it has sums
        for o in out:
            out[o] = out[o] + value * column[o]
    return out


def fitted(choice: ChosenModels, terms: tuple[int, ...]) -> tuple[Array, Array]:
    """Coefficients of a set of terms and their standard errors."""
    mean, covariance = coefficients(choice.reduced, terms)
    size = choice.sums.size[list(terms)]
    return mean / size, np.sqrt(np.maximum(np.diag(covariance), 0.0)) / size


def ceiling(columns: Columns, way_terms: list[Term]) -> dict[str, Array]:
    """Predict each fold by a Gaussian process in the same drivers from the other folds, N.

    Squared-exponential over the factors of the equation's terms, each over its spread, times what the terms
    multiply; 60 inducing points (Nystrom), ridge of the noise. What no equation in these drivers can exceed
    by much.
    """
    problem = columns.problem
    out = {o: np.zeros(problem.table.size) for o in problem.outputs}
    inputs = [columns.part(f.written) for t in way_terms for f in t.factors]
    live = [x for x in inputs if x is not None and np.std(x) > 0.0]
    if not (live or any(not t.factors for t in way_terms)):
        return out
    x = np.column_stack([np.zeros(problem.table.size), *((c - c.mean()) / c.std() for c in live)])
    rng = np.random.default_rng(0)
    centres = x[rng.choice(len(x), min(60, len(x)), replace=False)]
    near = np.exp(-0.5 * ((x[:, None, :] - centres[None]) ** 2).sum(axis=2))
    near = np.column_stack([near, np.ones(len(x))])
    for o in out:
        bases = [columns.part(_base(t, o)) for t in way_terms[:1] if _base(t, o)]
        if not bases or bases[0] is None:
            continue
        design = near * bases[0][:, None]
        design = design / max(float(np.sqrt(np.mean(design**2))), 1e-12)
        for fold in range(FOLDS):
            seen = columns.folds != fold
            a = design[seen].T @ design[seen] + DOES_NOTHING * seen.sum() * np.eye(design.shape[1])
            c = np.linalg.solve(a, design[seen].T @ problem.rest[o][seen])
            out[o][~seen] = design[~seen] @ c
    return out


def _base(term: Term, output: str) -> str:
    return WAY[term.way].base.get(output, "")
