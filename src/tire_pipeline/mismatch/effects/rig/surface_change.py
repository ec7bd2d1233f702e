"""Another surface from a moment on, or gradually."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import safe_log1p

_STEP_SECONDS = 0.2
"""s over which friction steps, so that the moment can be refined."""
_LONGEST_GAP = 0.5
"""Part of the time from begin to end: a steady change is not told from a step in a longer gap."""


class SurfaceChange(Effect):
    """Friction changes at one moment, or gradually, and stays.

    Covers one step for both forces, and one steady change over the whole recording, as rubber or dust is
    laid down. Not covered: a way back, several patches, and a change over a part of the recording.
    """

    name = "surface_change"
    title = "another surface from a moment on, or gradually"
    equation = "friction *= 1 + friction clip((t - moment) / duration + 1/2, 0, 1)"
    source = "a step of LMUX = LMUY in time"
    needs_time = True
    scanned = ("moment",)
    stepped = ("moment",)
    family = "slow"
    prior_source = "Judged: dry surfaces differ by 10 to 20%, as LMUX and LMUY are set between rig and road"
    parameters = (
        Parameter("friction", "1", -0.8, 1.0, 0.01, prior=0.15),
        Parameter("moment", "s", -1e12, 1e12, 0.05, form=True),
        Parameter("duration", "s", _STEP_SECONDS, 1e12, 0.05, form=True),
    )
    looks_like = {
        "friction_scale": "a friction factor holds from the start",
        "temperature": "temperature goes back when the tire rests",
        "wear": "wear grows with friction work, a surface changes while the tire rests, too",
    }
    experiment = "drive back onto the first surface"
    order = 40

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Try steps over the whole recording, and a steady change from its begin to its end.

        A step in a long gap between two pieces would look the same.
        """
        first, last = data.time_line[0], data.time_line[-1]
        forms = [(m, _STEP_SECONDS) for m in np.linspace(first, last, 26)[1:-1]]
        if np.max(np.diff(data.time_line)) < _LONGEST_GAP * (last - first):
            forms.append((0.5 * (first + last), last - first))
        return [{"friction": 0.0, "moment": float(m), "duration": float(d)} for m, d in forms]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Friction, and the moment of a step; a steady change lasts the whole recording."""
        return ("friction", "moment") if start["duration"] <= _STEP_SECONDS else ("friction",)

    def outside(self, data: Context, p: Parameters) -> bool:
        """Ask for a twentieth of the recording before and after: at its ends it is something that settles."""
        first, last = data.time_line[0], data.time_line[-1]
        edge = 0.05 * (last - first)
        return bool(not first + edge < p["moment"] < last - edge)

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Change the friction."""
        ramp = np.clip((data.time_line - p["moment"]) / max(p["duration"], _STEP_SECONDS) + 0.5, 0.0, 1.0)
        state.log_friction = state.log_friction + safe_log1p(p["friction"] * ramp)
