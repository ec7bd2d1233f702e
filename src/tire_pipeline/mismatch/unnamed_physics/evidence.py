"""Evidence of sets of terms, in closed form, and the posterior of what they depend on."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from tire_pipeline.mismatch.discrepancy.form_error import USUAL_FORM_ERROR
from tire_pipeline.mismatch.unnamed_physics.library import Term
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import PRIOR_SIZE
from tire_pipeline.mismatch.unnamed_physics.products import Reduced, definite

Array = np.ndarray
EACH_DRIVER = 2.0
"""Log evidence that a driver costs."""
MOST_TERMS = 3


@dataclass(frozen=True)
class Model:
    """A set of terms and its log evidence over that of no term, prior included."""

    terms: tuple[int, ...]
    evidence: float
    score: float


def costs(terms: Sequence[Term], library: int, sets: Array) -> Array:
    """Minus log prior of sets: which terms of the library, how long, how many drivers; shape (sets,).

    Parameters
    ----------
    terms : sequence of Term
    library : int
        Terms to choose from.
    sets : ndarray of int, shape (sets, k)
        Numbers of terms.
    """
    number = {d: k for k, d in enumerate(sorted(frozenset[str]().union(*(t.drivers for t in terms))))}
    has = np.zeros((len(terms), len(number)), bool)
    for i, term in enumerate(terms):
        has[i, [number[d] for d in term.drivers]] = True
    each = np.array([t.cost for t in terms])[sets].sum(axis=1)
    drivers = np.any(has[sets], axis=1).sum(axis=1)
    return each + sets.shape[1] * math.log(max(library, 2)) + EACH_DRIVER * drivers


def gains(reduced: Sequence[Reduced], sets: Array) -> Array:
    """Log evidence of sets of terms over that of none, shape (sets,).

    Parameters
    ----------
    reduced : sequence of Reduced
    sets : ndarray of int, shape (sets, k)
    """
    k = sets.shape[1]
    if k == 1 and reduced and reduced[0].information.ndim == 1:
        return _single_gains(reduced)[sets[:, 0]]
    out = np.full(len(sets), -np.inf)
    for r in reduced:
        a = definite(r.information[sets[:, :, None], sets[:, None, :]], PRIOR_SIZE**-2)
        b = r.score[sets]
        x = np.linalg.solve(a, b[:, :, None])[:, :, 0]
        _, determinant = np.linalg.slogdet(a)
        gain = 0.5 * np.einsum("ij,ij->i", b, x) - 0.5 * determinant - k * np.log(PRIOR_SIZE)
        out = np.logaddexp(out, r.log_weight + gain)
    return out


def _single_gains(reduced: Sequence[Reduced]) -> Array:
    """The same of terms that were looked at one by one, shape (m,)."""
    out: Array = np.full(reduced[0].score.size, -np.inf)
    for r in reduced:
        a = np.maximum(r.information, 0.0) + 1.0 / PRIOR_SIZE**2
        gain = 0.5 * r.score**2 / a - 0.5 * np.log(a) - np.log(PRIOR_SIZE)
        out = np.logaddexp(out, r.log_weight + gain)
    return out


def coefficients(reduced: Sequence[Reduced], terms: Sequence[int]) -> tuple[Array, Array]:
    """Posterior mean and covariance of a set's coefficients at the likeliest size of the misfit."""
    i = np.asarray(terms, int)
    best, found = -np.inf, (np.zeros(i.size), np.zeros((i.size, i.size)))
    for r in reduced:
        a = definite(r.information[np.ix_(i, i)], PRIOR_SIZE**-2)
        mean = np.linalg.solve(a, r.score[i])
        weight = r.log_weight + 0.5 * float(r.score[i] @ mean) - 0.5 * float(np.linalg.slogdet(a)[1])
        if weight > best:
            best, found = weight, (mean, np.linalg.inv(a))
    return found


