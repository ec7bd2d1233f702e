"""Lateral load transfer: the two wheels of an axle carry different loads in a turn."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class AxleLoadTransfer(Effect):
    """The mean of an axle's two wheels is compared with one tire, but in a turn one wheel carries more.

    Covers what that does to the forces: friction and slip stiffness over load fall with load, so the mean of
    two loads gives less force than the mean load. The load that an axle takes over depends on how the roll
    stiffness is shared between the axles: ``share`` is 1 where each takes half. Not covered: camber, toe and
    slip ratios that differ between the wheels.
    """

    name = "axle_load_transfer"
    title = "load transfer between the wheels of the axle"
    equation = (
        "F = (F(Fz + share dFz) + F(Fz - share dFz)) / 2; dFz = m a_y h / (2 t) at each wheel where both "
        "axles take half"
    )
    source = "Milliken and Milliken, Race Car Vehicle Dynamics, ch. 18: lateral load transfer, roll stiffness"
    used = ("load_transfer",)
    family = "scale"
    prior_source = (
        "roll stiffness distributions of cars: 35 to 65% at one axle, a share of 0.7 to 1.3; wide, so "
        "that it is named where it shows"
    )
    parameters = (Parameter("share", "1", 0.0, 2.0, 0.002, prior=1.0),)
    looks_like = {
        "friction_scale": "a friction factor is there at small lateral accelerations, too",
        "load_sensitivity": "another change with load shows while driving straight ahead and braking, too",
    }
    experiment = "drive the same slip angles slowly in a tight circle and fast in a wide one"
    order = 9

    def absent(self, data: Context) -> str | None:
        """Not where one wheel was measured: on a rig, or on a vehicle without the channel."""
        return None if data.has("load_transfer") else "only an axle of a vehicle has it"

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Half at each axle."""
        return [{"share": 1.0}]

    def expected(self, data: Context) -> bool:
        """A model of one tire at the mean load cannot have it."""
        return True

    def drivers(self, output: str) -> tuple[str, ...]:
        """The load, and what the tire makes of it."""
        return ("normal_load",)

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Set the loads of the two wheels apart."""
        state.load_apart = p["share"] * np.abs(data.get("load_transfer"))
