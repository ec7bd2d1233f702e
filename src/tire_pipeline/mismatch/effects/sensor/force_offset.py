"""A constant added to a force: the load cell was not zeroed."""

from __future__ import annotations

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class ForceOffset(Effect):
    """The same offset at every slip and load.

    Covers a constant for each force. Not covered: what changes over time is sensor_drift, what changes with
    load crosstalk or conicity. An offset of the normal load is load_offset.
    """

    name = "force_offset"
    kind = "artefact"
    title = "an offset of a force channel"
    equation = "F recorded = F + offset"
    source = "load cell zero"
    family = "side"
    prior_source = "Judged: load cells come back to some percent of the load"
    parameters = (
        Parameter("fy", "N", -5000.0, 5000.0, 1.0, output="fy", prior=0.03, prior_in="load_nominal"),
        Parameter("fx", "N", -5000.0, 5000.0, 1.0, output="fx", prior=0.03, prior_in="load_nominal"),
    )
    looks_like = {
        "plysteer_conicity": "conicity grows with load",
        "slip_angle_offset": "an offset of slip angle does not show where the tire slides",
        "sensor_drift": "drift changes over time",
        "rolling_resistance": "rolling resistance grows with load",
    }
    experiment = "record straight rolling at three loads; read the load cell with the wheel lifted"
    order = 85

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Add the offsets."""
        for name in TANGENTIAL_FORCES:
            if name in state.forces:
                state.forces[name] = state.forces[name] + p[name]
