"""The forces are late relative to the slips: buses, buffers, clocks."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import delayed


class TimeDelay(Effect):
    """One time shift, the same at every speed and frequency.

    Covers one shift of all forces and moments against all slips, late or early. Not covered: shifts between
    the slips, or between the forces, and clocks that drift apart.
    """

    name = "time_delay"
    kind = "artefact"
    title = "a time delay between slip and force channels"
    equation = "F recorded (t) = F(t - delay)"
    source = "unsynchronised acquisition"
    needs_time = True
    dynamic = True
    family = "lag"
    prior_source = "Judged: channels of one rig are two samples apart, of the file or of a slow logger"
    parameters = (Parameter("delay", "s", -2.0, 2.0, 0.004, prior=2.0, prior_in="sampling"),)
    looks_like = {
        "relaxation_length": "the lag of relaxation is shorter at speed",
        "low_pass": "a filter takes amplitude at high frequency",
    }
    experiment = "record the same slip-angle sine at two speeds; or tap the load cell and compare channels"
    order = 95

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Late by little or much, or early."""
        sampling = data.sampling
        return [{"delay": d} for d in (0.02, 0.08, -0.03, 2.0 * sampling, 5.0 * sampling)]

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Shift the forces."""
        for name, force in state.forces.items():
            state.forces[name] = delayed(data.time_line, force, p["delay"], data.start)

    moments = outputs
