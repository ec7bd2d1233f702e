"""Fit one set of effects with its physical priors (damped Gauss-Newton)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfSet, RecordingProducts
from tire_pipeline.mismatch.inference.linearised_set import columns_of, moved
from tire_pipeline.mismatch.inference.sets.moments import log_spread, with_likeliest_moments
from tire_pipeline.mismatch.inference.sets.objective import (
    learnt_prior,
    negative_log_posterior,
    normal_equations,
)
from tire_pipeline.mismatch.inference.tails import widening
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.channels import CHANCE
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
    changes, more = with_likeliest_moments(products, near, changes, free)
    gain += more
    while gain >= CHANCE:
        changes, gain, near = _step(products, likelihood, changes, smooth)
    spread = log_spread(products, likelihood, changes, free)
    return replace(products.of_set(changes, free), spread=spread)


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
    off, wide = learnt_prior(data, likelihood, changes, labels)
    rest = residual(data, changes)
    here = products.of({o: np.column_stack([columns[o] * wide, r]) for o, r in rest.items()})
    found = likelihood.evidence(here, np.ones(wide.size))
    near = likelihood.at(found.weights)
    if not labels:
        return changes, 0.0, near
    best = negative_log_posterior(products, near, changes, free)
    inner, aim = normal_equations(found.weights, here, wide.size)
    tails = 1.0 / widening(off / wide) ** 2
    inner, aim = inner + np.diag(tails), aim - tails * off / wide
    for damping in _DAMPINGS:
        delta = np.linalg.solve(inner + damping * np.diag(np.diag(inner)), aim) * wide
        trial = moved(changes, labels, delta)
        tried = negative_log_posterior(products, near, trial, free)
        if tried < best:
            return trial, best - tried, near
    return changes, 0.0, near
