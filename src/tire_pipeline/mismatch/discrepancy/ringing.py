"""Unnamed forms of a rig that rings: the load cell carries a mass on a spring.

A cell measures a force F as (w^2 + 2 z w s) / (s^2 + 2 z w s + w^2) F, with the rig's own frequency
w and its damping z. What it adds is -s^2 / (s^2 + 2 z w s + w^2) F: nothing where the force is slow.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import scipy

from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate

Array = np.ndarray
_LOWEST_FREQUENCY = 3.0
"""Of the first bending of rigs and their load cells, Hz; the next are half an octave apart, as wide as the
damping."""
_DAMPING = 0.1
_SAMPLES_A_CYCLE = 3.0
"""A cycle has at least so many, or sampling does not show it."""


def ringing_forms(data: Data, changes: list[Change]) -> Iterator[dict[str, Array]]:
    """Yield for each frequency that sampling shows what a rig that rings adds to each force, N."""
    step = float(np.median(data.step))
    firsts = np.flatnonzero(data.start)[1:]
    pieces = {o: np.split(force, firsts) for o, force in simulate(data, changes).items() if o in data.outputs}
    frequency = _LOWEST_FREQUENCY
    while _SAMPLES_A_CYCLE * frequency * step <= 1.0:
        added = {o: np.concatenate([rung(piece, frequency, step) for piece in pieces[o]]) for o in pieces}
        if any(np.any(a) for a in added.values()):
            yield {o: a[:, None] for o, a in added.items()}
        frequency *= np.sqrt(2.0)


def rung(force: Array, frequency: float, step: float) -> Array:
    """Return what a rig adds that rings at a frequency, from rest at the first sample.

    Parameters
    ----------
    force : ndarray, shape (n,)
        N, at even steps.
    frequency : float
        Hz.
    step : float
        s.

    Returns
    -------
    ndarray, shape (n,)
        N.
    """
    w = 2.0 * np.pi * frequency
    system = ([-1.0, 0.0, 0.0], [1.0, 2.0 * _DAMPING * w, w * w])
    above, below, _ = scipy.signal.cont2discrete(system, step, method="bilinear")
    return np.asarray(scipy.signal.lfilter(np.ravel(above), below, force - force[0]))
