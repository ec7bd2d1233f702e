"""Fit one set of effects with its physical priors (damped Gauss-Newton)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfSet, RecordingProducts
from tire_pipeline.mismatch.inference.linearised_set import moved
from tire_pipeline.mismatch.inference.sets.moments import log_spread, with_likeliest_moments
from tire_pipeline.mismatch.inference.sets.objective import (
    negative_log_posterior,
    normal_equations,
)
from tire_pipeline.mismatch.inference.tails import widening
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.model.forces import Change

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
    best = negative_log_posterior(products, likelihood, changes, smooth)
    while gain >= CHANCE:
        further, _, _ = _step(products, likelihood, changes, smooth)
        cost = negative_log_posterior(products, likelihood, further, smooth)
        gain = best - cost  # summed over all sizes: near one size a step may undo what gains near another
        if gain > 0.0:
            changes, best = further, cost
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
    here = normal_equations(products, likelihood, changes, free)
    near = likelihood.at(here.weights)
    if not here.labels:
        return changes, 0.0, near
    best = negative_log_posterior(products, near, changes, free)
    tails = 1.0 / widening(here.off / here.wide) ** 2
    inner, aim = here.inner + np.diag(tails), here.aim - tails * here.off / here.wide
    for damping in _DAMPINGS:
        delta = np.linalg.solve(inner + damping * np.diag(np.diag(inner)), aim) * here.wide
        trial = moved(changes, here.labels, delta)
        tried = negative_log_posterior(products, near, trial, free)
        if tried < best:
            return trial, best - tried, near
    return changes, 0.0, near
