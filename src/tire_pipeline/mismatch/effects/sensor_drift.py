"""A force channel whose zero moves over time."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State


class SensorDrift(Effect):
    """An offset that grows with time, at every slip and load."""

    name = "sensor_drift"
    kind = "artefact"
    title = "a drifting force channel"
    equation = "F recorded = F + drift (t - t0) / (t1 - t0)"
    source = "load cell or amplifier warming up"
    needs_time = True
    parameters = (
        Parameter("fy", "N", -5000.0, 5000.0, 1.0, output="fy"),
        Parameter("fx", "N", -5000.0, 5000.0, 1.0, output="fx"),
    )
    looks_like = {
        "wear": "wear scales the force and is nothing at zero slip",
        "temperature": "temperature scales the force and is nothing at zero slip",
        "force_offset": "an offset is there from the start",
    }
    experiment = "straight rolling at the start and at the end"
    order = 85

    def outputs(self, state: State, data: object, p: Parameters) -> None:
        """Add the drift."""
        for name in ("fx", "fy"):
            if name in state.forces:
                state.forces[name] = state.forces[name] + p[name] * data.elapsed  # type: ignore[attr-defined]
