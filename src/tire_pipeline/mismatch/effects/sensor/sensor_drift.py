"""A channel of a force or of the load whose zero moves over time."""

from __future__ import annotations

import numpy as np

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.mismatch.effects.base import TOO_SMALL_TO_SEE, Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import settling_lags

_LEAST_LAG, _MOST_LAG = 1.0, 300.0
"""s, of a load cell or an amplifier that warms up."""


class SensorDrift(Effect):
    """An offset that grows with time, at every slip and load.

    Before and after the time that was recorded it stays where it was: nothing says where a drift goes.

    Covers a drift in proportion to time, and one that settles as a device does that warms up, within 1 to
    300 s; of the normal load, one in proportion to time. Not covered: a gain that drifts (it looks like a
    slow change of friction), steps, and a drift that follows a temperature of its own.
    """

    name = "sensor_drift"
    kind = "artefact"
    title = "a drifting force or load channel"
    equation = (
        "F recorded = F + drift (t - t0) / (t1 - t0), or with a lag "
        "F + drift (1 - exp(-(t - t0) / lag)) / (1 - exp(-(t1 - t0) / lag)); or the same of Fz, without lag"
    )
    source = "load cell or amplifier warming up"
    needs_time = True
    scanned = ("lag",)
    family = "slow"
    prior_source = "Judged: as an offset of the force"
    parameters = (
        Parameter("fy", "N", -5000.0, 5000.0, 1.0, output="fy", prior=0.03, prior_in="load_nominal"),
        Parameter("fx", "N", -5000.0, 5000.0, 1.0, output="fx", prior=0.03, prior_in="load_nominal"),
        Parameter("normal_load", "N", -5000.0, 5000.0, 1.0, prior=0.03, prior_in="load_nominal"),
        Parameter("lag", "s", 0.0, 300.0, 0.5, form=True),
    )
    looks_like = {
        "wear": "wear scales the force and is nothing at zero slip",
        "temperature": "temperature scales the force and is nothing at zero slip",
        "force_offset": "an offset is there from the start",
    }
    experiment = "record straight rolling at the start and at the end"
    order = 85

    def starts(self, data: Context) -> list[dict[str, float]]:
        """In proportion to time, settling within a twelfth or a third of the recording, or of the load."""
        zero, span = self.zeros(data), data.states.time_span
        lags = [lag for lag in settling_lags(span) if _LEAST_LAG < lag < _MOST_LAG]
        of_load = {**zero, "normal_load": TOO_SMALL_TO_SEE}
        return [zero, *({**zero, "lag": lag} for lag in lags), of_load]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Return the drifts, and the lag of a drift that settles."""
        if start["normal_load"]:
            return ("normal_load",)
        drifts = tuple(p.name for p in self.parameters if p.output)
        return (*drifts, "lag") if start["lag"] else drifts

    def outside(self, data: Context, p: Parameters) -> bool:
        """Whether no device warms up so fast or so slowly."""
        return bool(p["lag"]) and not _LEAST_LAG <= p["lag"] <= _MOST_LAG

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take the drift off the load."""
        if p["normal_load"]:
            drifted = p["normal_load"] * np.clip(data.states.elapsed, 0.0, 1.0)
            state.normal_load = np.maximum(state.normal_load - drifted, 0.0)

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Add the drift of the forces."""
        so_far = np.clip(data.states.elapsed, 0.0, 1.0)
        if p["lag"] > 0.0:
            lags = data.states.time_span / p["lag"]
            so_far = np.expm1(-lags * so_far) / np.expm1(-lags)
        for name in TANGENTIAL_FORCES:
            if name in state.forces:
                state.forces[name] = state.forces[name] + p[name] * so_far
