"""The forces come late against the slips: buses, buffers, clocks."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.shared import LONGEST_DELAY, delayed


class TimeDelay(Effect):
    """One time shift, the same at every speed and frequency.

    Covers one shift of all forces against all slips, late or early. Not covered: shifts between the slips,
    or between the forces, and clocks that drift apart.
    """

    name = "time_delay"
    kind = "artefact"
    title = "a time delay between slip and force channels"
    equation = "F recorded (t) = F(t - delay)"
    source = "unsynchronised acquisition"
    needs_time = True
    dynamic = True
    family = "lag"
    prior_source = "Judged: channels of one rig are a few samples of a slow logger apart"
    parameters = (Parameter("delay", "s", -LONGEST_DELAY, LONGEST_DELAY, 0.004, prior=0.05),)
    looks_like = {
        "relaxation_length": "the lag of relaxation is shorter at speed",
        "low_pass": "a filter takes amplitude at high frequency",
    }
    experiment = "the same slip-angle sine at two speeds; or tap the load cell and look at both channels"
    order = 95

    def starts(self, data: object) -> list[dict[str, float]]:
        """Late by little or much, or early."""
        return [{"delay": d} for d in (0.02, 0.08, -0.03)]

    def outputs(self, state: State, data: object, p: Parameters) -> None:
        """Shift the forces."""
        for name in ("fx", "fy"):
            if name in state.forces:
                state.forces[name] = delayed(data.time, state.forces[name], p["delay"], data.start)  # type: ignore[attr-defined]
