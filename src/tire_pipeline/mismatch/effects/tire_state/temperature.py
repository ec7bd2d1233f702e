"""Tread temperature: friction has an optimum, stiffness falls as the rubber warms."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import TOO_SMALL_TO_SEE, Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import safe_log1p

_WARMER = 25.0
"""degC above the warmest of the recording."""
_USUALLY_OFF = 15.0
"""degC by which the temperature of the file's own test is usually off the middle of a recording."""
_AROUND_BLIND = 0.6
"""The same in the unit of the integrated heat, whose 90% quantile is 1."""


class Temperature(Effect):
    """Friction and stiffness follow the tread temperature, measured or integrated.

    Covers friction with an optimum, and stiffness, for both forces alike; without a channel one mass that
    warms by friction power with a lag of 1 to 300 s, as treads do, and changes all of these or friction
    alone. Not covered: temperatures across the tread, a carcass with a lag of its own, and heat that comes
    from the road or the brakes.
    """

    name = "temperature"
    title = "tread temperature"
    equation = (
        "d = (T - reference) / 50 degC; friction *= 1 + friction d - curvature d^2; "
        "stiffness *= 1 + stiffness d. "
        "Without a temperature channel d = (1 + (lag / duration)^2)^0.5 h / P90 - reference, "
        "dh/dt = (P - h) / lag, P friction power, P90 its 90% quantile in the recording"
    )
    source = (
        "Sorniotti 2009, SAE 2009-01-0441; Mizuno et al. 2005, VSD 43 (suppl.): "
        "temperature in the Magic Formula"
    )
    family = "slow"
    prior_source = "Sorniotti 2009 and Mizuno et al. 2005: tenths for each 50 degC"
    parameters = (
        Parameter("friction", "1", -0.8, 0.8, 0.01, prior=0.15),
        Parameter("curvature", "1", 0.0, 0.8, 0.01, prior=0.15),
        Parameter("stiffness", "1", -1.0, 1.0, 0.01, prior=0.2),
        Parameter("reference", "degC or 1", -1.0, 200.0, 0.02, form=True),
        Parameter("lag", "s", 1.0, 300.0, 0.2, form=True),
    )
    looks_like = {
        "wear": "wear never goes back; temperature does, when the tire rests",
        "sensor_drift": "drift is there at zero slip too",
        "surface_change": "a surface changes at once, or while the tire rests, too",
        "friction_scale": "a friction factor does not change over time",
    }
    experiment = "repeat the first sweep after cooling: temperature comes back, wear does not"
    order = 40

    def absent(self, data: Context) -> str | None:
        """Ask for a temperature channel, or for time to integrate one."""
        if data.varies("tread_temperature"):
            return None
        if data.has("tread_temperature"):
            return "the tread temperature does not vary"
        if data.time is None:
            return "neither tread temperature nor time is recorded"
        if data.states.power is None:
            return "no speed, so that friction power is not known"
        return None

    def lacking(self, data: Context) -> list[str]:
        """Return the temperature, or what friction power is made of where the effect was found without it."""
        needed = "speed" if self.blind(data) else "tread_temperature"
        lost = [] if data.has(needed) else [needed]
        if needed == "tread_temperature":
            return lost
        return [*lost, "time"] if data.time is None else lost

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Several references (where the model is right); several lags and two forms if there is no channel.

        The last reference is warmer than the recording: a tire may be measured warm and recorded cold. The
        last lag is much longer than it: a tire may keep its heat. A heat that nobody measured may change
        friction alone, as wear and another surface do.
        """
        friction = {"friction": 0.0, "curvature": 0.0, "stiffness": 0.0}
        every = {"friction": 0.0, "curvature": TOO_SMALL_TO_SEE, "stiffness": TOO_SMALL_TO_SEE}
        if data.varies("tread_temperature"):
            t = data.smooth("tread_temperature")
            points = [*np.quantile(t, [0.02, 0.5, 0.95]), np.max(t) + _WARMER]
            return [{**every, "reference": float(v), "lag": 10.0} for v in points]
        lags = [8.0, 20.0, 50.0, min(3.0 * data.states.time_span, 250.0)]
        places = [{"reference": r, "lag": lag} for lag in lags for r in (0.0, 0.5, 1.2)]
        return [{**form, **place} for form in (friction, every) for place in places]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Friction alone, or an optimum of it and stiffness, too; and what the channel does not say."""
        more = ("curvature", "stiffness") if start["stiffness"] else ()
        return ("friction", *more, "reference", *(("lag",) if self.blind(data) else ()))

    def usual(self, data: Context, name: str) -> tuple[float, float]:
        """Place the reference, at which the model is right, near the middle of the recording."""
        if name != "reference":
            return super().usual(data, name)
        if self.blind(data):
            return 0.5, _AROUND_BLIND
        return float(np.median(data.smooth("tread_temperature"))), _USUALLY_OFF

    def same_to_data(self, data: Context, p: Parameters) -> tuple[str, str] | None:
        """A file that is right at no temperature of the recording is off throughout, as another tire is."""
        felt = self._felt(data, p)
        if np.min(felt) < p["reference"] < np.max(felt):
            return None
        return "a tire with another friction and another slip stiffness at every temperature", "physics"

    def drivers(self, output: str) -> tuple[str, ...]:
        """Return the temperature; where it is not recorded, the effect is placed in time."""
        return ("tread_temperature",)

    def blind(self, data: Context) -> bool:
        """Without a temperature channel, now or where the effect was found."""
        return "tread_temperature" not in data.measured

    def other_forms(self, data: Context, p: Parameters) -> list[dict[str, float]]:
        """Without a channel: a tire has more masses than one, which warm faster and slower."""
        if not self.blind(data):
            return []
        return [{**p, "lag": p["lag"] * factor} for factor in (3.0, 1.0 / 3.0)]

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Scale friction and stiffness."""
        d = self._felt(data, p) - p["reference"]
        d = d if self.blind(data) else d / 50.0
        change = p["friction"] * d - p["curvature"] * d**2
        state.log_friction = state.log_friction + safe_log1p(change)
        state.log_stiffness = state.log_stiffness + safe_log1p(p["stiffness"] * d)

    def _felt(self, data: Context, p: Parameters) -> np.ndarray:
        """Temperature, degC, or the integrated heat where no channel has it."""
        return data.states.heat(p["lag"]) if self.blind(data) else data.smooth("tread_temperature")
