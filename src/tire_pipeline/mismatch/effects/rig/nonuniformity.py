"""Non-uniformity: a force that comes back once a wheel turn."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import TOO_SMALL_TO_SEE, Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context

_FORCE_PARAMETERS = ("cosine_y", "sine_y", "cosine_x", "sine_x")
_WOBBLE = ("angle_cosine", "angle_sine", "load_cosine", "load_sine")


class Nonuniformity(Effect):
    """A harmonic of the wheel's rotation: a force of its own, or a wobble of slip angle and load.

    Covers the first harmonic of lateral and tangential force, of the angle (lateral run-out) and of the
    load (radial run-out). Not covered: higher harmonics, and resonance that makes it grow with speed. The
    angle of the wheel is known in the recording that was explained; a corrected model adds it nowhere else.
    """

    name = "nonuniformity"
    title = "non-uniformity (once a wheel turn)"
    equation = (
        "d(phi)/dt = v / radius; either F += cosine cos(phi) + sine sin(phi), or slip angle += angle_cosine "
        "cos(phi) + angle_sine sin(phi) and load *= 1 + load_cosine cos(phi) + load_sine sin(phi)"
    )
    source = "SAE J332: lateral and radial force variation, first harmonic"
    needs_time = True
    used = ("speed",)
    family = "wheel"
    prior_source = "SAE J332 grades force variations of some percent of the load"
    parameters = (
        Parameter("cosine_y", "N", -3000.0, 3000.0, 1.0, output="fy", prior=0.05, prior_in="load_nominal"),
        Parameter("sine_y", "N", -3000.0, 3000.0, 1.0, output="fy", prior=0.05, prior_in="load_nominal"),
        Parameter("cosine_x", "N", -3000.0, 3000.0, 1.0, output="fx", prior=0.05, prior_in="load_nominal"),
        Parameter("sine_x", "N", -3000.0, 3000.0, 1.0, output="fx", prior=0.05, prior_in="load_nominal"),
        Parameter("angle_cosine", "rad", -0.05, 0.05, 1e-4, prior=0.005),
        Parameter("angle_sine", "rad", -0.05, 0.05, 1e-4, prior=0.005),
        Parameter("load_cosine", "1", -0.3, 0.3, 1e-3, prior=0.05),
        Parameter("load_sine", "1", -0.3, 0.3, 1e-3, prior=0.05),
        Parameter("radius", "m", 0.01, 2.0, 1e-5, form=True),
    )
    looks_like = {"time_delay": "a delay needs slip that changes"}
    experiment = "record straight rolling at two steady speeds: the frequency must follow the speed"
    order = 15

    def absent(self, data: Context) -> str | None:
        """Ask for enough samples a turn besides."""
        missing = super().absent(data)
        if missing is None and not data.wheel.turns_resolved:
            missing = "fewer than three samples a wheel turn"
        return missing

    def starts(self, data: Context) -> list[dict[str, float]]:
        """In both forms, from the rolling radius at which the residual has most power of that form."""
        force = data.wheel.rolling_radius()
        wobble = data.wheel.rolling_radius(("slip_angle", "normal_load"))
        zero = self.zeros(data)
        return [{**zero, "radius": force}, {**zero, "radius": wobble, "angle_cosine": TOO_SMALL_TO_SEE}]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Return one form's parameters; the radius is found by the scan."""
        return _WOBBLE if start["angle_cosine"] else _FORCE_PARAMETERS

    def quarter_turn(self, p: Parameters) -> dict[str, float]:
        """Turn all harmonics on by a quarter of a turn."""
        out = dict(p)
        for cosine, sine in (_FORCE_PARAMETERS[:2], _FORCE_PARAMETERS[2:], _WOBBLE[:2], _WOBBLE[2:]):
            out[cosine], out[sine] = p[sine], -p[cosine]
        return out

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Wobble slip angle and load."""
        if not any(p[n] for n in _WOBBLE):
            return
        c, s = self._turn(data, p)
        state.slip_angle = state.slip_angle + p["angle_cosine"] * c + p["angle_sine"] * s
        state.normal_load = state.normal_load * (1.0 + p["load_cosine"] * c + p["load_sine"] * s)

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Add the harmonic."""
        if not any(p[n] for n in _FORCE_PARAMETERS):
            return
        c, s = self._turn(data, p)
        for axis in "xy":
            if f"f{axis}" in state.forces:
                wave = p[f"cosine_{axis}"] * c + p[f"sine_{axis}"] * s
                state.forces[f"f{axis}"] = state.forces[f"f{axis}"] + wave

    @staticmethod
    def _turn(data: Context, p: Parameters) -> tuple[np.ndarray, np.ndarray]:
        phase = data.wheel.way / p["radius"]
        return np.nan_to_num(np.cos(phase)), np.nan_to_num(np.sin(phase))  # NaN: the angle is not known
