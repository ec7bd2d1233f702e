"""Another surface from a moment on."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.shared import safe_log1p


class SurfaceChange(Effect):
    """Friction changes at one moment and stays.

    Covers one step for both forces. Not covered: a way back, several patches, and a surface that changes
    gradually (as rubber is laid down), which looks like wear or temperature.
    """

    name = "surface_change"
    title = "another surface from a moment on"
    equation = "friction *= 1 + friction H(t - moment)"
    source = "a step of LMUX = LMUY in time"
    needs_time = True
    scanned = ("moment",)
    stepped = ("moment",)
    family = "slow"
    prior_source = "Judged: dry surfaces differ by 10 to 20%, as LMUX and LMUY are set between rig and road"
    parameters = (
        Parameter("friction", "1", -0.8, 1.0, 0.01, prior=0.15),
        Parameter("moment", "s", -1e12, 1e12, 0.05, form=True, kept=True),
    )
    looks_like = {
        "friction_scale": "a friction factor holds from the start",
        "temperature": "temperature changes gradually",
        "wear": "wear changes gradually",
    }
    experiment = "drive back onto the first surface"
    order = 40

    def starts(self, data: object) -> list[dict[str, float]]:
        """Try moments over the whole recording."""
        first, last = data.time[0], data.time[-1]  # type: ignore[attr-defined]
        return [{"friction": 0.0, "moment": float(m)} for m in np.linspace(first, last, 26)[1:-1]]

    def outside(self, data: object, p: Parameters) -> bool:
        """Ask for a twentieth of the recording before and after: at its ends it is something that settles."""
        first, last = data.time[0], data.time[-1]  # type: ignore[attr-defined]
        edge = 0.05 * (last - first)
        return bool(not first + edge < p["moment"] < last - edge)

    def tire(self, state: State, data: object, p: Parameters) -> None:
        """Step the friction, over 0.2 s so that the moment can be refined."""
        ramp = np.clip((data.time - p["moment"]) / 0.2 + 0.5, 0.0, 1.0)  # type: ignore[attr-defined]
        state.log_friction = state.log_friction + safe_log1p(p["friction"] * ramp)
