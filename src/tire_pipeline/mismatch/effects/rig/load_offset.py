"""The channel of the normal load is off by a constant: the weight of the hub, or a zero that was missed."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class LoadOffset(Effect):
    """Peak and slope are off by the more of themselves the smaller the load is.

    Covers a constant of the channel, where the load varies: at one load it is a gain. Not covered: a drift of
    the zero, and a lag of the load behind the forces.
    """

    name = "load_offset"
    kind = "artefact"
    title = "an offset of the normal load"
    equation = "Fz = recorded Fz - offset"
    source = "load cell zero; weight of hub and wheel"
    wrong_channel = "normal_load"
    channels = ("normal_load",)
    family = "scale"
    prior_source = "Judged, as for the force channels: load cells come back to some percent of the load"
    parameters = (Parameter("offset", "N", -5000.0, 5000.0, 1.0, prior=0.03, prior_in="load_nominal"),)
    looks_like = {
        "load_gain": "a gain is the same at every load",
        "load_sensitivity": "another change with load leaves the nominal load as it is",
        "crosstalk": "a leak of the load is there without slip, too",
    }
    experiment = "look at the load channel with the wheel lifted"
    order = 8

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take the offset off; a wheel does not pull at the road."""
        state.normal_load = np.maximum(state.normal_load - p["offset"], 0.0)
