"""Turn slip: path curvature (spin) makes side force."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import safe_log1p


class TurnSlip(Effect):
    """Side force from path curvature, as in parking or in tight low-speed turns.

    Covers the shift of the slip angle and one loss of friction for both forces. Not covered: loss of
    cornering stiffness (PKYP1, in the square of curvature times radius: below 1% but in parking), and the
    moment. Path curvature cannot raise the friction: every factor zeta of the source is 1 at most.
    """

    name = "turn_slip"
    title = "turn slip (path curvature)"
    equation = "slip_angle += shift turn_slip (m); friction *= 1 - friction_loss |turn_slip| R0"
    source = "Pacejka, 3rd ed., 4.3.3 (PHYP, PDYP of MF 6.1)"
    channels = ("turn_slip",)
    family = "path"
    prior_source = "Judged: half of a contact length to a wheel radius"
    parameters = (
        Parameter("shift", "m", -2.0, 2.0, 0.005, prior=0.5),
        Parameter("friction_loss", "1", 0.0, 3.0, 0.02, prior=0.5),
    )
    looks_like = {"camber": "camber acts on a straight path too"}
    experiment = "record the same slip angles on paths of two radii"
    order = 40

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Shift the slip angle, lower the friction."""
        spin = data.get("turn_slip")
        state.slip_angle = state.slip_angle + p["shift"] * spin
        loss = safe_log1p(-p["friction_loss"] * abs(spin) * data.nominal.radius)
        state.log_friction = state.log_friction + loss
