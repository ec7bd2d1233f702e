"""Friction higher or lower by one factor everywhere: another surface, another compound."""

from __future__ import annotations

from collections.abc import Mapping

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import in_both_forms, safe_log1p, scaled


class FrictionScale(Effect):
    """The peak of both forces moves; the slope at zero slip does not.

    Covers one factor for both forces (LMUX = LMUY: another surface or compound). At combined slip either both
    slips count over the friction, as tread elements slide, or the file's weighting of one slip by the other
    stays, as other programs have it that change LMUX and LMUY. Not covered: friction that differs along and
    across, which a surface does not make; what changes with load is load_sensitivity, with time
    surface_change, temperature or wear.
    """

    name = "friction_scale"
    title = "another friction level"
    equation = (
        "F = m F0(slip / m), m = 1 + friction; the slope at zero slip stays. The slip angle counts from "
        "where Fy is zero: thrusts of camber, ply steer and conicity stay, too. Where `by_file` "
        "is 1: LMUX and LMUY times m"
    )
    source = "Pacejka, Tire and Vehicle Dynamics, 3rd ed., similarity method (4.2.1); LMUX, LMUY"
    constant = "friction"
    family = "scale"
    prior_source = "Judged: dry surfaces differ by 10 to 20%, as LMUX and LMUY are set between rig and road"
    parameters = (
        Parameter("friction", "1", -0.7, 1.0, 0.01, prior=0.15),
        Parameter("by_file", "0 or 1", 0.0, 1.0, 0.1, form=True),
    )
    looks_like = {
        "force_gain": "a gain also raises the slope at zero slip, and need not act on both forces",
        "surface_change": "a surface change begins at a moment",
        "stiffness_scale": "stiffness moves the slope and leaves the peak",
        "temperature": "temperature follows the tread temperature",
        "load_gain": "a gain of the load also raises the slope at zero slip",
    }
    experiment = "record one sweep to full sliding at small and at large load, with both forces recorded"
    order = 40

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Both forms where they differ: at combined slip."""
        zero = self.zeros(data)
        return in_both_forms(zero, "by_file") if data.has_combined else [zero]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """The friction; the form is one of the two."""
        return ("friction",)

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Scale the friction."""
        if p["by_file"] >= 0.5:
            state.coefficients.update(_of_file(data.nominal.coefficients, p))
            return
        state.log_friction = state.log_friction + safe_log1p(p["friction"])

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """LMUX and LMUY."""
        return _of_file(tire.coefficients, p)


def _of_file(coefficients: Mapping[str, float], p: Parameters) -> dict[str, float]:
    """Return LMUX and LMUY of a file, scaled."""
    return scaled(coefficients, dict.fromkeys(("LMUX", "LMUY"), 1.0 + p["friction"]))
