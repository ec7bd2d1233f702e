"""Camber: thrust, peak and stiffness of the lateral force."""

from __future__ import annotations

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context


class Camber(Effect):
    """The forces answer to camber in a way that the model does not know.

    Covers thrust and its change with load, a shift along the slip axis, loss of lateral stiffness and of
    friction, and loss of longitudinal friction (PDX3). Not covered: the shape of the curve (PEY4), the
    weighting of combined slip (RBX3, RBY4), and spin from camber on a curved path.
    """

    name = "camber"
    title = "camber"
    equation = (
        "slip_angle += shift camber; Fy += Fz camber (thrust + thrust_load dfz) cos(arctan(10 slip_ratio)); "
        "lateral friction *= 1 - friction_loss camber^2, longitudinal friction *= 1 - friction_loss_x "
        "camber^2; lateral stiffness *= 1 - stiffness_loss |camber|"
    )
    source = "MF 5.2: PHY3, PVY3, PVY4, PDY3, PKY3, PDX3 (thesis, Appendix A, pure slip)"
    channels = ("camber",)
    family = "inclination"
    prior_source = (
        "Camber stiffness of a car tire is about a tenth of its cornering stiffness (Pacejka, 3rd ed., "
        "ch. 4); widened to three tenths. Losses: PDX3, PDY3 and PKY3 of published files are of this order"
    )
    parameters = (
        Parameter("shift", "rad/rad", -2.0, 2.0, 0.01, prior=0.3),
        Parameter("thrust", "1/rad", -4.0, 4.0, 0.02, prior=1.0),
        Parameter("thrust_load", "1/rad", -4.0, 4.0, 0.02, further=True, prior=1.0),
        Parameter("friction_loss", "1/rad^2", -40.0, 60.0, 0.5, further=True, prior=5.0),
        Parameter("friction_loss_x", "1/rad^2", -40.0, 60.0, 0.5, output="fx", further=True, prior=5.0),
        Parameter("stiffness_loss", "1/rad", -6.0, 10.0, 0.05, prior=1.0),
    )
    looks_like = {
        "camber_offset": "an offset of the camber sensor acts at zero camber too",
        "slip_angle_offset": "an offset does not change sign with camber",
        "plysteer_conicity": "conicity does not change with camber",
    }
    told_by = dict.fromkeys(("camber_offset", "slip_angle_offset", "plysteer_conicity"), "camber")
    experiment = "record the same slip sweep at camber of both signs and at zero"
    order = 40

    def absent(self, data: Context) -> str | None:
        """Ask for a camber that varies, or that stays at another one than the file was fitted at."""
        return None if data.nominal.off_camber else super().absent(data)

    def expected(self, data: Context) -> bool:
        """The file knows no camber: every tire answers to one that varies (Pacejka, 3rd ed., 4.3.1).

        Where the camber stays the same, the file may have been fitted at it.
        """
        return not data.nominal.knows_camber and data.varies("camber")

    def same_to_data(self, data: Context, p: Parameters) -> tuple[str, str] | None:
        """A model that answers to camber answers to a channel with another gain."""
        fault = "a wrong sign or gain of the camber channel", "artefact"
        return fault if data.nominal.knows_camber else None

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """All but the longitudinal friction where nothing brakes or drives."""
        names = tuple(p.name for p in self.parameters if p.name != "friction_loss_x")
        return (*names, "friction_loss_x") if data.simulation.driven("fx") else names

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Change friction and stiffness with camber."""
        g = state.camber
        loss = np.maximum(1.0 - p["friction_loss"] * g**2, 0.05)
        soft = np.maximum(1.0 - p["stiffness_loss"] * np.abs(g), 0.05)
        loss_x = np.maximum(1.0 - p["friction_loss_x"] * g**2, 0.05)
        state.log_friction = state.log_friction + np.log(loss_x)
        state.log_friction_y = state.log_friction_y + np.log(loss) - np.log(loss_x)
        state.log_stiffness_y = state.log_stiffness_y + np.log(soft)
        state.slip_angle = state.slip_angle + p["shift"] * g
        excess = data.nominal.load_excess(state.normal_load)
        thrust = p["thrust"] + p["thrust_load"] * excess
        fade = 1.0 / np.sqrt(1.0 + (10.0 * state.slip_ratio) ** 2)
        state.added_y = state.added_y + state.normal_load * g * thrust * fade

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """Add to PHY3, PVY3, PVY4, PDY3, PKY3, PDX3 (MF 5.x; 6.x keeps the shift in PVY3 and PKY6)."""
        c = tire.coefficients
        names = {
            "PVY3": p["thrust"],
            "PVY4": p["thrust_load"],
            "PDY3": p["friction_loss"],
            "PDX3": p["friction_loss_x"],
            "PKY3": p["stiffness_loss"],
        }
        if not str(getattr(tire, "version", "5.2")).startswith("6"):
            names["PHY3"] = p["shift"]
        return {n: c.get(n, 0.0) + v for n, v in names.items()}
