"""Compliance: the wheel turns under the forces on it."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State


class Compliance(Effect):
    """The side force turns the wheel, and so does a drive or brake force beside it.

    Covers lateral and longitudinal force steer. Not covered: steer by the aligning moment, which is in
    proportion to the side force until the tire slides, and camber by the side force, whose thrust is about
    a tenth of what the same angle of steer makes.
    """

    name = "compliance"
    title = "compliance of suspension or rig"
    equation = "slip angle at the wheel = recorded slip angle - steer Fy - steer_by_fx Fx"
    source = "Milliken and Milliken, Race Car Vehicle Dynamics, ch. 23 (lateral, longitudinal force steer)"
    own_inputs = True
    scales = True
    steepens = True
    needed = ("steer",)
    parameters = (
        Parameter("steer", "rad/N", -5e-5, 5e-5, 1e-8),
        Parameter("steer_by_fx", "rad/N", -2e-5, 2e-5, 1e-8),
    )
    looks_like = {
        "stiffness_scale": "a stiffness factor is the same at every load",
        "crosstalk": "crosstalk is there without a side force too, and where the tire slides",
        "relaxation_length": "relaxation needs slip that changes",
    }
    experiment = "small-slip sweeps at three loads or more, one with brakes; or measure the toe at the wheel"
    order = 20

    def free(self, data: object, start: Parameters) -> tuple[str, ...]:
        """Without a drive or brake force beside a slip angle nothing is known of what that does."""
        return ("steer", "steer_by_fx") if data.has_combined else ("steer",)  # type: ignore[attr-defined]

    def inputs(self, state: State, data: object, p: Parameters) -> None:
        """Turn the wheel by the forces that then act."""
        turned = data.turned_by_force  # type: ignore[attr-defined]
        state.slip_angle = turned(state.slip_angle, p["steer"], p["steer_by_fx"])
