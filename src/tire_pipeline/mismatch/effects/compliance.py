"""Compliance: the wheel turns under its own side force."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State


class Compliance(Effect):
    """The slip angle at the wheel is smaller than the one that was set, by the force."""

    name = "compliance"
    title = "compliance of suspension or rig"
    equation = "slip angle at the wheel = recorded slip angle - steer Fy"
    source = "Milliken and Milliken, Race Car Vehicle Dynamics, ch. 23 (deflection steer)"
    own_inputs = True
    scales = True
    parameters = (Parameter("steer", "rad/N", -5e-5, 5e-5, 1e-8),)
    looks_like = {
        "stiffness_scale": "a stiffness factor is the same at every load",
        "relaxation_length": "relaxation needs slip that changes",
    }
    experiment = "small-slip sweeps at three loads or more; or measure the toe at the wheel"
    order = 20

    def inputs(self, state: State, data: object, p: Parameters) -> None:
        """Turn the wheel by the force that then acts."""
        state.slip_angle = data.turned_by_force(state.slip_angle, p["steer"])  # type: ignore[attr-defined]
