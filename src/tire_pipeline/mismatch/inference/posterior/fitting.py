"""Fit one set of effects with its physical priors, and keep what the recording says about it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tire_pipeline.mismatch.discrepancy.form_error import shape_columns
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.posterior.priors import Labels, prior
from tire_pipeline.mismatch.inference.posterior.products import OfSet, RecordingProducts
from tire_pipeline.mismatch.inference.refit import columns_of, moved
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
Free = list[tuple[str, ...]]
_DAMPINGS = (1e-6, 0.1, 3.0)
_ENOUGH = 0.5
"""Log evidence below which a step is the last one."""


def fitted(products: RecordingProducts, variants: Sequence[Variant], steps: int) -> OfSet:
    """Find the likeliest parameters of a set (damped Gauss-Newton) and return its products.

    Parameters
    ----------
    products : RecordingProducts
    variants : sequence of Variant
        The effects, each where the fit begins.
    steps : int
        Most steps.
    """
    changes: list[Change] = [(v.name, dict(v.start)) for v in variants]
    free = [tuple(v.free) for v in variants]
    best = _cost(products, changes, free)
    for _ in range(steps):
        changes, cost = _step(products, changes, free, best)
        if best - cost < _ENOUGH:
            break
        best = cost
    return of_changes(products, changes, free)


def of_changes(products: RecordingProducts, changes: Sequence[Change], free: Free) -> OfSet:
    """Return the products of a set at given parameters."""
    data = products.search.data
    rest = residual(data, changes)
    labels, columns = columns_of(data, list(changes), free)
    off, wide = prior(data, changes, labels)
    shapes = [shape_columns(data, changes, i) for i in range(len(changes))]
    every = {}
    for o in data.outputs:
        centred = rest[o] + columns[o] @ off
        errors = [part[o] if other == o else np.zeros_like(part[o]) for part in shapes for other in part]
        every[o] = np.column_stack([columns[o] * wide, *errors, centred])
    own, across = products.of(every)
    power = sum(float(np.log(np.mean(r**2))) for r in rest.values())
    return OfSet(tuple((n, dict(p)) for n, p in changes), len(labels), own, across, power)


def _cost(products: RecordingProducts, changes: list[Change], free: Free) -> float:
    """Twice the negative log posterior of the parameters, beside the misfit as the search knows it."""
    search = products.search
    labels = _moving(changes, free)
    off, wide = prior(search.data, changes, labels)
    left = search.system.reduce(search.system.sums(residual(search.data, changes)))[2]
    return left / search.inflation + float(np.sum((off / wide) ** 2))


def _moving(changes: Sequence[Change], free: Free) -> Labels:
    return [
        (i, p.name)
        for i, ((name, _), names) in enumerate(zip(changes, free, strict=True))
        for p in catalogue()[name].parameters
        if p.name in names and p.name not in catalogue()[name].scanned
    ]


def _step(
    products: RecordingProducts, changes: list[Change], free: Free, best: float
) -> tuple[list[Change], float]:
    """Make one step, damped until it helps."""
    search = products.search
    smooth = [
        tuple(p for p in names if p not in catalogue()[name].scanned)
        for (name, _), names in zip(changes, free, strict=True)
    ]
    labels, columns = columns_of(search.data, changes, smooth)
    if not labels:
        return changes, best
    sums = search.system.sums(residual(search.data, changes), columns)
    info, score, _ = search.system.reduce(sums)
    off, wide = prior(search.data, changes, labels)
    inner = info / search.inflation * wide[:, None] * wide[None, :] + np.eye(wide.size)
    aim = score / search.inflation * wide - off / wide
    for damping in _DAMPINGS:
        delta = np.linalg.solve(inner + damping * np.diag(np.diag(inner)), aim) * wide
        trial = moved(changes, labels, delta)
        cost = _cost(products, trial, smooth)
        if cost < best:
            return trial, cost
    return changes, best
