"""Rolling resistance in the longitudinal force, which files often leave to the moment My."""

from __future__ import annotations

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class RollingResistance(Effect):
    """A longitudinal force against the motion, in proportion to the load, whatever the slip.

    Covers a share of the load and its change with speed. Not covered: a change with pressure, temperature or
    camber, and the moment My that belongs to it.
    """

    name = "rolling_resistance"
    title = "rolling resistance"
    equation = "Fx -= Fz (level + with_speed (v - v0) / v0)"
    source = "Pacejka, Tire and Vehicle Dynamics, 3rd ed., 4.E70 (QSY1 to QSY4) and 4.E18 (PVX1); SAE J1269"
    family = "side"
    prior_source = "Tires of cars and trucks: 0.5 to 1.5% of the load (SAE J1269)"
    parameters = (
        Parameter("level", "1", -0.1, 0.1, 0.0005, output="fx", prior=0.01),
        Parameter("with_speed", "1", -0.1, 0.1, 0.0005, output="fx", further=True, prior=0.005),
    )
    looks_like = {
        "crosstalk": "a leak of the load keeps its sign when the wheel rolls the other way",
        "force_offset": "an offset does not change with load",
        "slip_ratio_offset": "an offset of the slip ratio does not show where the tire slides",
    }
    experiment = "record free rolling both ways at three loads"
    order = 50

    def absent(self, data: Context) -> str | None:
        """Ask for the longitudinal force."""
        return None if "fx" in data.outputs else "fx is not recorded"

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """The change with speed where the speed varies."""
        return ("level", "with_speed") if data.has("speed") and data.varies("speed") else ("level",)

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take the resistance off the longitudinal force."""
        share = p["level"] + (p["with_speed"] * data.nominal.speed_excess if p["with_speed"] else 0.0)
        state.forces["fx"] = state.forces["fx"] - share * state.normal_load

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """PVX1; a change with speed has no place in it."""
        return {} if p["with_speed"] else {"PVX1": tire.coefficients.get("PVX1", 0.0) - p["level"]}
