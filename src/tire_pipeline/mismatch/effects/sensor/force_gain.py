"""A force channel that reads too high or too low by a factor."""

from __future__ import annotations

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import GAINS


class ForceGain(Effect):
    """Peak and slope move by the same factor, in one channel or both.

    Covers a constant factor for each force. Not covered: a load cell that is not linear. A gain of
    the normal load is load_gain.
    """

    name = "force_gain"
    kind = "artefact"
    title = "a wrong gain of a force channel"
    equation = "F recorded = (1 + gain) F"
    source = "load cell calibration"
    family = "scale"
    prior_source = "Judged: a gain is wrong by some percent, or by a whole unit, which is found without a fit"
    parameters = (
        Parameter("fy", "1", *GAINS, 0.01, output="fy", prior=0.1),
        Parameter("fx", "1", *GAINS, 0.01, output="fx", prior=0.1),
    )
    looks_like = {
        "friction_scale": "friction leaves the slope at zero slip as it is",
        "unit_error": "a wrong unit is an exact ratio",
    }
    experiment = "hang a known weight on the load cell; or one sweep to full sliding"
    order = 84

    def same_to_data(self, data: Context, p: Parameters) -> tuple[str, str] | None:
        """Friction and stiffness times one factor are the force times it, by similarity (Pacejka, 4.2.1)."""
        return "a tire with friction and slip stiffness off by the same factor", "physics"

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Gains of the forces that move."""
        return tuple(n for n in data.outputs if data.simulation.driven(n))

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Scale the forces."""
        for name in TANGENTIAL_FORCES:
            if name in state.forces:
                state.forces[name] = state.forces[name] * (1.0 + p[name])
