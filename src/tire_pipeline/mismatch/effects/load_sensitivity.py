"""Friction falls with load at another rate than the model says."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.shared import safe_log1p


class LoadSensitivity(Effect):
    """Friction right at one load, wrong above and below it."""

    name = "load_sensitivity"
    title = "another fall of friction with load"
    equation = "m = 1 + rate (Fz - Fz0) / Fz0"
    source = "MF 5.2: mu = PDY1 + PDY2 dfz (thesis, Appendix A); Grosch 1996 on load dependence"
    channels = ("normal_load",)
    own_inputs = True
    scales = True
    parameters = (Parameter("rate", "1", -0.6, 0.6, 0.01),)
    looks_like = {"friction_scale": "a friction factor is the same at every load"}
    experiment = "sweeps to full sliding at four loads or more"
    order = 40
    least_gain = 15.0
    least_beside = 25.0  # false ones have 13 nats alone and 17 beside camber: few loads

    def tire(self, state: State, data: object, p: Parameters) -> None:
        """Scale the friction with load."""
        excess = data.load_excess(state.normal_load)  # type: ignore[attr-defined]
        change = p["rate"] * excess
        state.log_friction = state.log_friction + safe_log1p(change)

    def coefficients(self, tire: object, p: Parameters) -> dict[str, float]:
        """PDX2 and PDY2."""
        c = tire.coefficients  # type: ignore[attr-defined]
        out = {}
        for axis in "XY":
            peak, fall = c.get(f"PD{axis}1", 1.0), c.get(f"PD{axis}2", 0.0)
            out[f"PD{axis}2"] = fall + peak * p["rate"]
        return out
