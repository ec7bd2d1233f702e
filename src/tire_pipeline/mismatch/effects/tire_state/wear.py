"""Wear: friction and stiffness change with the friction work done, for good."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import safe_log1p


class Wear(Effect):
    """A change that grows with friction work and does not go back.

    Covers friction and stiffness in proportion to the work so far. Not covered: a rate that changes
    (running in), wear by the load or temperature at the time, and flat spots.
    """

    name = "wear"
    title = "wear"
    equation = (
        "w = friction work so far / all of it; friction *= 1 + friction w; stiffness *= 1 + stiffness w"
    )
    source = "Archard's law with friction power; Grosch 2008, Rubber Chem. Technol. 81"
    needs_time = True
    used = ("speed",)
    family = "slow"
    prior_source = "Judged: a test ends before a tenth of friction is lost"
    parameters = (
        Parameter("friction", "1", -0.5, 0.3, 0.01, prior=0.1),
        Parameter("stiffness", "1", -0.3, 0.8, 0.01, prior=0.15),
    )
    looks_like = {
        "temperature": "temperature goes back when the tire rests",
        "sensor_drift": "drift is there at zero slip too",
        "surface_change": "a surface changes at once, or while the tire rests, too",
    }
    experiment = "repeat the first sweep at the end, after cooling"
    order = 40

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Scale friction and stiffness with the work done."""
        w = data.states.work
        state.log_friction = state.log_friction + safe_log1p(p["friction"] * w)
        state.log_stiffness = state.log_stiffness + safe_log1p(p["stiffness"] * w)
