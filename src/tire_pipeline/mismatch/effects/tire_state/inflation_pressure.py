"""Inflation pressure: friction and slip stiffness change with it."""

from __future__ import annotations

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import safe_log1p


class InflationPressure(Effect):
    """The model is right at one pressure and wrong at others, or at the one that was recorded.

    Covers friction (PPX3, PPX4, PPY3, PPY4), slip stiffness (PPX1, PPX2, PPY1) and stiffness whose change
    depends on load (PPY2: a softer tire saturates at a smaller load). Not covered: what pressure does to
    the camber stiffness (PPY5) and to the pneumatic trail, and a pressure that rises with temperature but
    was recorded cold.
    """

    name = "inflation_pressure"
    title = "inflation pressure"
    equation = (
        "d = (p - p0) / p0; friction *= 1 + friction d + friction_curvature d^2; "
        "stiffness *= 1 + stiffness d + stiffness_curvature d^2 + stiffness_load d (Fz - Fz0) / Fz0; "
        "lateral stiffness also *= 1 + lateral_stiffness d"
    )
    source = "MF 6.1: PPX1..4, PPY1..5; Besselink, Schmeitz, Pacejka 2010, VSD 48 (suppl. 1)"
    channels = ("pressure",)
    family = "pressure"
    prior_source = "PPX1 to PPX4 and PPY1 to PPY5 of MF 6.1 are fractions of 1 in published files"
    parameters = (
        Parameter("friction", "1", -1.5, 1.5, 0.02, prior=0.3),
        Parameter("stiffness", "1", -5.0, 5.0, 0.02, prior=0.7),
        Parameter("lateral_stiffness", "1", -2.0, 2.0, 0.02, output="fy", prior=0.4),
        Parameter("stiffness_curvature", "1", -12.0, 12.0, 0.02, prior=1.5),
        Parameter("friction_curvature", "1", -6.0, 6.0, 0.02, further=True, prior=0.7),
        Parameter("stiffness_load", "1", -5.0, 5.0, 0.02, further=True, prior=0.7),
        Parameter("reference", "Pa", 0.0, 5e6, 100.0, form=True),
    )
    looks_like = {"temperature": "temperature lags; pressure steps show at once"}
    experiment = "record the same sweep at three pressures, in an order that is not the order of time"
    order = 40

    def absent(self, data: Context) -> str | None:
        """Ask for a pressure that varies, or that is another one than the file's throughout."""
        return None if data.nominal.off_pressure else super().absent(data)

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Return each pressure at which the model may be right: the file's, or those of the recording."""
        zero = self.zeros(data)
        return [{**zero, "reference": p} for p in data.nominal.pressure_levels]

    def expected(self, data: Context) -> bool:
        """The file knows nothing of a pressure that varies: every tire answers (Besselink et al. 2010)."""
        return not data.nominal.knows_pressure and data.varies("pressure")

    def same_to_data(self, data: Context, p: Parameters) -> tuple[str, str] | None:
        """A model that answers to pressure answers to a channel with another gain."""
        fault = "a wrong gain of the pressure channel", "artefact"
        return fault if data.nominal.knows_pressure else None

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """All but the reference; one stiffness where one force alone is driven."""
        both = data.simulation.driven("fx") and data.simulation.driven("fy")
        names: tuple[str, ...] = ("friction", "stiffness", "stiffness_curvature", "friction_curvature")
        if data.varies("normal_load"):
            names = (*names, "stiffness_load")
        return (*names, "lateral_stiffness") if both else names

    def outside(self, data: Context, p: Parameters) -> bool:
        """Whether the stiffness changes by more than a factor of three at a pressure of the recording."""
        factor = 1.0 + _bent(p, _excess(data, p), data.nominal.load_excess(data.get("normal_load")))
        return bool(np.min(factor) < 1.0 / 3.0 or np.max(factor) > 3.0)

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Scale friction and stiffness with pressure."""
        d = _excess(data, p)
        friction = p["friction"] * d + p["friction_curvature"] * d**2
        state.log_friction = state.log_friction + safe_log1p(friction)
        load = data.nominal.load_excess(state.normal_load)
        state.log_stiffness = state.log_stiffness + safe_log1p(_bent(p, d, load))
        state.log_stiffness_y = state.log_stiffness_y + safe_log1p(p["lateral_stiffness"] * d)

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """PPX1, PPX3, PPX4, PPY1, PPY3, PPY4 of MF 6.x.

        It has no place for a lateral stiffness that bends, and PPY2 for one that changes with load is another
        form.
        """
        bent = p["stiffness_curvature"] != 0.0 or p["stiffness_load"] != 0.0
        if not str(getattr(tire, "version", "")).startswith("6") or bent:
            return {}
        c = tire.coefficients
        return {
            "PPX1": c.get("PPX1", 0.0) + p["stiffness"],
            "PPX3": c.get("PPX3", 0.0) + p["friction"],
            "PPX4": c.get("PPX4", 0.0) + p["friction_curvature"],
            "PPY1": c.get("PPY1", 0.0) + p["stiffness"] + p["lateral_stiffness"],
            "PPY3": c.get("PPY3", 0.0) + p["friction"],
            "PPY4": c.get("PPY4", 0.0) + p["friction_curvature"],
        }


def _excess(data: Context, p: Parameters) -> np.ndarray:
    reference = p["reference"] or data.nominal.pressure
    return (data.smooth("pressure") - reference) / reference


def _bent(p: Parameters, d: np.ndarray, load: np.ndarray) -> np.ndarray:
    return (p["stiffness"] + p["stiffness_load"] * load) * d + p["stiffness_curvature"] * d**2
