"""Unnamed forms: an input acts through its rate, its memory or its play.

An effect of the catalogue may resemble a cause that is not in it. Every input of the tire can act on
friction and stiffness through how fast it changes and through what it was some seconds ago, and can
reach the tire through a joint with play; what the tire rolls on may repeat every few metres; and the rig may
ring.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tire_pipeline.channels import FORCE_OF_SLIP, SLIP_AND_LOAD
from tire_pipeline.mismatch.discrepancy.nuisance.transients import BANDS, MEMORY_SECONDS
from tire_pipeline.mismatch.discrepancy.repeating import repeating_forms
from tire_pipeline.mismatch.discrepancy.ringing import ringing_forms
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.shared import first_order, play
from tire_pipeline.mismatch.model.channels import CLASSES, DOES_NOTHING, high, used
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate
from tire_pipeline.mismatch.model.plain_forces import plain_forces
from tire_pipeline.mismatch.model.simulated import DIFFERENCE

Array = np.ndarray
Columns = dict[str, Array]
_PLAYS_BY_SLIP = {"slip_angle": (0.001, 0.003, 0.008), "slip_ratio": (0.008,)}
"""Half widths that are tried, rad and 1: well above the noise of the channels."""


def constant_form(data: Data, changes: list[Change]) -> Columns:
    """Friction and stiffness off by a constant: what a form gains only beyond this speaks against a name."""
    now = simulate(data, changes)
    ways: dict[str, list[Array]] = {o: [] for o in data.outputs}
    for name, effect in catalogue().items():
        if not effect.constant:
            continue
        there = simulate(data, [*changes, (name, {effect.constant: DIFFERENCE})])
        for o in data.outputs:
            ways[o].append((there[o] - now[o]) / DIFFERENCE)
    return {o: np.column_stack(w) for o, w in ways.items()}


def forms(data: Data, changes: list[Change]) -> Iterator[Columns]:
    """Yield all forms that the recording can show, around a model with some effects added.

    The rate of a slip comes twice: where slip and load are the same, and everywhere.
    """
    if data.time is None:
        return
    ways = constant_form(data, changes)
    for driver in _drivers(data):
        yield {o: ways[o] * driver[:, None] for o in data.outputs}
    yield from repeating_forms(data, changes)
    yield from ringing_forms(data, changes)
    for name, output in FORCE_OF_SLIP.items():
        if not data.varies(name) or output not in data.outputs:
            continue
        for width in _PLAYS_BY_SLIP[name]:
            moved = _with_play(data, name, width)
            yield {o: moved[o][:, None] for o in data.outputs}


def _with_play(data: Data, name: str, width: float) -> dict[str, Array]:
    """Return what play in an input does to the model's forces, N."""
    at = {n: data.get(n) for n in SLIP_AND_LOAD}
    at[name] = play(at[name], width, data.start)
    moved = plain_forces(
        data.tire, speed=data.nominal.model_speed, pressure=data.nominal.model_pressure, **at
    )
    return {o: moved[o] - data.simulation.both_forces[o] for o in data.outputs}


def _drivers(data: Data) -> Iterator[Array]:
    """Yield rates and memories of the inputs, and heat that no channel shows, each of about unit size."""
    for name in ("slip_angle", "slip_ratio", "normal_load"):
        if not data.varies(name):
            continue
        x = data.get(name)
        rate = _rate(data, x)
        if name in FORCE_OF_SLIP:
            size = _unit(np.abs(rate))
            yield _beyond_place(data, size, name)
            yield size
            yield _unit(np.sign(x) * rate)
            level = used(x)
        else:
            yield _unit(rate)
            level = x
        for lag in MEMORY_SECONDS:
            step = data.step / lag
            memory = _unit(first_order(level, step, data.start) - level)
            yield memory
            if name in FORCE_OF_SLIP:
                yield _from_rest(level, step)
    if data.states.power is not None and data.varies("tread_temperature"):  # else it is tread temperature
        for lag in MEMORY_SECONDS:
            yield _unit(data.states.heat(lag))


def _beyond_place(data: Data, driver: Array, name: str) -> Array:
    """Take from a driver its mean at each size of slip and load.

    Sweeps turn at their largest slip, so a rate is small there: what the rate does must show where slip and
    load are the same and the rate is not.
    """
    cell = np.zeros(data.size, np.intp)
    for x in (np.abs(data.get(name)), data.get("normal_load")):
        edges = np.quantile(x, np.linspace(0.0, 1.0, CLASSES + 1)[1:-1])
        cell = cell * CLASSES + np.searchsorted(edges, x)
    count = np.bincount(cell, minlength=CLASSES**2)
    mean = np.bincount(cell, driver, CLASSES**2) / np.maximum(count, 1)
    return driver - mean[cell]


def _from_rest(level: Array, step: Array) -> Array:
    """Follow a level with a lag, from zero at the first sample."""
    first = np.zeros(level.size, bool)
    first[0] = True
    begun = level.copy()
    begun[0] = 0.0
    return _unit(first_order(begun, step, first))


def _rate(data: Data, x: Array) -> Array:
    """Rate of change over a tenth of a second, bounded where steps are faster than sampling shows."""
    smooth = data.running_mean(x, BANDS[1])
    d = np.zeros_like(x)
    d[1:-1] = smooth[2:] - smooth[:-2]
    d[data.start] = 0.0
    d[np.flatnonzero(data.start)[1:] - 1] = 0.0
    return d / (2.0 * float(np.median(data.step)))


def _unit(x: Array) -> Array:
    """Scale by the size that one in ten exceeds, and saturate softly beyond it."""
    size = np.abs(x)
    top = high(size[size > DOES_NOTHING * size.max(initial=0.0)]) if np.any(size > 0.0) else 1.0
    return np.tanh(x / max(top, 1e-12))
