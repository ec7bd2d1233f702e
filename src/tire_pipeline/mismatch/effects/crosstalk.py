"""One force shows in the channel of the other."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State


class Crosstalk(Effect):
    """The load cell's axes are not quite square."""

    name = "crosstalk"
    kind = "artefact"
    title = "crosstalk between force channels"
    equation = "Fy recorded = Fy + into_fy Fx; Fx recorded = Fx + into_fx Fy"
    source = "six-component load cell: off-diagonal terms of the calibration matrix"
    own_inputs = True
    parameters = (
        Parameter("into_fy", "1", -0.5, 0.5, 0.005, output="fy"),
        Parameter("into_fx", "1", -0.5, 0.5, 0.005, output="fx"),
    )
    looks_like = {
        "combined_slip": "the weighting of combined slip is even in the other slip",
        "slip_angle_offset": "an offset acts without the other force",
    }
    experiment = "a pure brake ramp and a pure slip-angle sweep"
    order = 86

    def absent(self, data: object) -> str | None:
        """Ask for both forces."""
        if "fx" not in data.outputs or "fy" not in data.outputs:  # type: ignore[attr-defined]
            return "only one force is recorded"
        return super().absent(data)

    def outputs(self, state: State, data: object, p: Parameters) -> None:
        """Mix the forces."""
        fx, fy = state.forces["fx"], state.forces["fy"]
        state.forces["fy"] = fy + p["into_fy"] * fx
        state.forces["fx"] = fx + p["into_fx"] * fy