def enumerate_models(terms: Sequence[Term], reduced: Sequence[Reduced], triples_of: int) -> list[Model]:
    """Return single terms, pairs and triples, the likeliest first.

    All singles, all pairs, and the likeliest pairs with each third term.

    Parameters
    ----------
    terms : sequence of Term
    reduced : sequence of Reduced
    triples_of : int
        Pairs to which a third term is added.
    """
    singles = np.arange(len(terms))[:, None]
    models = _judged(terms, reduced, singles)
    best = [m.terms[0] for m in models]
    pairs = np.array(list(combinations(best, 2)), int).reshape(-1, 2)
    models += _judged(terms, reduced, pairs) if len(pairs) else []
    two = sorted((m for m in models if len(m.terms) == 2), key=lambda m: -m.score)[:triples_of]
    three = {tuple(sorted((*m.terms, j))) for m in two for j in best if j not in m.terms}
    triples = np.array(sorted(three), int).reshape(-1, 3)
    models += _judged(terms, reduced, triples) if len(triples) else []
    return sorted(models, key=lambda m: -m.score)


def _judged(terms: Sequence[Term], reduced: Sequence[Reduced], sets: Array) -> list[Model]:
    found = gains(reduced, sets)
    score = found - costs(terms, len(terms), sets)
    models = [
        Model(tuple(row), g, s)
        for row, g, s in zip(sets.tolist(), found.tolist(), score.tolist(), strict=True)
    ]
    return sorted((m for m in models if math.isfinite(m.evidence)), key=lambda m: -m.score)


def tolerance(models: Sequence[Model]) -> float:
    """Log evidence by which models have to differ to be told apart: forms are never quite right.

    Differences below the square of their usual error, of all the evidence, say nothing.
    """
    most = max((m.evidence for m in models), default=0.0)
    return max(1.0, USUAL_FORM_ERROR**2 * most)


def shortest(models: Sequence[Model], terms: Sequence[Term], most_terms: int = MOST_TERMS) -> Model | None:
    """Return the model to name: fewer terms, then fewer drivers, if as good within tolerance.

    Parameters
    ----------
    models : sequence of Model
        The likeliest first.
    terms : sequence of Term
    most_terms : int
        Models of more terms are left out.
    """
    able = [m for m in models if len(m.terms) <= most_terms and m.score > 0.0]
    if not able:
        return None
    most, near = able[0], tolerance(able)
    worth = near * (0.5 * (len(most.terms) - 1) + len(drivers_of(most, terms)))
    able = [m for m in able if most.score - m.score <= worth]  # no shortness is worth more

    def price(m: Model) -> float:
        """What it lacks, less what its shortness is worth: forms are never quite right."""
        terms_less = len(most.terms) - len(m.terms)
        drivers_less = len(drivers_of(most, terms)) - len(drivers_of(m, terms))
        return most.score - m.score - near * (0.5 * terms_less + drivers_less)

    return min(able, key=price)


def drivers_of(model: Model, terms: Sequence[Term]) -> frozenset[str]:
    """What a model depends on."""
    return frozenset[str]().union(*(terms[i].drivers for i in model.terms))


def driver_posterior(
    models: Sequence[Model], drivers: Sequence[frozenset[str]]
) -> dict[frozenset[str], float]:
    """Return the posterior of the sets of drivers, the likeliest first.

    Tempered by the tolerance: of the forms in the library none is quite right.

    Parameters
    ----------
    models : sequence of Model
        The likeliest first.
    drivers : sequence of frozenset of str
        Of each term.
    """
    if not models:
        return {}
    heat = tolerance(models)
    most = models[0].score
    mass: dict[frozenset[str], float] = defaultdict(float)
    for m in models:
        weight = np.exp((m.score - most) / heat)
        key = frozenset[str]().union(*(drivers[i] for i in m.terms))
        mass[key] = max(mass[key], float(weight))
    nothing = float(np.exp(-most / heat))
    total = sum(mass.values()) + nothing
    return {k: w / total for k, w in sorted(mass.items(), key=lambda item: -item[1])}
