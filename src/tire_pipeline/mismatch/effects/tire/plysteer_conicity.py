"""Conicity and ply steer: side force while rolling straight."""

from __future__ import annotations

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import TOO_SMALL_TO_SEE, Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class PlysteerConicity(Effect):
    """A side force without slip that comes from how the tire is built.

    Conicity is a force that stays where the tire slides, or fades there (thrust), or both; or a camber.
    Covers both in proportion to load, and ply steer as a slip angle. Not covered: conicity that changes
    with camber or pressure.
    """

    name = "plysteer_conicity"
    title = "conicity or ply steer"
    equation = (
        "slip angle += ply_steer + thrust Fz / K, K = dFy / d slip angle while rolling straight; "
        "Fy += conicity Fz; or instead of thrust and conicity camber += pseudo_camber, where the model "
        "answers to camber"
    )
    source = (
        "SAE J1106; Pacejka, 3rd ed., 4.2.1: ply steer as equivalent slip angle, conicity as equivalent "
        "camber; 4.E27: camber's thrust over K as a shift of the slip angle"
    )
    family = "side"
    prior_source = (
        "Conicity and ply steer of car tires are some percent of the load and some tenths of a "
        "degree (Pacejka, 3rd ed., ch. 4)"
    )
    parameters = (
        Parameter("conicity", "1", -0.15, 0.15, 0.001, output="fy", prior=0.02),
        Parameter("pseudo_camber", "rad", -0.35, 0.35, 0.001, output="fy", prior=0.02),
        Parameter("thrust", "1", -0.3, 0.3, 0.001, output="fy", prior=0.02),
        Parameter("ply_steer", "rad", -0.05, 0.05, 0.0005, output="fy", prior=0.004),
    )
    looks_like = {
        "force_offset": "an offset of the sensor does not change with load",
        "slip_angle_offset": "an offset of slip angle looks like ply steer: turn the tire round",
        "camber_offset": "an offset of camber looks like conicity: turn the tire on its rim",
        "crosstalk": "a leak of the load looks like conicity: turn the tire on its rim",
    }
    experiment = "record straight rolling at three loads, then with the tire turned on its rim"
    order = 12
    needed = ("conicity", "pseudo_camber", "thrust")

    def starts(self, data: Context) -> list[dict[str, float]]:
        """As a force that stays, as one that fades, and as camber where the model knows camber.

        A crooked crown need not come with ply steer, so a camber is tried alone, too.
        """
        zero = self.zeros(data)
        out = [zero, {**zero, "thrust": TOO_SMALL_TO_SEE}]
        if data.nominal.knows_camber:
            camber = {**zero, "pseudo_camber": 1e-6}
            out += [camber, {**camber, "ply_steer": TOO_SMALL_TO_SEE}]
        return out

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Return the parameters of one of the four forms."""
        if start["pseudo_camber"]:
            return ("pseudo_camber", "ply_steer") if start["ply_steer"] else ("pseudo_camber",)
        return ("conicity", "thrust" if start["thrust"] else "ply_steer")

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Shift slip angle and camber."""
        state.slip_angle = state.slip_angle + p["ply_steer"]
        state.camber = state.camber + p["pseudo_camber"]
        if p["thrust"]:
            shift = data.simulation.shift_by_thrust
            state.slip_angle = state.slip_angle + p["thrust"] * shift

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Add the side force."""
        state.added_y = state.added_y + p["conicity"] * state.normal_load

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """PVY1 and PHY1; an equivalent camber and a force that fades have no place."""
        if p["pseudo_camber"] or p["thrust"]:
            return {}
        c = tire.coefficients
        return {"PVY1": c.get("PVY1", 0.0) + p["conicity"], "PHY1": c.get("PHY1", 0.0) + p["ply_steer"]}
