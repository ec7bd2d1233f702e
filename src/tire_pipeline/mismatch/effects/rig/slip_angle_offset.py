"""The slip-angle channel is off by a constant: the wheel was not straight at zero."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class SlipAngleOffset(Effect):
    """The force curve is moved along the slip axis.

    Covers a constant of the channel. Not covered: a gain of it (stiffness_scale is the same to the data),
    and an offset of the slip ratio, which a wrong rolling radius makes.
    """

    name = "slip_angle_offset"
    kind = "artefact"
    title = "an offset of the slip angle"
    equation = "slip angle = recorded slip angle - offset"
    source = "alignment of rig or optical sensor"
    wrong_channel = "slip_angle"
    family = "side"
    prior_source = "Judged: an angle is zeroed to about half a degree"
    parameters = (Parameter("offset", "rad", -0.15, 0.15, 0.0005, prior=0.01),)
    looks_like = {
        "plysteer_conicity": (
            "conicity shows where the tire slides, too; ply steer is told apart by turning the tire round"
        ),
        "force_offset": "a force offset shows where the tire slides, too",
    }
    experiment = "record a sweep to full sliding on both sides; turn the tire on its rim"
    order = 10

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take the offset off."""
        state.slip_angle = state.slip_angle - p["offset"]
