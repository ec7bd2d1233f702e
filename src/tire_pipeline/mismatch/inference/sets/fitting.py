"""Fit one set of effects with its physical priors (damped Gauss-Newton)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.evidence.likelihood import ColumnProducts, Likelihood, Weights
from tire_pipeline.mismatch.inference.evidence.products import OfSet, RecordingProducts
from tire_pipeline.mismatch.inference.linearised_set import columns_of, moved
from tire_pipeline.mismatch.inference.priors import Labels, prior
from tire_pipeline.mismatch.inference.tails import cost, widening
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
_DAMPINGS = (0.0, 1.0, 3.0)
"""A whole step, about half of it, about a quarter."""


def fitted(products: RecordingProducts, likelihood: Likelihood, variants: Sequence[Variant]) -> OfSet:
    """Find the likeliest parameters of a set and return its products.

    Parameters
    ----------
    products : RecordingProducts
    likelihood : Likelihood
    variants : sequence of Variant
        The effects, each where the fit begins. It ends where a step changes the odds by next to nothing.
    """
    changes: list[Change] = [(v.name, dict(v.start)) for v in variants]
    free = [tuple(v.free) for v in variants]
    smooth = [tuple(p for p in v.free if p not in v.effect.scanned) for v in variants]
    changes, gain, near = _step(products, likelihood, changes, smooth)
    changes, more = _scan(products, near, changes, smooth)
    gain += more
    while gain >= CHANCE:
        changes, gain, _ = _step(products, likelihood, changes, smooth)
    return products.of_set(changes, free)


def _cost(
    products: RecordingProducts,
    likelihood: Likelihood,
    changes: Sequence[Change],
    free: Sequence[tuple[str, ...]],
) -> float:
    """Negative log posterior of the parameters, summed over the sizes of misfit and error."""
    rest = residual(products.data, changes)
    found = likelihood.evidence(products.of({o: r[:, None] for o, r in rest.items()}), np.zeros(0))
    off, wide = _learnt_prior(products.data, likelihood, changes, _moving(changes, free))
    return -found.value + float(np.sum(cost(off / wide)))


def _learnt_prior(
    data: Data, likelihood: Likelihood, changes: Sequence[Change], labels: Labels
) -> tuple[Array, Array]:
    """As :func:`prior`, with the learnt width."""
    off, wide = prior(data, changes, labels)
    return off, wide * likelihood.learnt.prior


def _moving(changes: Sequence[Change], free: Sequence[tuple[str, ...]]) -> Labels:
    return [
        (i, p.name)
        for i, ((name, _), names) in enumerate(zip(changes, free, strict=True))
        for p in catalogue()[name].parameters
        if p.name in names
    ]


def _step(
    products: RecordingProducts,
    likelihood: Likelihood,
    changes: list[Change],
    free: Sequence[tuple[str, ...]],
) -> tuple[list[Change], float, Likelihood]:
    """Make one step, damped until it helps; return its gain, and the likelihood near it, too.

    Near a step the sizes of misfit and error stay where they are likeliest: trials then take a twelfth of the
    time.
    """
    data = products.data
    labels, columns = columns_of(data, changes, list(free))
    off, wide = _learnt_prior(data, likelihood, changes, labels)
    rest = residual(data, changes)
    here = products.of({o: np.column_stack([columns[o] * wide, r]) for o, r in rest.items()})
    found = likelihood.evidence(here, np.ones(wide.size))
    near = likelihood.at(found.weights)
    if not labels:
        return changes, 0.0, near
    best = _cost(products, near, changes, free)
    inner, aim = _normal_equations(found.weights, here, wide.size)
    tails = 1.0 / widening(off / wide) ** 2
    inner, aim = inner + np.diag(tails), aim - tails * off / wide
    for damping in _DAMPINGS:
        delta = np.linalg.solve(inner + damping * np.diag(np.diag(inner)), aim) * wide
        trial = moved(changes, labels, delta)
        tried = _cost(products, near, trial, free)
        if tried < best:
            return trial, best - tried, near
    return changes, 0.0, near


def _scan(
    products: RecordingProducts,
    likelihood: Likelihood,
    changes: list[Change],
    free: Sequence[tuple[str, ...]],
) -> tuple[list[Change], float]:
    """Move by trial the moments at which the force jumps: the derivative with respect to one is a spike."""
    time = products.data.time
    moments = [(i, m) for i, (name, _) in enumerate(changes) for m in catalogue()[name].stepped]
    if not moments:
        return changes, 0.0
    assert time is not None  # the effect needs a time line
    first = best = _cost(products, likelihood, changes, free)
    for i, moment in moments:
        begun_from = {float(start[moment]) for start in catalogue()[changes[i][0]].starts(products.data)}
        width = 0.5 * float(np.min(np.diff(sorted(begun_from))))
        while width > products.data.sampling:
            for sign in (1.0, -1.0):
                trial: list[Change] = [(n, dict(p)) for n, p in changes]
                there = float(np.clip(changes[i][1][moment] + sign * width, time[0], time[-1]))
                trial[i] = (changes[i][0], {**changes[i][1], moment: there})
                tried = _cost(products, likelihood, trial, free)
                if tried < best:
                    changes, best = trial, tried
                    break
            width *= 0.5
    return changes, first - best


def _normal_equations(
    weights: Mapping[str, Weights], products: ColumnProducts, count: int
) -> tuple[Array, Array]:
    inner, aim = np.zeros((count, count)), np.zeros(count)
    for o, each in weights.items():
        reduced = each.reduced(products.own[o], products.nuisance[o])
        inner += reduced[:-1, :-1]
        aim += reduced[:-1, -1]
    return inner, aim
