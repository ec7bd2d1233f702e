"""Compliance: the wheel turns under the forces on it."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import TOO_SMALL_TO_SEE, Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class Compliance(Effect):
    """The side force turns the wheel, and so does a drive or brake force beside it; or the load does.

    Covers lateral and longitudinal force steer, by the angle at a force as large as the nominal load: wheels
    of all sizes turn by some tenths of a degree. Or steer by the load, as by the travel of a suspension. Not
    covered: steer by the aligning moment, which is in proportion to the side force until the tire slides, and
    camber by the side force, whose thrust is about a tenth of what the same angle of steer makes.
    """

    name = "compliance"
    title = "compliance of suspension or rig"
    equation = (
        "slip angle at the wheel = recorded slip angle - steer Fy / Fz0 - steer_by_fx Fx / Fz0, or "
        "- steer_by_load (Fz - Fz0) / Fz0"
    )
    source = "Milliken and Milliken, Race Car Vehicle Dynamics, ch. 23: steer by forces and by ride"
    needed = ("steer", "steer_by_load")
    family = "scale"
    prior_source = (
        "Milliken and Milliken, ch. 23: some tenths of a degree for each kN of side force; "
        "widened to a degree at the nominal load"
    )
    parameters = (
        Parameter("steer", "rad", -0.2, 0.2, 4e-5, prior=0.015),
        Parameter("steer_by_fx", "rad", -0.08, 0.08, 4e-5, prior=0.01),
        Parameter("steer_by_load", "rad", -0.1, 0.1, 4e-5, prior=0.005),
    )
    looks_like = {
        "stiffness_scale": "a stiffness factor is the same at every load",
        "plysteer_conicity": "conicity shows where the tire slides, too",
        "crosstalk": "crosstalk is there without a side force too, and where the tire slides",
        "relaxation_length": "relaxation needs slip that changes",
    }
    experiment = "record small-slip sweeps at three loads or more, one with brakes; or measure the toe"
    order = 20

    def starts(self, data: Context) -> list[dict[str, float]]:
        """By the tangential forces, and by a load that varies."""
        zero = self.zeros(data)
        return [zero, {**zero, "steer_by_load": TOO_SMALL_TO_SEE}] if data.varies("normal_load") else [zero]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Without a drive or brake force beside a slip angle nothing is known of what that does."""
        if start["steer_by_load"]:
            return ("steer_by_load",)
        return ("steer", "steer_by_fx") if data.has_combined else ("steer",)

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Turn the wheel by the forces that then act."""
        load = data.nominal.load
        state.slip_angle = state.slip_angle - p["steer_by_load"] * (state.normal_load / load - 1.0)
        if not (p["steer"] or p["steer_by_fx"]):
            return
        turned = data.simulation.turned_by_force
        state.slip_angle = turned(state.slip_angle, p["steer"] / load, p["steer_by_fx"] / load)
