"""Other beginnings: where the likeliest first effect leads to nothing that holds, the next ones are tried."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.inference.refit import Fit, objective, refit
from tire_pipeline.mismatch.inference.screening import gain_of, prune, screen
from tire_pipeline.mismatch.inference.search import run
from tire_pipeline.mismatch.inference.search_state import Search, renoise
from tire_pipeline.mismatch.inference.shapes import with_shapes
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.residual import residual

_FOUND = "fit gates doubts unnamed likelier noise system loose frozen inflation misfit refused".split()

Array = np.ndarray


def unlike(search: Search, log_evidence: float) -> bool:
    """Whether the effects leave so much that something else, which resembles them, must be the cause.

    Parameters
    ----------
    search : Search
    log_evidence : float
        What is left above white noise.
    """
    if not search.gates or log_evidence < settings.REMAINDER_LOG_EVIDENCE:
        return False
    return log_evidence > settings.UNLIKE * max(g.gain for g in search.gates)


def search_all(search: Search) -> None:
    """Search from the likeliest effect; if that does not hold, from the next ones, two at most.

    Two effects together can look like a third one, which then goes in first and bars the way. A single effect
    that leaves an unexplained residual is doubted, too; but others have to be likelier than it. What is
    found instead has to be likelier than the first one with its best further effect, too small to be named.
    """
    run(search)
    left = _left(search)
    holds = _holds(search, left)
    if holds and (len(search.fit.names) != 1 or left < settings.REMAINDER_LOG_EVIDENCE):
        return
    before = search.fit.names[:1] or search.withdrawn[:1]
    empty = replace(search, fit=Fit([], []), gates=[], refused={}, unnamed="", withdrawn=[], log=[])
    renoise(empty)
    best: Search | None = None
    named = bool(search.fit.names or search.withdrawn)
    most = _gain_of_first(empty) if named else settings.LEAST_GAIN
    if holds:
        most = _gain(empty, search.fit) + settings.TIE
    elif search.fit.names:
        most = max(most, _gain(empty, search.fit) + _promise(search))
    for variant in _others(search, set(before)):
        trial = _from(empty, variant)
        if trial is None or not trial.fit.names or not _holds(trial, _left(trial)):
            continue
        gain = _gain(empty, trial.fit)
        if gain > most:
            best, most = trial, gain
    if best is not None:
        search.log += ["another beginning:", *best.log]
        for name in _FOUND:
            setattr(search, name, getattr(best, name))


def _left(search: Search) -> float:
    """Return what is left above white noise, as log evidence."""
    return excess(search, white_left(search))[1]


def _holds(search: Search, left: float) -> bool:
    """Whether what was found, with so much log evidence left, is not in doubt."""
    if not search.fit.names:
        seen = _gain_of_first(search) > 2.0 * settings.LEAST_GAIN
        return left < settings.REMAINDER_LOG_EVIDENCE and not search.unnamed and not seen
    return not search.unnamed and not unlike(search, left)


def _others(search: Search, barred: set[str]) -> list[Variant]:
    """Return the best forms of the next effects of the first screen."""
    out: list[Variant] = []
    top = search.first[0][0] if search.first else 0.0
    for gain, variant in search.first:
        if variant.name in barred or gain < max(settings.OTHER_START * top, settings.LEAST_GAIN):
            continue
        barred = {*barred, variant.name}
        out.append(variant)
    return out[:2]


def _from(empty: Search, variant: Variant) -> Search | None:
    """Search with one effect put in first, if it and the best second one may beat the likeliest effect."""
    trial = replace(empty, refused={}, withdrawn=[], log=[])
    trial.fit = prune(trial, refit(empty.system, [variant], start=[(variant.name, variant.start)]))
    if _gain(empty, trial.fit) + _promise(trial) < _gain_of_first(empty):
        return None
    renoise(trial)
    run(trial)
    return trial


def _promise(search: Search) -> float:
    """Return the evidence that the screen gives to the best further effect."""
    second = screen(search, with_shapes(search, search.system, search.fit.changes))
    return second[0][0] if second else -np.inf


def _gain_of_first(search: Search) -> float:
    """Evidence that the first screen gave to the likeliest effect."""
    return search.first[0][0] if search.first else 0.0


def _gain(search: Search, fit: Fit) -> float:
    """Evidence of a fit by the weights of a search, as a log."""
    at = replace(fit, objective=objective(search.system, fit.changes))
    return gain_of(search, at, objective(search.system, []))


def white_left(search: Search) -> dict[str, Array]:
    """Return the whitened residual beside the effects, their form errors and nearly free coefficients."""
    fit = search.fit
    system = with_shapes(search, search.loose, fit.changes)
    return system.left(residual(search.data, fit.changes), fit.columns if fit.labels else None)


def excess(search: Search, left: dict[str, Array]) -> tuple[float, float]:
    """Return how much power whitened residuals have beyond white noise, and what that is worth in log
    evidence.

    At each scale the samples are summed over windows; the mean square of the sums over that of
    noise as the search takes it (white, of the same robust size, times ``inflation``) is 1 for noise. The
    worst output and scale count.

    Where the recording states its uncertainty (``fy_std``, as :func:`axle_recording` does) neighbours share
    a filter and unknowns that are constant over a drive: slow changes are no evidence there, and only
    power beyond what is stated counts.
    """
    worst, log_evidence = 1.0, 0.0
    for o, white in left.items():
        if f"{o}_std" in search.data.channels:
            ratio = float(np.mean(np.minimum(white**2, 25.0)))
            worst = max(worst, ratio)
            if ratio > 1.0:
                count = white.size / search.inflation
                log_evidence = max(log_evidence, 0.5 * count * (ratio - 1.0 - np.log(ratio)))
            continue
        size = float(np.median(white**2) / 0.4549)
        x = white / np.sqrt(max(size, 1e-12))
        for width in (1, 5, 12, 25, 60):
            n = x.size // width
            if n < 30:
                continue
            sums = x[: n * width].reshape(n, width).sum(axis=1) / np.sqrt(width)
            ratio = float(np.mean(np.minimum(sums**2, 25.0))) / search.inflation
            worst = max(worst, ratio)
            if ratio > 1.0:
                log_evidence = max(log_evidence, 0.5 * n * (ratio - 1.0 - np.log(ratio)))
    return worst, log_evidence
