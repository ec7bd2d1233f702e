"""The proof: the model locked, errors on sweeps and on one condition that the fit did not see."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.channels import MOMENT_CHANNELS
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.model.channels import DOES_NOTHING, span, white_noise
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import simulate_moments
from tire_pipeline.mismatch.model.residual import partly, residual, rms, root_ratio_interval
from tire_pipeline.mismatch.proof.left_out import step_without
from tire_pipeline.mismatch.proof.measured import OutputFit
from tire_pipeline.mismatch.proof.never_worse import Guarded

Array = np.ndarray


def prove(
    analysis: Analysis,
    allowed: Guarded,
    noise: Mapping[str, float],
) -> dict[str, OutputFit]:
    """Return for each output the error on sweeps that neither the choice of effects nor its fit has seen.

    Parameters
    ----------
    analysis : Analysis
    allowed : Guarded
        What is added. In the held-out condition the effects are locked, and the parameters are fitted to the
        sweeps outside of it.
    noise : mapping of float
        Output -> RMS of the recording's noise, N (:func:`.proof.remainder.noise_floors`).
    """
    data = analysis.data
    before = {o: data.recorded[o] - data.simulation.base[o] for o in data.outputs}
    name, rows = held_out_condition(data)
    condition = _condition(analysis, rows) if rows is not None else None
    out = {}
    for o in data.outputs:
        after = partly(before[o], allowed.left[o], allowed.agreed.get(o, 1.0))
        low, high = _interval(analysis, after)
        out[o] = OutputFit(
            noise_floor=noise[o],
            rms_before=rms(before[o]),
            rms_after=rms(after),
            rms_after_low=low,
            rms_after_high=high,
            held_out_condition=name,
            rms_condition_before=float("nan") if rows is None else rms(before[o][rows]),
            rms_condition_after=float("nan")
            if condition is None or rows is None
            else rms(partly(before[o], condition[o], allowed.added(o))[rows]),
        )
    return out


def _interval(analysis: Analysis, after: Array) -> tuple[float, float]:
    """Return the 95% interval of the RMS by resampling sweeps."""
    sums = np.bincount(analysis.block, after**2, analysis.system.count)
    return root_ratio_interval(sums, np.bincount(analysis.block, minlength=analysis.system.count))


def prove_moments(analysis: Analysis, allowed: Guarded) -> dict[str, OutputFit]:
    """Return the errors of the recorded moments, N m, which no fit has seen: only fx and fy were fitted.

    Moments that the model does not give (no coefficients, or
    another simulator's output in its place) are left out.
    """
    data = analysis.data
    names = recorded_moments(data)
    if not names:
        return {}
    plain = simulate_moments(data, [], names)
    corrected = simulate_moments(data, analysis.fit.changes, names)
    out = {}
    for name in names:
        recorded = data.channels[name]
        before = recorded - plain[name]
        after = partly(before, recorded - corrected[name], allowed.added(name))
        low, high = _interval(analysis, after)
        out[name] = OutputFit(
            noise_floor=white_noise(after) if data.time is not None else float("nan"),
            rms_before=rms(before),
            rms_after=rms(after),
            rms_after_low=low,
            rms_after_high=high,
        )
    return out


def made_worse(moments: Mapping[str, OutputFit]) -> dict[str, OutputFit]:
    """Return the moments whose error grows with what was found: nothing but forces was fitted."""
    return {o: f for o, f in moments.items() if f.rms_after > f.rms_before * (1.0 + DOES_NOTHING)}


def recorded_moments(data: Data) -> tuple[str, ...]:
    """Moments that are recorded without holes and that the model gives."""
    names = [n for n in MOMENT_CHANNELS if n in data.channels and bool(np.isfinite(data.channels[n]).all())]
    if not names or data.simulation.beside is not None:
        return ()
    plain = simulate_moments(data, [], names)
    return tuple(n for n in names if np.ptp(plain[n]) > 1e-6 * max(float(np.ptp(data.channels[n])), 1e-9))


def held_out_condition(data: Data) -> tuple[str, Array | None]:
    """Return the condition to hold out: the upper half of the loads, else of the slips, by their range."""
    for name, unit in (("normal_load", "N"), ("slip_angle", "rad"), ("slip_ratio", "1")):
        if data.varies(name):
            x = np.abs(data.get(name))
            limit = float(np.mean(span(x)))
            return f"|{name}| above {limit:.4g} {unit}", x > limit
    return "", None


def _condition(analysis: Analysis, rows: Array) -> dict[str, Array] | None:
    """Return residuals with parameters fitted to the sweeps that do not enter the condition."""
    if not analysis.fit.labels:
        return residual(analysis.data, analysis.fit.changes)
    count = analysis.system.count
    touched = np.bincount(analysis.block, rows.astype(float), count) > 0
    after = residual(analysis.data, analysis.fit.changes)
    if touched.all():
        inside = np.bincount(analysis.block, rows.astype(float), count)
        size = np.bincount(analysis.block, minlength=count)
        touched = inside / np.maximum(size, 1) > 0.5
    if touched.all() or not touched.any():
        return None
    delta = step_without(analysis.fit, touched) - step_without(analysis.fit, np.zeros(count, bool))
    return {o: after[o] - analysis.fit.columns[o] @ delta for o in after}
