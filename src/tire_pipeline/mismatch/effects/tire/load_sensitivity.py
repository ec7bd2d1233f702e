"""Friction and slip stiffness change with load in another way than the model says."""

from __future__ import annotations

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import Array, Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import beyond_known, in_both_forms, safe_log1p


class LoadSensitivity(Effect):
    """The model is right at one load and wrong above and below it: a file fitted at one load.

    That load is the nominal one, or another: a file is fitted at the loads that were measured.

    Covers friction that falls with load (PDX2, PDY2), one rate for both forces, and slip stiffness over
    load that falls with load (the cornering stiffness saturates: PKY1, PKY2; PKX2, PKX3), apart for the
    lateral force where both forces move. Either in proportion to the load, as Magic Formulas have it, or by
    a power of it, as rubber on hard ground has it. Not covered: shape and curvature that change with load
    (PEY2, PEX2, PEX3), and what the file already has: the change is on top of its own.
    """

    name = "load_sensitivity"
    title = "another change of friction and stiffness with load"
    equation = (
        "d = Fz / Fz0 - right_at; friction *= 1 + rate d; stiffness *= 1 + stiffness d; "
        "lateral stiffness also *= 1 + lateral_stiffness d. Where `power` is 1: "
        "friction *= (Fz / Fz0 / right_at)^rate, and so on"
    )
    source = (
        "MF 5.2: mu = PDY1 + PDY2 dfz, K = PKY1 Fz0 sin(2 arctan(Fz / (PKY2 Fz0))), PKX2, PKX3 (thesis, "
        "Appendix A); by a power: Schallamach 1952, Grosch 1996 on load dependence"
    )
    channels = ("normal_load",)
    family = "scale"
    prior_source = (
        "PDX2, PDY2 and the curvature of the stiffness over load of published files: tenths; loads of test "
        "plans: a third to 1.7 of the nominal one, and a fit is right at about their mean"
    )
    parameters = (
        Parameter("rate", "1", -1.5, 1.5, 0.01, prior=0.2),
        Parameter("stiffness", "1", -1.5, 1.5, 0.01, prior=0.3),
        Parameter("lateral_stiffness", "1", -1.5, 1.5, 0.01, output="fy", prior=0.3),
        Parameter("right_at", "1", 0.5, 1.7, 0.02, zero=1.0, form=True, further=True, prior=0.15),
        Parameter("power", "0 or 1", 0.0, 1.0, 0.1, form=True),
    )
    looks_like = {
        "friction_scale": "a friction factor is the same at every load",
        "stiffness_scale": "a stiffness factor is the same at every load",
        "compliance": "compliance costs stiffness at small loads, too, and none where the tire slides",
    }
    experiment = "record sweeps to full sliding at four loads or more"
    order = 40

    def starts(self, data: Context) -> list[dict[str, float]]:
        """In proportion to the load, or by a power of it."""
        return in_both_forms(self.zeros(data), "power")

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """One stiffness where one force alone is driven."""
        both = data.simulation.driven("fx") and data.simulation.driven("fy")
        return ("rate", "stiffness", *(("lateral_stiffness",) if both else ()), "right_at")

    def expected(self, data: Context) -> bool:
        """The file does not know the recording's loads."""
        return _far_outside(data) or beyond_known(data.get("normal_load"), data.nominal.load_range)

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Scale friction and stiffness with load."""
        right_at = p["right_at"]
        excess = data.nominal.load_excess(state.normal_load, right_at)

        def log_factor(name: str) -> Array:
            return np.asarray(
                p[name] * safe_log1p(excess / right_at) if p["power"] >= 0.5 else safe_log1p(p[name] * excess)
            )

        state.log_friction = state.log_friction + log_factor("rate")
        state.log_stiffness = state.log_stiffness + log_factor("stiffness")
        state.log_stiffness_y = state.log_stiffness_y + log_factor("lateral_stiffness")

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """PDX1 to PDY2; a power, or a stiffness that is linear in load, has no place beside PKY2."""
        if p["power"] or p["stiffness"] or p["lateral_stiffness"]:
            return {}
        c = tire.coefficients
        out: dict[str, float] = {}
        for axis in "XY":
            peak, fall = c.get(f"PD{axis}1", 1.0), c.get(f"PD{axis}2", 0.0)
            level = 1.0 + p["rate"] * (1.0 - p["right_at"])
            out |= {f"PD{axis}1": peak * level, f"PD{axis}2": fall * level + peak * p["rate"]}
        return out


def _far_outside(data: Context) -> bool:
    """Whether the recording's loads are farther from all that the file holds for than they are apart.

    Then it shows how wrong the file is at these loads, and hardly how that changes with load.
    """
    load = data.get("normal_load")
    low, high = data.nominal.load_range
    return bool(max(low - np.max(load), np.min(load) - high) > np.ptp(load))
