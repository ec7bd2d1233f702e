"""The slip-ratio channel is off by a constant: it was computed with a rolling radius that is wrong."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class SlipRatioOffset(Effect):
    """The curve of the longitudinal force is moved along the slip axis.

    Covers a constant: slip ratio = omega R / v - 1 with a radius that is wrong by a factor is off by nearly
    the same everywhere. Not covered: a radius that changes with load or speed, and rolling resistance.
    """

    name = "slip_ratio_offset"
    kind = "artefact"
    title = "an offset of the slip ratio"
    equation = "slip ratio = recorded slip ratio - offset"
    source = (
        "effective rolling radius (Pacejka, Tire and Vehicle Dynamics, 3rd ed., 1.2); wheel and road speed"
    )
    wrong_channel = "slip_ratio"
    channels = ("slip_ratio",)
    family = "side"
    prior_source = "Judged: a rolling radius is known to about one percent"
    parameters = (Parameter("offset", "1", -0.15, 0.15, 0.0005, prior=0.01),)
    looks_like = {
        "force_offset": "a force offset shows where the tire slides, too",
        "crosstalk": "a leak of another force does not move the curve along the slip",
        "combined_slip": "the weighting of combined slip is nothing at pure slip",
    }
    experiment = "record free rolling, then brake and drive to full sliding"
    order = 10

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take the offset off."""
        state.slip_ratio = state.slip_ratio - p["offset"]
