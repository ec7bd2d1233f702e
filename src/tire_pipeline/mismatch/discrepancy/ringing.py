"""Unnamed forms of a rig that rings: the load cell carries a mass on a spring.

A cell measures a force F as (w^2 + 2 z w s) / (s^2 + 2 z w s + w^2) F, with the rig's own frequency
w and its damping z. What the mass adds is -s^2 / (s^2 + 2 z w s + w^2) F: nothing where the force is slow.
Where the damper is not beside the cell, as in a carcass on its rim, -2 z w s / (s^2 + 2 z w s + w^2) F comes
on top.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache, partial

import numpy as np
import scipy

from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
_LOWEST_FREQUENCY = 3.0
"""Of the first bending of rigs and their load cells, Hz."""
_DAMPING = (0.03, 0.1)
"""Of a rig, and of a tire on its rim."""
_SAMPLES_A_CYCLE = 3.0
"""A cycle has at least so many, or sampling does not show it."""


def ringing_forms(data: Data, changes: list[Change]) -> Iterator[dict[str, Array]]:
    """Yield for each force what adds to it, N, where it rings as its residual does most clearly.

    What rings is as narrow as its damping, so a few fixed frequencies would miss it. Each axis of a rig, and
    of a tire, has a frequency of its own.
    """
    step = float(np.median(data.step))
    firsts, rest, force = np.flatnonzero(data.start)[1:], residual(data, changes), simulate(data, changes)
    tried = [(f, z) for z in _DAMPING for f in _frequencies(z, step)]
    for o in data.outputs:
        pieces = np.split(force[o], firsts)
        found = [np.vstack([rung(piece, f, step, z) for piece in pieces]) for f, z in tried]
        ringing = [added for added in found if np.any(added)]
        if not ringing:
            continue
        best = max(ringing, key=partial(_explained, rest=rest[o]))
        yield {other: best if other == o else np.zeros_like(best) for other in data.outputs}


def _explained(columns: Array, rest: Array) -> float:
    """Return how much columns explain of the squares of a residual, N^2."""
    return float((columns.T @ rest) @ np.linalg.lstsq(columns, rest, rcond=None)[0])


def _frequencies(damping: float, step: float) -> Iterator[float]:
    """Yield frequencies that sampling shows, Hz, each as wide as the damping makes it."""
    frequency = _LOWEST_FREQUENCY
    while _SAMPLES_A_CYCLE * frequency * step <= 1.0:
        yield frequency
        frequency *= 1.0 + damping


def rung(force: Array, frequency: float, step: float, damping: float) -> Array:
    """Return what a rig adds that rings at a frequency, by its mass and by its damper, from rest.

    Parameters
    ----------
    force : ndarray, shape (n,)
        N, at even steps.
    frequency : float
        Hz.
    step : float
        s.
    damping : float
        Over the critical one.

    Returns
    -------
    ndarray, shape (n, 2)
        N.
    """
    since = force - force[0]
    filters = _filters(frequency, step, damping)
    return np.column_stack([scipy.signal.lfilter(above, below, since) for above, below in filters])


@lru_cache
def _filters(frequency: float, step: float, damping: float) -> list[tuple[Array, Array]]:
    """Return numerator and denominator of what the mass adds, and of what the damper adds."""
    w = 2.0 * np.pi * frequency
    within, out = [1.0, 2.0 * damping * w, w * w], []
    for part in ([-1.0, 0.0, 0.0], [-2.0 * damping * w, 0.0]):
        above, below, _ = scipy.signal.cont2discrete((part, within), step, method="foh")
        out.append((np.ravel(above), below))
    return out
