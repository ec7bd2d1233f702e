"""Long recordings: the search looks at whole stretches spread over the time line, the refit at all of it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.discrepancy.noise import estimate_noise
from tire_pipeline.mismatch.discrepancy.nuisance import make_nuisance
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.refit import Fit, finish, inverse, objective
from tire_pipeline.mismatch.inference.search import Search
from tire_pipeline.mismatch.inference.search_state import nuisance_scale
from tire_pipeline.mismatch.model.candidates import derivatives
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.progress import track

Array = np.ndarray
MOST_SAMPLES = 18_000
_STRETCH = 40.0
_FARTHEST = 6.0
_RCOND = 1e-8
_FIXED = {"radius", "moment"}


def thinned(data: Data) -> Data:
    """Return the recording, or stretches of 40 s evenly spread over it if it is long.

    States (temperature, wear, distance) are integrated over the whole recording before.
    """
    if data.size <= MOST_SAMPLES:
        return data
    if data.time is None:
        rows = np.zeros(data.size, bool)
        rows[np.linspace(0, data.size - 1, MOST_SAMPLES).astype(int)] = True
        return data.part(rows)
    stretch = _stretch(data)
    count = max(MOST_SAMPLES // stretch, 2)
    firsts = np.linspace(0, data.size - stretch, count).astype(int)
    rows = np.zeros(data.size, bool)
    for first in firsts:
        rows[first : first + stretch] = True
    return data.part(rows)


def _stretch(data: Data) -> int:
    return max(int(_STRETCH / max(float(np.median(data.step)), 1e-9)), 200)


def portions(data: Data) -> Iterator[Data]:
    """Yield all samples of a long recording in portions of at most 18,000 or so.

    Each portion is made of stretches spread over the whole recording, and so has its operating space.
    """
    count = -(-data.size // MOST_SAMPLES)
    length = 1 if data.time is None else _stretch(data)
    owner = (np.arange(data.size) // length) % count
    for k in range(count):
        rows = owner == k
        if rows.any():
            yield data.part(rows)


def refit_on_all(search: Search, data: Data) -> Fit:
    """Return the fit of a search with parameters refitted to all samples of a long recording.

    One Gauss-Newton step from the fit to the thinned recording, with the normal equations of the
    portions added: from a start that is off by its standard error, one step is as good as the end
    (Le Cam; van der Vaart, Asymptotic Statistics, 5.7). Memory is that of one portion. In the step each
    portion has misfit and coefficients of its own. In the standard errors they are common to all: noise
    averages out over more samples, what the misfit adds to the first fit's variance stays. Parameters
    move by six standard errors of the first fit at most; a moment in time and a wheel's radius stay.

    Parameters
    ----------
    search : Search
        After the search.
    data : Data
        All samples.
    """
    fit = search.fit
    if data.size <= MOST_SAMPLES or not fit.labels:
        return fit
    k = len(fit.labels)
    information, score = np.zeros((k, k)), np.zeros(k)
    count = -(-data.size // MOST_SAMPLES)
    for portion in track(portions(data), "refitting on all samples", count):
        part_information, part_score = _normal_equations(search, portion)
        information += part_information
        score += part_score
    live = np.array([name not in _FIXED for _, name in fit.labels]) & (np.diag(information) > 0.0)
    delta = np.zeros(k)
    delta[live] = inverse(information[np.ix_(live, live)], _RCOND) @ score[live]
    before = np.sqrt(np.maximum(np.diag(fit.covariance), 0.0) * search.inflation)
    changes = _moved(fit, np.clip(delta, -_FARTHEST * before, _FARTHEST * before))
    out = finish(search.system, changes, fit.free, objective(search.system, changes))
    if out.labels == fit.labels and fit.sums is not None:
        noise = np.diag(inverse(fit.sums.ee.sum(axis=0), _RCOND))
        gone = np.where(live, noise * (1.0 - search.data.size / data.size), 0.0)
        variance = np.diag(fit.covariance)
        shrink = np.sqrt(np.clip(1.0 - gone / np.maximum(variance, 1e-300), 0.0, 1.0))
        out.covariance = fit.covariance * shrink[:, None] * shrink[None, :]
    return out


def _normal_equations(search: Search, data: Data) -> tuple[Array, Array]:
    """Information and score of the effects' parameters in one portion, given misfit and coefficients."""
    rest = residual(data, search.fit.changes)
    columns: dict[str, list[Array]] = {o: [] for o in data.outputs}
    for i in range(len(search.fit.changes)):
        found = dict(derivatives(data, search.fit.changes, i, search.fit.free[i]))
        for name in [n for j, n in search.fit.labels if j == i]:
            for o in data.outputs:
                columns[o].append(found[name][o] if name in found else np.zeros(data.size))
    nuisance = make_nuisance(data)
    scale = nuisance_scale(nuisance.sizes, search.misfit, search.path)
    noise = estimate_noise(data, rest)
    system = System(data, noise, np.zeros(data.size, int), nuisance.columns, scale)
    sums = system.sums(rest, {o: np.column_stack(c) for o, c in columns.items()})
    information, score, _ = system.reduce(sums)
    return information, score


def _moved(fit: Fit, delta: Array) -> list[Change]:
    """Return the effects with their parameters moved, inside of their bounds."""
    moved: list[tuple[str, dict[str, float]]] = [(n, dict(p)) for n, p in fit.changes]
    for (i, name), d in zip(fit.labels, delta, strict=True):
        parameter = catalogue()[moved[i][0]].parameter(name)
        values = moved[i][1]
        values[name] = float(np.clip(values[name] + d, parameter.low, parameter.high))
    return list(moved)
