"""The objective of a fit: the negative log posterior of the parameters of a set."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood, Weights
from tire_pipeline.mismatch.inference.evidence.products import RecordingProducts
from tire_pipeline.mismatch.inference.linearised_set import columns_of
from tire_pipeline.mismatch.inference.priors import Labels, prior
from tire_pipeline.mismatch.inference.tails import cost
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray


def negative_log_posterior(
    products: RecordingProducts,
    likelihood: Likelihood,
    changes: Sequence[Change],
    free: Sequence[tuple[str, ...]],
) -> float:
    """Return it for the parameters that float, summed over the sizes of misfit and error."""
    rest = residual(products.data, changes)
    found = likelihood.evidence(products.of({o: r[:, None] for o, r in rest.items()}), np.zeros(0))
    off, wide = learnt_prior(products.data, likelihood, changes, _moving(changes, free))
    return -found.value + float(np.sum(cost(off / wide)))


def learnt_prior(
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


@dataclass(frozen=True)
class NormalEquations:
    """A set linearised in the parameters that float, each over the spread of its prior.

    Parameters
    ----------
    labels : sequence of (index of effect, parameter)
    off, wide : ndarray, shape (k,)
        Of :func:`learnt_prior`.
    weights : mapping of Weights
        Output -> weights of its samples, at the likeliest sizes of misfit and error.
    inner : ndarray, shape (k, k)
    aim : ndarray, shape (k,)
        Without the prior.
    """

    labels: Labels
    off: Array
    wide: Array
    weights: Mapping[str, Weights]
    inner: Array
    aim: Array


def normal_equations(
    products: RecordingProducts,
    likelihood: Likelihood,
    changes: Sequence[Change],
    free: Sequence[tuple[str, ...]],
) -> NormalEquations:
    """Return the normal equations of a set at its parameters."""
    data = products.data
    labels, columns = columns_of(data, list(changes), list(free))
    off, wide = learnt_prior(data, likelihood, changes, labels)
    rest = residual(data, changes)
    here = products.of({o: np.column_stack([columns[o] * wide, r]) for o, r in rest.items()})
    weights = likelihood.evidence(here, np.ones(wide.size)).weights
    inner, aim = np.zeros((wide.size, wide.size)), np.zeros(wide.size)
    for o, each in weights.items():
        reduced = each.reduced(here.own[o], here.nuisance[o])
        inner += reduced[:-1, :-1]
        aim += reduced[:-1, -1]
    return NormalEquations(labels, off, wide, weights, inner, aim)
