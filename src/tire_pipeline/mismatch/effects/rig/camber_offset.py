"""The camber channel is off by a constant."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class CamberOffset(Effect):
    """The camber thrust is there at recorded camber zero.

    Covers a constant of the channel. Not covered: a gain of it, which is a camber that the model answers to
    otherwise (camber), and an offset where the model does not answer to camber.
    """

    name = "camber_offset"
    kind = "artefact"
    title = "an offset of the camber"
    equation = "camber = recorded camber - offset"
    source = "alignment of the rig"
    wrong_channel = "camber"
    family = "side"
    prior_source = "Judged: a wheel is set up to about a degree"
    parameters = (Parameter("offset", "rad", -0.15, 0.15, 0.0005, prior=0.02),)
    looks_like = {
        "plysteer_conicity": "conicity does not change stiffness with camber",
        "camber": "the effect of camber is nothing at camber zero",
        "slip_angle_offset": "camber thrust is there where the tire slides, too",
    }
    experiment = "record the same sweep at camber of both signs"
    order = 10

    def absent(self, data: Context) -> str | None:
        """Ask for a model that knows camber."""
        if not data.nominal.knows_camber:
            return "the model does not answer to camber"
        return super().absent(data)

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take the offset off."""
        state.camber = state.camber - p["offset"]
