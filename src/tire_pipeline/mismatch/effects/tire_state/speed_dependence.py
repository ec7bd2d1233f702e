"""Speed: friction falls with sliding speed."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import safe_log1p


class SpeedDependence(Effect):
    """The model is right at one speed and wrong at others.

    Covers friction and stiffness that change with the wheel's speed, and friction that falls with the speed
    at which the tread slides (LMUV), so that it shows at large slip only. The modulus of filled rubber grows
    with frequency by a power of 0.05 to 0.1, and a tire's stiffness grows with speed by no more. Not covered:
    one peak of friction over sliding speed at a single wheel speed, which is the shape of the curve, and
    centrifugal growth.
    """

    name = "speed_dependence"
    title = "speed"
    equation = (
        "d = ln(v / v0), or (v - v0) / v0 where `linear` is 1; friction *= 1 + friction "
        "d - sliding s (v - v0) / v0; stiffness *= 1 + stiffness d; s^2 = tan^2(slip angle) + slip_ratio^2"
    )
    source = (
        "MF 6.1: LMUV (mu / (1 + LMUV Vs / V0)); Savkoor 1966 on friction and sliding speed; "
        "Ferry 1980, Viscoelastic Properties of Polymers, on modulus and frequency"
    )
    channels = ("speed",)
    family = "speed"
    prior_source = (
        "LMUV of MF 6.1 is some hundredths to tenths; the modulus of filled rubber grows by some "
        "percent for each e-fold of the frequency (Ferry 1980)"
    )
    parameters = (
        Parameter("friction", "1", -0.4, 0.4, 0.01, prior=0.1),
        Parameter("stiffness", "1", -0.12, 0.12, 0.01, prior=0.04),
        Parameter("sliding", "1", -2.0, 5.0, 0.05, further=True, prior=0.5),
        Parameter("linear", "0 or 1", 0.0, 1.0, 0.1, form=True),
    )
    looks_like = {
        "temperature": "temperature lags behind a change of speed",
        "relaxation_length": "relaxation needs slip that changes",
    }
    experiment = "record the same sweep at three speeds, with pauses to cool"
    order = 40

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Return the logarithmic and the linear form."""
        zero = self.zeros(data)
        return [zero, {**zero, "linear": 1.0}]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Return friction and stiffness, and friction by sliding speed; the form is one of the two."""
        return ("friction", "stiffness", "sliding")

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Scale friction and stiffness with speed."""
        d = data.nominal.speed_excess
        if p["linear"] < 0.5:
            d = np.log(np.maximum(1.0 + d, 0.02))
        slides = np.hypot(np.tan(np.clip(state.slip_angle, -1.4, 1.4)), state.slip_ratio)
        faster = slides * data.nominal.speed_excess
        state.log_friction = state.log_friction + safe_log1p(p["friction"] * d - p["sliding"] * faster)
        state.log_stiffness = state.log_stiffness + safe_log1p(p["stiffness"] * d)
