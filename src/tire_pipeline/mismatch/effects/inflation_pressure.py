"""Inflation pressure: friction and slip stiffness change with it."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.shared import safe_log1p


class InflationPressure(Effect):
    """The model is right at one pressure and wrong at others."""

    name = "inflation_pressure"
    title = "inflation pressure"
    equation = (
        "d = (p - p0) / p0; friction *= 1 + friction d; "
        "stiffness *= 1 + stiffness d + stiffness_curvature d^2; "
        "lateral stiffness besides *= 1 + lateral_stiffness d"
    )
    source = "MF 6.1: PPX1..4, PPY1..4; Besselink, Schmeitz, Pacejka 2010, VSD 48 (suppl. 1)"
    channels = ("pressure",)
    parameters = (
        Parameter("friction", "1", -1.5, 1.5, 0.02),
        Parameter("stiffness", "1", -5.0, 5.0, 0.02),
        Parameter("lateral_stiffness", "1", -2.0, 2.0, 0.02, output="fy"),
        Parameter("stiffness_curvature", "1", -12.0, 12.0, 0.02),
        Parameter("reference", "Pa", 0.0, 5e6, 100.0),
    )
    looks_like = {"temperature": "temperature lags; pressure steps show at once"}
    experiment = "the same sweep at three pressures, in an order that is not the order of time"
    order = 40

    def starts(self, data: object) -> list[dict[str, float]]:
        """Return each pressure at which the model may be right: the file's, or those of the recording."""
        zero = self.zeros(data)
        return [{**zero, "reference": p} for p in data.pressure_levels]  # type: ignore[attr-defined]

    def free(self, data: object, start: Parameters) -> tuple[str, ...]:
        """All but the reference; one stiffness where one force alone is driven."""
        both = data.driven("fx") and data.driven("fy")  # type: ignore[attr-defined]
        names = ("friction", "stiffness", "stiffness_curvature")
        return (*names, "lateral_stiffness") if both else names

    def outside(self, data: object, p: Parameters) -> bool:
        """Whether the stiffness changes by more than a factor of three at a pressure of the recording."""
        factor = 1.0 + _bent(p, _excess(data, p))
        return bool(np.min(factor) < 1.0 / 3.0 or np.max(factor) > 3.0)

    def tire(self, state: State, data: object, p: Parameters) -> None:
        """Scale friction and stiffness with pressure."""
        d = _excess(data, p)
        state.log_friction = state.log_friction + safe_log1p(p["friction"] * d)
        state.log_stiffness = state.log_stiffness + safe_log1p(_bent(p, d))
        state.log_stiffness_y = state.log_stiffness_y + safe_log1p(p["lateral_stiffness"] * d)

    def coefficients(self, tire: object, p: Parameters) -> dict[str, float]:
        """PPX1, PPX3, PPY1, PPY3 of MF 6.x, which has no place for a lateral stiffness that bends."""
        if not str(getattr(tire, "version", "")).startswith("6") or p["stiffness_curvature"] != 0.0:
            return {}
        c = tire.coefficients  # type: ignore[attr-defined]
        return {
            "PPX1": c.get("PPX1", 0.0) + p["stiffness"],
            "PPX3": c.get("PPX3", 0.0) + p["friction"],
            "PPY1": c.get("PPY1", 0.0) + p["stiffness"] + p["lateral_stiffness"],
            "PPY3": c.get("PPY3", 0.0) + p["friction"],
        }


def _excess(data: object, p: Parameters) -> np.ndarray:
    reference = p["reference"] or data.pressure_nominal  # type: ignore[attr-defined]
    return (data.smooth("pressure") - reference) / reference  # type: ignore[attr-defined]


def _bent(p: Parameters, d: np.ndarray) -> np.ndarray:
    return p["stiffness"] * d + p["stiffness_curvature"] * d**2
