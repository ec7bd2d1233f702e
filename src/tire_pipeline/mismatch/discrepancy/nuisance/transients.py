"""What a steady formula does not model: friction that follows the last seconds, and fast changes of load."""

from __future__ import annotations

import numpy as np

from tire_pipeline.channels import SLIP_OF_FORCE
from tire_pipeline.mismatch.effects.shared import first_order
from tire_pipeline.mismatch.model.channels import high
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.residual import rms

Array = np.ndarray
BANDS = (0.0, 0.1, 0.2)
"""Seconds over which the load is averaged before its rate is taken: the answer differs from band to band."""
_LEAST_LOAD = 0.02
"""Over the nominal load: a change counts over the load itself, but where a wheel hardly touches the road."""
MEMORY_SECONDS = (1.0, 4.0)
"""Seconds over which a tread remembers."""


def memory(data: Data, name: str) -> Array:
    """Friction and stiffness that follow the friction power of the last seconds.

    Tread and belt warm and cool within a sweep. Where the power has been the same for long, this is nothing.
    """
    slip = SLIP_OF_FORCE[name]
    if data.time is None or not data.varies(slip):
        return np.zeros((data.size, 0))
    speed = np.abs(data.get("speed")) if data.has("speed") else np.ones(data.size)
    power = np.abs(data.simulation.base[name] * data.get(slip)) * speed
    power = power / max(high(power), 1e-12)
    lags = [first_order(power, data.step / lag, data.start) - power for lag in MEMORY_SECONDS]
    ways = (data.simulation.base[name], data.simulation.slope(slip)[name] * data.get(slip))
    return np.column_stack([way * lag for way in ways for lag in lags])


def fast_load(data: Data, name: str) -> Array:
    """Force of what the load changes faster than ``SLOW``, as it is and by its rate, of equal size.

    A formula is of steady states. To load that changes within a wheel turn a tire answers with another size
    and late (Pacejka, 3rd ed., 7.3.2), and what a rig measures then holds inertia.
    """
    if data.time is None:
        return np.zeros((data.size, 0))
    load = data.get("normal_load")
    change = (load - data.smooth("normal_load")) / np.maximum(load, _LEAST_LOAD * data.nominal.load)
    if not np.any(change):
        return np.zeros((data.size, 0))
    rates = [rate(data, data.running_mean(change, seconds)) for seconds in BANDS]
    drivers = [change, *(each * (rms(change) / max(rms(each), 1e-12)) for each in rates)]
    slip = SLIP_OF_FORCE[name]
    steeper = data.simulation.slope(slip)[name] * data.get(slip)
    return np.column_stack(
        [way * driver for way in (data.simulation.base[name], steeper) for driver in drivers]
    )


def rate(data: Data, x: Array) -> Array:
    """Change over two samples, nothing at the ends of pieces."""
    out = np.zeros(data.size)
    out[1:-1] = x[2:] - x[:-2]
    out[data.start] = 0.0
    out[np.flatnonzero(data.start)[1:] - 1] = 0.0
    return out
