"""Long recordings: sets are weighed on stretches spread over the time line, the refit is to all of it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.discrepancy.noise import estimate_noise
from tire_pipeline.mismatch.discrepancy.nuisance.columns import make_nuisance
from tire_pipeline.mismatch.discrepancy.nuisance.sizes import nuisance_scale
from tire_pipeline.mismatch.effects.shared import INDEPENDENT_STRETCHES
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.linearised_set import LOCKED, Fit, inverse, linearised, moved
from tire_pipeline.mismatch.model.candidates import derivatives
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.progress import track

Array = np.ndarray
MOST_SAMPLES = 18_000
"""Samples of the longest recording that is searched as a whole: 180 s at 100 Hz."""
_STRETCH = MOST_SAMPLES // INDEPENDENT_STRETCHES
_MOST_ERRORS_MOVED = 6.0
"""Standard errors that a parameter may move when the rest of a long recording is fitted, too: farther than
that the linear step says nothing."""
_RCOND = 1e-8


def thinned(data: Data) -> Data:
    """Return the recording, or stretches evenly spread over it if it is long.

    States (temperature, wear, distance) are integrated over the whole recording before.
    """
    if data.size <= MOST_SAMPLES:
        return data
    if data.time is None:
        rows = np.zeros(data.size, bool)
        rows[np.linspace(0, data.size - 1, MOST_SAMPLES).astype(int)] = True
        return data.part(rows)
    firsts = np.linspace(0, data.size - _STRETCH, INDEPENDENT_STRETCHES).astype(int)
    rows = np.zeros(data.size, bool)
    for first in firsts:
        rows[first : first + _STRETCH] = True
    return data.part(rows)


def portions(data: Data) -> Iterator[Data]:
    """Yield all samples of a long recording in portions of at most 18,000 or so.

    Each portion is made of stretches spread over the whole recording, and so has its operating space.
    """
    count = -(-data.size // MOST_SAMPLES)
    length = 1 if data.time is None else _STRETCH
    owner = (np.arange(data.size) // length) % count
    for k in range(count):
        rows = owner == k
        if rows.any():
            yield data.part(rows)


def refit_on_all(analysis: Analysis, data: Data) -> Fit:
    """Return the named set with parameters refitted to all samples of a long recording.

    One Gauss-Newton step from the fit to the thinned recording, with the normal equations of the portions
    added: from a start that is off by its standard error, one step is as good as the end (Le Cam; van der
    Vaart, Asymptotic Statistics, 5.7). Memory is that of one portion, and each portion has misfit and
    coefficients of its own. Parameters move by six standard errors of the first fit at most; a moment in time
    and a wheel's radius stay fixed. Standard errors stay as well: they come from what the model gets wrong,
    which more samples do not average out.

    Parameters
    ----------
    analysis : Analysis
        With the set that is named.
    data : Data
        All samples.
    """
    fit = analysis.fit
    if data.size <= MOST_SAMPLES or not fit.labels:
        return fit
    k = len(fit.labels)
    information, score = np.zeros((k, k)), np.zeros(k)
    count = -(-data.size // MOST_SAMPLES)
    for portion in track(portions(data), "refitting on all samples", count):
        part_information, part_score = _normal_equations(analysis, portion)
        information += part_information
        score += part_score
    live = np.array([name not in LOCKED for _, name in fit.labels]) & (np.diag(information) > 0.0)
    delta = np.zeros(k)
    delta[live] = inverse(information[np.ix_(live, live)], _RCOND) @ score[live]
    most = _MOST_ERRORS_MOVED * fit.errors
    changes = moved(fit.changes, fit.labels, np.clip(delta, -most, most))
    return linearised(analysis.system, changes, fit.free, fit.covariance, fit.weight, fit.prior)


def _normal_equations(analysis: Analysis, data: Data) -> tuple[Array, Array]:
    """Information and score of the effects' parameters in one portion, given misfit and coefficients."""
    rest = residual(data, analysis.fit.changes)
    columns: dict[str, list[Array]] = {o: [] for o in data.outputs}
    for i in range(len(analysis.fit.changes)):
        found = dict(derivatives(data, analysis.fit.changes, i, analysis.fit.free[i]))
        for name in [n for j, n in analysis.fit.labels if j == i]:
            for o in data.outputs:
                columns[o].append(found[name][o] if name in found else np.zeros(data.size))
    nuisance = make_nuisance(data)
    scale = nuisance_scale(nuisance.sizes, analysis.misfit, analysis.path)
    noise = estimate_noise(data, rest)
    system = System(data, noise, np.zeros(data.size, int), nuisance.columns, scale)
    sums = system.sums(rest, {o: np.column_stack(c) for o, c in columns.items()})
    information, score, _ = system.reduce(sums)
    return information, score
