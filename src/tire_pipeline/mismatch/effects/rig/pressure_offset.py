"""The channel of the inflation pressure is off by a constant: absolute pressure that was read as gauge."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class PressureOffset(Effect):
    """The tire is at another pressure than the one that was recorded, by the same everywhere.

    Covers a constant of the channel, of either sign: an absolute pressure where the file means gauge, or the
    other way round, and a sensor whose zero was missed. Not covered: a gain of it, and a file that does not
    answer to pressure, for which another pressure is another friction and stiffness.
    """

    name = "pressure_offset"
    kind = "artefact"
    title = "an offset of the pressure channel, as of an absolute pressure that was read as gauge"
    equation = "p = recorded p - offset"
    source = "an atmosphere between absolute and gauge pressure (ISO 2533: 101.325 kPa)"
    wrong_channel = "pressure"
    used = ("pressure",)
    family = "pressure"
    prior_source = (
        "One atmosphere between absolute and gauge pressure is the commonest offset, and the largest"
    )
    parameters = (Parameter("offset", "Pa", -5e5, 5e5, 100.0, prior=1e5),)
    looks_like = {
        "inflation_pressure": "a tire that answers otherwise to pressure is right at the file's pressure",
        "stiffness_scale": "another stiffness is the same at every pressure and load",
    }
    experiment = (
        "look what the pressure channel says with the valve open, and whether the file means gauge pressure"
    )
    order = 8

    def absent(self, data: Context) -> str | None:
        """Ask for a model that answers to pressure."""
        why = super().absent(data)
        if why is None and not data.nominal.knows_pressure:
            return "the model does not answer to pressure"
        return why

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take the offset off; a tire without pressure carries no load."""
        if state.pressure is not None:
            state.pressure = np.maximum(state.pressure - p["offset"], 0.0)
