"""Another surface or tire from a moment on, or a surface that changes gradually, as it dries."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import TOO_SMALL_TO_SEE, Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import safe_log1p, settling_lags

_STEP_SECONDS = 0.2
"""s over which friction steps, so that the moment can be refined."""
_LONGEST_GAP = 0.5
"""Part of the time from begin to end: a steady change is not told from a step in a longer gap."""


class SurfaceChange(Effect):
    """Friction changes at one moment, or gradually, and stays; at one moment stiffness may change as well.

    Covers one step for both forces, one steady change over the whole recording, and one that is fast at
    first and settles, as a wet track dries or rubber is laid down. A step of stiffness, too, is another tire,
    or the same one mounted anew. The model is right before the change; where one settles, before or after it,
    as the file may be of the wet surface or of the dry one. Not covered: a way back, several patches, and a
    change over a part of the recording.
    """

    name = "surface_change"
    title = "another surface or tire from a moment on, or a surface that changes gradually"
    equation = (
        "friction *= 1 + friction (g - after); stiffness *= 1 + stiffness (g - after); "
        "g = clip((t - moment) / duration + 1/2, 0, 1), or with a lag g = 1 - exp(-(t - t0) / lag), t0 the "
        "begin; `after` is 1 where the model is right after the change"
    )
    source = (
        "a step of LMUX = LMUY in time, for another tire of LKX = LKY, too; a film of water dries at a rate "
        "in proportion to what is left"
    )
    needs_time = True
    scanned = ("moment",)
    stepped = ("moment",)
    family = "slow"
    prior_source = (
        "Judged: dry surfaces differ by 10 to 20%, as LMUX and LMUY are set between rig and road; tires "
        "of one size differ by about a quarter in stiffness"
    )
    parameters = (
        Parameter("friction", "1", -0.8, 1.0, 0.01, prior=0.15),
        Parameter("stiffness", "1", -0.7, 1.5, 0.01, further=True, prior=0.25),
        Parameter("moment", "s", -1e12, 1e12, 0.05, form=True),
        Parameter("duration", "s", _STEP_SECONDS, 1e12, 0.05, form=True),
        Parameter("lag", "s", 0.0, 1e12, 0.5, form=True),
        Parameter("after", "0 or 1", 0.0, 1.0, 0.1, form=True),
    )
    looks_like = {
        "friction_scale": "a friction factor holds from the start",
        "temperature": "temperature goes back when the tire rests",
        "wear": "wear grows with friction work, a surface changes while the tire rests, too",
    }
    experiment = "drive back onto the first surface"
    order = 40

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Try steps over the whole recording, and changes from its begin to its end: steady, and settling.

        A step in a long gap between two pieces would look like a steady change. One that settles does so
        within a twelfth or a third of the recording.
        """
        first, last = data.time_line[0], data.time_line[-1]
        span = last - first
        moments = np.linspace(first, last, 26)[1:-1]
        steps = [{"moment": float(m), "duration": _STEP_SECONDS} for m in moments]
        forms = [*steps, *({**s, "stiffness": TOO_SMALL_TO_SEE} for s in steps)]
        if np.max(np.diff(data.time_line)) < _LONGEST_GAP * span:
            whole = {"moment": float(0.5 * (first + last)), "duration": float(span)}
            settling = [{**whole, "lag": lag} for lag in settling_lags(float(span))]
            forms += [whole, *settling, *({**s, "after": 1.0} for s in settling)]
        zero = self.zeros(data)
        return [{**zero, **form} for form in forms]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Friction, the moment of a step and its stiffness, or the lag; a gradual change lasts throughout."""
        if start["duration"] > _STEP_SECONDS:
            return ("friction", "lag") if start["lag"] else ("friction",)
        return ("friction", "stiffness", "moment") if start["stiffness"] else ("friction", "moment")

    def usual(self, data: Context, name: str) -> tuple[float, float]:
        """Let a change settle within the recording: one that is far slower is none, but another friction."""
        centre, width = super().usual(data, name)
        return (0.5 * data.states.time_span if name == "lag" else centre), width

    def outside(self, data: Context, p: Parameters) -> bool:
        """Ask for a tenth of the recording before and after: at its ends it is something that settles."""
        return p["moment"] != self._moment(data, p)

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Change the friction, and the stiffness."""
        ramp = np.clip(
            (data.time_line - self._moment(data, p)) / max(p["duration"], _STEP_SECONDS) + 0.5, 0.0, 1.0
        )
        if p["lag"] > 0.0:
            ramp = -np.expm1(-ramp * p["duration"] / p["lag"])
        g = ramp - p["after"]
        state.log_friction = state.log_friction + safe_log1p(p["friction"] * g)
        state.log_stiffness = state.log_stiffness + safe_log1p(p["stiffness"] * g)

    def _moment(self, data: Context, p: Parameters) -> float:
        """Return the moment, within the recording: a step at its first or last sample is a constant.

        That is another friction or stiffness, and has its own names.
        """
        span = data.states.time_span
        begin = data.time_line[0] - data.states.elapsed[0] * span
        return float(np.clip(p["moment"], begin + 0.1 * span, begin + 0.9 * span))
