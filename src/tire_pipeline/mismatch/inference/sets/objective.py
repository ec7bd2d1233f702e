"""What a fit makes small: the negative log posterior of the parameters of a set."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.evidence.likelihood import ColumnProducts, Likelihood, Weights
from tire_pipeline.mismatch.inference.evidence.products import RecordingProducts
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


def normal_equations(
    weights: Mapping[str, Weights], products: ColumnProducts, count: int
) -> tuple[Array, Array]:
    """Return the normal matrix, shape (count, count), and the right-hand side of the first columns."""
    inner, aim = np.zeros((count, count)), np.zeros(count)
    for o, each in weights.items():
        reduced = each.reduced(products.own[o], products.nuisance[o])
        inner += reduced[:-1, :-1]
        aim += reduced[:-1, -1]
    return inner, aim
