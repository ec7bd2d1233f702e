"""Errors on the rows as they were recorded: what ``tire.forces`` and ``corrected.predict`` leave there.

Sets are weighed on rows that are repaired, averaged to 50 to 100 Hz and cleaned. Errors on such rows are
smaller, because this removes noise, and must not be compared with those on the user's own rows.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.mismatch.corrected.model import CorrectedModel
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate_moments
from tire_pipeline.mismatch.model.residual import partly, residual, rms
from tire_pipeline.mismatch.proof.measured import OutputFit
from tire_pipeline.mismatch.proof.never_worse import Guarded
from tire_pipeline.mismatch.unnamed_physics.found import UnnamedReport

Array = np.ndarray


def as_recorded(
    fit: dict[str, OutputFit],
    analysis: Analysis,
    allowed: Guarded,
    corrected: CorrectedModel,
    recording: pd.DataFrame,
    used: Array,
    spoiled: bool,
) -> dict[str, OutputFit]:
    """Return the errors on the recorded rows.

    Parameters
    ----------
    fit : dict of OutputFit
        Errors on the rows that were weighed.
    analysis : Analysis
    allowed : Guarded
        What is added: ``corrected`` has it.
    corrected : CorrectedModel
    recording : pandas.DataFrame
        As it came.
    used : ndarray of int
        Its rows that were weighed: what was taken out as a fault is no noise.
    spoiled : bool
        Whether other rows were taken out as a fault: the errors after the correction are without them.

    Returns
    -------
    dict of OutputFit
        ``rms_before`` is what ``tire.forces`` leaves. ``rms_after`` is what ``corrected.predict`` leaves, and
        what it leaves more on sweeps that the fit of its parameters has not seen. Without effects and repairs
        both are the same.
    """
    before = _errors(corrected.as_it_came, recording, fit)
    same = not (corrected.changes or corrected.factors or corrected.limits)
    after = before if same else _errors(corrected, recording, fit)
    first, last = (_left(analysis.data, changes, fit) for changes in ([], analysis.fit.changes))
    last = {o: first[o] if o in corrected.as_filed else rest for o, rest in last.items()}
    inside = {o: rms(partly(first[o], last[o], allowed.added(o))) for o in first}
    good = np.isin(np.arange(len(recording)), used) if spoiled else np.ones(len(recording), bool)
    moved = {o: _moved(f, before[o], after[o], inside[o], recording, same, good) for o, f in fit.items()}
    if same and analysis.data.simulation.own_relaxation:  # what lacks the file's lag leaves more than noise
        return {o: replace(m, noise_floor=fit[o].noise_floor) for o, m in moved.items()}
    return {
        o: replace(m, noise_floor=_noise(fit[o].noise_floor, after[o][used], inside[o]))
        for o, m in moved.items()
    }


def _left(data: Data, changes: Sequence[Change], outputs: Iterable[str]) -> dict[str, Array]:
    """Residuals of the weighed forces, N, and of recorded moments, N m, with some changes."""
    left = residual(data, changes)
    moments = [o for o in outputs if o not in left]
    simulated = simulate_moments(data, changes, moments) if moments else {}
    return left | {o: data.channels[o] - simulated[o] for o in moments}


def _noise(floor: float, after: Array, inside: float) -> float:
    """Return the noise of the recorded rows: that of the weighed rows, and what averaging took off it."""
    further = rms(after) ** 2 - inside**2
    return float(np.sqrt(floor**2 + further)) if further > 0.0 else floor


def _errors(corrected: CorrectedModel, recording: pd.DataFrame, outputs: Iterable[str]) -> dict[str, Array]:
    """Recorded minus predicted at the recorded rows, N or N m; NaN where something is missing.

    A force in another unit is brought to newtons: it is predicted as it is recorded.
    """
    predicted, factors = corrected.predict(recording), corrected.factors
    return {o: (recording[o] - predicted[o]).to_numpy(float) * factors.get(o, 1.0) for o in outputs}


def _moved(
    f: OutputFit,
    before: Array,
    after: Array,
    inside: float,
    recording: pd.DataFrame,
    same: bool,
    good: Array,
) -> OutputFit:
    first, last = rms(before), rms(after[good])
    further = last**2 - inside**2

    def at_rows(value: float) -> float:
        return float(np.sqrt(max(value**2 + further, 0.0)))

    rows = _inside(f.held_out_condition, recording)
    changed: dict[str, Any] = {
        "rms_before": first,
        "rms_after": last if same else at_rows(f.rms_after),
        "rms_after_low": at_rows(f.rms_after_low),
        "rms_after_high": at_rows(f.rms_after_high),
    }
    if rows is not None and np.isfinite(f.rms_condition_before):
        there = rms(before[rows])
        changed["rms_condition_before"] = there
        if same:
            changed["rms_condition_after"] = rms(after[rows & good])
    return replace(f, **changed)


def _inside(condition: str, recording: pd.DataFrame) -> Array | None:
    """Rows of the held-out condition, ``|normal_load| above 2400 N``."""
    found = re.fullmatch(r"\|(\w+)\| above (\S+) \S+", condition)
    if found is None or found[1] not in recording:
        return None
    return np.abs(recording[found[1]].to_numpy(float)) > float(found[2])


def with_unnamed(fit: dict[str, OutputFit], found: UnnamedReport) -> dict[str, OutputFit]:
    """Return the errors with an unnamed equation in the model, by what it does on sweeps it has not seen.

    What it predicts of these was not noise, so the noise is at most the error that remains.
    """
    ratios = {o: after / max(before, 1e-300) for o, (before, after) in _unseen(found).items()}
    smaller = _times(fit, ratios)
    capped = {o: min(smaller[o].noise_floor, smaller[o].rms_after) for o in ratios}
    return {**smaller, **{o: replace(smaller[o], noise_floor=noise) for o, noise in capped.items()}}


def without_unnamed(fit: dict[str, OutputFit], found: UnnamedReport) -> dict[str, OutputFit]:
    """Return the errors that stood there before :func:`with_unnamed`; the noise stays."""
    return _times(fit, {o: before / max(after, 1e-300) for o, (before, after) in _unseen(found).items()})


def _unseen(found: UnnamedReport) -> dict[str, tuple[float, float]]:
    """RMS error of each output with an equation, without and with it, N."""
    return {} if found.physics is None else {o: found.unseen[o][:2] for o in found.physics.equations}


def _times(fit: dict[str, OutputFit], ratios: dict[str, float]) -> dict[str, OutputFit]:
    errors = ("rms_after", "rms_after_low", "rms_after_high")
    changed = {
        o: replace(fit[o], **{name: getattr(fit[o], name) * r for name in errors}) for o, r in ratios.items()
    }
    return {**fit, **changed}


def never_worse(
    found: UnnamedReport, corrected: CorrectedModel, recording: pd.DataFrame
) -> tuple[UnnamedReport, CorrectedModel]:
    """Put an unnamed equation into the model, unless it makes the prediction of the recorded rows worse.

    Beside effects the inputs are as clean as these need them. An equation alone changes the forces that it
    acts on and nothing else: the inputs stay as they were recorded.

    Returns
    -------
    found : UnnamedReport
        ``unseen`` is what the equation leaves of this model's error.
    put_in : CorrectedModel
    """
    if found.physics is None:
        return found, corrected
    cleaned = corrected.cleaned if corrected.changes else {}
    put_in = replace(corrected, unnamed=found.physics, unnamed_later=found.later, cleaned=cleaned)
    outputs = tuple(found.physics.equations)
    pair = _squared(corrected, recording, outputs), _squared(put_in, recording, outputs)
    if any(with_it >= without for without, with_it in zip(*pair, strict=True)):
        return found.refused("it predicts the rows as they were recorded no better"), corrected
    if corrected.instead or corrected.part < 1.0:
        every = (replace(m, instead=(), part=1.0) for m in (corrected, put_in))
        whole = [_squared(m, recording, outputs) for m in every]
        beside = {
            o: _unseen_beside(found.unseen[o], (a, b), (c, d))
            for o, a, b, c, d in zip(outputs, *pair, *whole, strict=True)
        }
        found = replace(found, unseen={**found.unseen, **beside})
    return found, put_in


def _squared(model: CorrectedModel, recording: pd.DataFrame, outputs: Iterable[str]) -> list[float]:
    """Mean squared errors of the recorded rows, N^2."""
    return [rms(x) ** 2 for x in _errors(model, recording, outputs).values()]


def _unseen_beside(
    unseen: tuple[float, float, float], here: tuple[float, float], whole: tuple[float, float]
) -> tuple[float, float, float]:
    """Return what an equation leaves of unseen sweeps, N, beside a model that adds less than all effects.

    The equation was found beside all of what they change. A model that adds what explanations agree on leaves
    more, of which the equation knows nothing. Of what it removes from the recorded rows as much holds on
    unseen sweeps as beside all effects.

    Parameters
    ----------
    unseen : (before, after, ceiling)
        Beside all effects.
    here, whole : (without, with)
        Mean squared error of the recorded rows without and with the equation, N^2, beside what the model adds
        and beside all effects.
    """
    before, *after = unseen
    first = before**2 + max(here[0] - whole[0], 0.0)
    gone = [
        (here[0] - here[1]) * (before**2 - left**2) / max(whole[0] - whole[1], before**2 - left**2)
        for left in after
    ]
    return (first**0.5, *(max(first - each, 0.0) ** 0.5 for each in gone))
