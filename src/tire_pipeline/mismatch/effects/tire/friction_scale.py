"""Friction higher or lower by one factor everywhere: another surface, another compound."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.shared import safe_log1p


class FrictionScale(Effect):
    """The peak of both forces moves; the slope at zero slip does not.

    Covers one factor for both forces (LMUX = LMUY: another surface or compound). Not covered: friction that
    differs along and across, which a surface does not make; what changes with load is load_sensitivity,
    with time surface_change, temperature or wear.
    """

    name = "friction_scale"
    title = "another friction level"
    equation = "F = m F0(slip / m), m = 1 + friction; the slope at zero slip stays"
    source = "Pacejka, Tire and Vehicle Dynamics, 3rd ed., similarity method (4.2.1); LMUX, LMUY"
    constant = "friction"
    family = "scale"
    prior_source = "Judged: dry surfaces differ by 10 to 20%, as LMUX and LMUY are set between rig and road"
    parameters = (Parameter("friction", "1", -0.7, 1.0, 0.01, prior=0.15),)
    looks_like = {
        "force_gain": "a gain also raises the slope at zero slip, and need not act on both forces",
        "surface_change": "a surface change begins at a moment",
        "stiffness_scale": "stiffness moves the slope and leaves the peak",
        "temperature": "temperature follows the tread temperature",
    }
    experiment = "record one sweep to full sliding at small and at large load, with both forces recorded"
    order = 40

    def tire(self, state: State, data: object, p: Parameters) -> None:
        """Scale the friction."""
        state.log_friction = state.log_friction + safe_log1p(p["friction"])

    def coefficients(self, tire: object, p: Parameters) -> dict[str, float]:
        """LMUX and LMUY."""
        c = tire.coefficients  # type: ignore[attr-defined]
        return {n: c.get(n, 1.0) * (1.0 + p["friction"]) for n in ("LMUX", "LMUY")}
