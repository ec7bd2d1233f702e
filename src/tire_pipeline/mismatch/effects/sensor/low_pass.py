"""The force channels went through a filter that the slip channels did not."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import first_order


class LowPass(Effect):
    """First-order low pass: amplitude falls and phase lags with frequency.

    Covers one filter for all forces and moments; one of higher order is the same below its corner, where
    its lag counts. Not covered: filters that differ between the forces, resonance of the rig, and filters of
    the slip channels.
    """

    name = "low_pass"
    kind = "artefact"
    title = "a low-pass filter on the force channels"
    equation = "lag dF'/dt + F' = F, F recorded = F'"
    source = "amplifier or acquisition filter"
    needs_time = True
    dynamic = True
    family = "lag"
    prior_source = "Judged: filters of force channels end at 1 to 30 Hz"
    parameters = (Parameter("lag", "s", 0.0, 2.0, 0.004, prior=0.1),)
    looks_like = {
        "relaxation_length": "the lag of relaxation is shorter at speed",
        "time_delay": "a delay keeps the amplitude",
    }
    experiment = "record the same slip-angle sine at two speeds, up to where its amplitude falls"
    order = 94

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Three lags: of a filter, of a slow one, and of something that is late."""
        return [{"lag": lag} for lag in (0.02, 0.1, 0.6)]

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Filter the forces."""
        if p["lag"] <= 0.0:
            return
        step = data.step / p["lag"]
        for name, force in state.forces.items():
            state.forces[name] = first_order(force, step, data.start)

    moments = outputs
