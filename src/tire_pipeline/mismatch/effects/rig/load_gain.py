"""The channel of the normal load reads too high or too low by a factor."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import GAINS


class LoadGain(Effect):
    """The tire carries another load than the one recorded, so peak and slope move as they do with load.

    Covers a constant factor. Not covered: a load cell that is not linear, and a factor that drifts. Peak and
    slope are nearly proportional to load, so small gains look like one of the force.
    """

    name = "load_gain"
    kind = "artefact"
    title = "a wrong gain of the normal load"
    equation = "Fz recorded = (1 + gain) Fz"
    source = "load cell calibration"
    wrong_channel = "normal_load"
    family = "scale"
    prior_source = "Judged, as for the force channels: a gain is wrong by some percent"
    parameters = (Parameter("gain", "1", *GAINS, 0.01, prior=0.1),)
    looks_like = {
        "force_gain": "a gain of the force is the same at every load, and need not act on both forces",
        "friction_scale": "friction leaves the slope at zero slip as it is",
        "load_sensitivity": "another change with load leaves the nominal load as it is",
    }
    experiment = "hang known weights on the wheel, and compare the load channel with them"
    order = 8

    def same_to_data(self, data: Context, p: Parameters) -> tuple[str, str] | None:
        """At one load an offset of the channel is a factor."""
        return None if data.varies("normal_load") else ("an offset of the normal load", "artefact")

    def misread(self, true: np.ndarray, p: Parameters) -> np.ndarray:
        """Return the recorded load."""
        return true * (1.0 + p["gain"])

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take the gain off."""
        state.normal_load = state.normal_load / (1.0 + p["gain"])
