"""Slip stiffness higher or lower by one factor everywhere."""

from __future__ import annotations

from collections.abc import Mapping

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import in_both_forms, safe_log1p, scaled


class StiffnessScale(Effect):
    """The slope at zero slip moves; the peak stays where it is high and moves along the slip axis.

    Covers both slip stiffnesses by one factor, and a further one of the lateral stiffness (LKX and LKY are
    two) where both forces move. At combined slip either both slips count times the stiffness, or the file's
    weighting of one slip by the other stays, as other programs have it that change LKX and LKY. Not covered:
    a change with load (load_sensitivity); a slip sensor with a wrong gain, which is the same for all that a
    recording of slip and force can tell.
    """

    name = "stiffness_scale"
    title = "another slip stiffness"
    equation = (
        "F = F0(k slip), k = 1 + stiffness, for Fy times 1 + lateral_stiffness; the peak stays. "
        "The slip angle counts from where Fy is zero: thrusts of camber and ply steer change by k, too. "
        "Where `by_file` is 1: LKX and LKY times k"
    )
    source = "Pacejka, Tire and Vehicle Dynamics, 3rd ed., similarity method (4.2.1); LKX, LKY"
    constant = "stiffness"
    family = "scale"
    prior_source = "Judged: tires of one size differ by about a quarter"
    parameters = (
        Parameter("stiffness", "1", -0.7, 1.5, 0.01, prior=0.25),
        Parameter("lateral_stiffness", "1", -0.7, 1.5, 0.01, output="fy", further=True, prior=0.25),
        Parameter("by_file", "0 or 1", 0.0, 1.0, 0.1, form=True),
    )
    looks_like = {
        "compliance": "compliance costs more stiffness where the tire is stiff (large load)",
        "force_gain": "a gain also moves the peak",
        "unit_error": "a wrong unit is an exact ratio",
    }
    experiment = (
        "turn the wheel by a known angle and read the slip channel; record small-slip sweeps at three loads, "
        "and one sweep to full sliding"
    )
    order = 40

    def same_to_data(self, data: Context, p: Parameters) -> tuple[str, str] | None:
        """The slip times a factor is the stiffness times this factor."""
        return "a wrong gain of the slip channel", "artefact"

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Both forms where they differ: at combined slip."""
        zero = self.zeros(data)
        return in_both_forms(zero, "by_file") if data.has_combined else [zero]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """One stiffness where one force alone is driven."""
        both = data.simulation.driven("fx") and data.simulation.driven("fy")
        return ("stiffness", "lateral_stiffness") if both else ("stiffness",)

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Scale both slip stiffnesses."""
        if p["by_file"] >= 0.5:
            state.coefficients.update(_of_file(data.nominal.coefficients, p))
            return
        state.log_stiffness = state.log_stiffness + safe_log1p(p["stiffness"])
        state.log_stiffness_y = state.log_stiffness_y + safe_log1p(p["lateral_stiffness"])

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """LKX and LKY."""
        return _of_file(tire.coefficients, p)


def _of_file(coefficients: Mapping[str, float], p: Parameters) -> dict[str, float]:
    """Return LKX and LKY of a file, scaled."""
    along = 1.0 + p["stiffness"]
    return scaled(coefficients, {"LKX": along, "LKY": along * (1.0 + p["lateral_stiffness"])})
