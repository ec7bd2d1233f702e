"""A force shows in the channel of another one: the normal load, or the other tangential force."""

from __future__ import annotations

from tire_pipeline.mismatch.effects.base import TOO_SMALL_TO_SEE, Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context

_OF_FORCES = ("into_fy", "into_fx")
_OF_LOAD = ("load_into_fy", "load_into_fx")


class Crosstalk(Effect):
    """The load cell's axes are not quite square.

    Covers the leak of the normal load into Fy and Fx, the largest force and so the most common leak, or the
    leaks between Fx and Fy, or all of these, each with a factor of its own. At one load a leak of the normal
    load is an offset of the force, and stands beside it. Not covered: leaks into the normal load, which then
    is wrong as an input (load_gain, load_offset are without the leak), and of moments.
    """

    name = "crosstalk"
    kind = "artefact"
    title = "crosstalk between force channels"
    equation = (
        "Fy recorded = Fy + into_fy Fx + load_into_fy Fz; Fx recorded = Fx + into_fx Fy + load_into_fx Fz"
    )
    source = "six-component load cell: off-diagonal terms of the calibration matrix"
    family = "side"
    prior_source = "Judged: load cells leak 1 to 5% before they are calibrated, the larger load less"
    parameters = (
        Parameter("into_fy", "1", -0.5, 0.5, 0.005, output="fy", prior=0.05),
        Parameter("into_fx", "1", -0.5, 0.5, 0.005, output="fx", prior=0.05),
        Parameter("load_into_fy", "1", -0.2, 0.2, 0.001, output="fy", prior=0.02),
        Parameter("load_into_fx", "1", -0.2, 0.2, 0.001, output="fx", prior=0.02),
    )
    looks_like = {
        "combined_slip": "the weighting of combined slip is even in the other slip",
        "slip_angle_offset": "an offset acts without the other force",
        "plysteer_conicity": "a leak of the load stays on the rig when the tire is turned on its rim",
        "force_offset": "an offset is the same at every load",
        "rolling_resistance": "rolling resistance turns its sign when the wheel rolls the other way",
    }
    experiment = "record a pure brake ramp, a pure slip-angle sweep, and straight rolling at three loads"
    order = 86

    def starts(self, data: Context) -> list[dict[str, float]]:
        """With leaks of the load, with leaks between two forces, and with all of these."""
        leaks: list[tuple[str, ...]] = [_OF_LOAD]
        if "fx" in data.outputs and "fy" in data.outputs:
            leaks += [_OF_FORCES, (*_OF_FORCES, *_OF_LOAD)]
        return [{**self.zeros(data), **dict.fromkeys(names, TOO_SMALL_TO_SEE)} for names in leaks]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Return the leaks that a start has."""
        return tuple(p.name for p in self.parameters if start.get(p.name))

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Mix the forces."""
        fx, fy = state.forces["fx"], state.forces["fy"]
        load = data.get("normal_load")
        state.forces["fy"] = fy + p["into_fy"] * fx + p["load_into_fy"] * load
        state.forces["fx"] = fx + p["into_fx"] * fy + p["load_into_fx"] * load
