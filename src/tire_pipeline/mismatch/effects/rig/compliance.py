"""Compliance: the wheel turns under the forces on it."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class Compliance(Effect):
    """The side force turns the wheel, and so does a drive or brake force beside it.

    Covers lateral and longitudinal force steer, by the angle at a force as large as the nominal load: wheels
    of all sizes turn by some tenths of a degree. Not covered: steer by the aligning moment, which is in
    proportion to the side force until the tire slides, and camber by the side force, whose thrust is about
    a tenth of what the same angle of steer makes.
    """

    name = "compliance"
    title = "compliance of suspension or rig"
    equation = "slip angle at the wheel = recorded slip angle - steer Fy / Fz0 - steer_by_fx Fx / Fz0"
    source = "Milliken and Milliken, Race Car Vehicle Dynamics, ch. 23 (lateral, longitudinal force steer)"
    needed = ("steer",)
    family = "scale"
    prior_source = (
        "Milliken and Milliken, ch. 23: some tenths of a degree for each kN of side force; "
        "widened to a degree at the nominal load"
    )
    parameters = (
        Parameter("steer", "rad", -0.2, 0.2, 4e-5, prior=0.015),
        Parameter("steer_by_fx", "rad", -0.08, 0.08, 4e-5, prior=0.01),
    )
    looks_like = {
        "stiffness_scale": "a stiffness factor is the same at every load",
        "crosstalk": "crosstalk is there without a side force too, and where the tire slides",
        "relaxation_length": "relaxation needs slip that changes",
    }
    experiment = "record small-slip sweeps at three loads or more, one with brakes; or measure the toe"
    order = 20

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Without a drive or brake force beside a slip angle nothing is known of what that does."""
        return ("steer", "steer_by_fx") if data.has_combined else ("steer",)

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Turn the wheel by the forces that then act."""
        load = data.nominal.load
        turned = data.simulation.turned_by_force
        state.slip_angle = turned(state.slip_angle, p["steer"] / load, p["steer_by_fx"] / load)
