"""Combined slip: how much one slip takes from the force of the other."""

from __future__ import annotations

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context

_WEIGHT_COEFFICIENTS = ("RBX1", "RBX2", "RBY1", "RBY2")
_TYPICAL = {"RBX1": 12.0, "RBX2": 12.0, "RBY1": 14.0, "RBY2": 10.0}
_MORE_WEIGHT = ("more_x", "more_y")


class CombinedSlip(Effect):
    """Weighting functions of the model missing or wrong.

    Covers the cosine weighting of both forces by the other slip (RBX1, RBX2, RBY1, RBY2), and more of it on
    top of the file's own. Not covered: its shifts (RHX1, RBY3, RHY1), its change with camber and load
    (RBX3, RBY4, RHY2), and the side force that braking makes at zero slip angle (RVY1 to RVY6), which looks
    like crosstalk.
    """

    name = "combined_slip"
    title = "combined slip"
    equation = (
        "Fx = G(slip_angle) Fx0, Fy = G(slip_ratio) Fy0; G = cos(C arctan(B s)), "
        "B = RB1 cos(arctan(RB2 s_other)), C = RC1 (1 where the file has none); or the file's own G times "
        "cos(arctan(more s)), where its C is so small that no B takes much"
    )
    source = "MF 5.2 weighting functions (thesis, Appendix A, combined slip); Bayle et al. 1993"
    used = ("slip_angle", "slip_ratio")
    family = "scale"
    prior_source = "Published RBX1 and RBY1 lie at 5 to 15"
    parameters = (
        *(Parameter(n, "1", 0.5, 400.0, 0.2, ratio=True) for n in _WEIGHT_COEFFICIENTS),
        *(Parameter(n, "1", 0.0, 60.0, 0.1, prior=5.0) for n in _MORE_WEIGHT),
    )
    looks_like = {
        "friction_scale": "friction acts on pure slip too",
        "force_gain": "a gain acts on pure slip too",
        "temperature": "heat acts on pure slip too",
    }
    experiment = "record brake ramps at three slip angles or more"
    order = 40

    def absent(self, data: Context) -> str | None:
        """Ask for points with both slips; one of them may stand still: brake ramps at one slip angle."""
        missing = super().absent(data)
        if missing is None and not any(data.varies(n) for n in self.used):
            missing = "neither slip_angle nor slip_ratio varies"
        if missing is None and not data.has_combined:
            missing = "no points with slip angle and slip ratio together"
        return missing

    def starts(self, data: Context) -> list[dict[str, float]]:
        """From the file's own values, or typical ones where it has none.

        Near zero the weighting does not answer to a coefficient at first order, and a fit would stay there.
        """
        c = data.nominal.coefficients
        own = {n: float(c.get(n, 0.0)) for n in _WEIGHT_COEFFICIENTS}
        other = {n: own[n] if own[n] > 0.05 * _TYPICAL[n] else _TYPICAL[n] for n in _WEIGHT_COEFFICIENTS}
        return [{**other, "more_x": 0.0, "more_y": 0.0}, {**own, "more_x": 6.0, "more_y": 6.0}]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """The file's own coefficients, or what comes on top of them."""
        return _MORE_WEIGHT if start["more_x"] else _WEIGHT_COEFFICIENTS

    def drivers(self, output: str) -> tuple[str, ...]:
        """Return the other slip: it takes from the force."""
        return ("slip_angle",) if output == "fx" else ("slip_ratio",)

    def zeros(self, data: Context) -> dict[str, float]:
        """Return the file's own values: there the effect is absent."""
        c = data.nominal.coefficients
        return {**{n: float(c.get(n, 0.0)) for n in _WEIGHT_COEFFICIENTS}, "more_x": 0.0, "more_y": 0.0}

    def tire(self, state: State, data: Context, p: Parameters) -> None:
        """Replace the weighting coefficients."""
        c = data.nominal.coefficients
        if p["more_x"] or p["more_y"]:
            return
        changes = {n: p[n] for n in _WEIGHT_COEFFICIENTS}
        for axis in "XY":
            if not c.get(f"RC{axis}1", 0.0):
                changes[f"RC{axis}1"] = 1.0
        state.coefficients.update(changes)

    def outputs(self, state: State, data: Context, p: Parameters) -> None:
        """Take more of each force by the other slip."""
        for force, name, slip in (("fx", "more_x", state.slip_angle), ("fy", "more_y", state.slip_ratio)):
            if p[name]:
                state.forces[force] = state.forces[force] / np.sqrt(1.0 + (p[name] * slip) ** 2)

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """RBX1, RBX2, RBY1, RBY2; a weighting on top of the file's own has no place."""
        if p["more_x"] or p["more_y"]:
            return {}
        c = tire.coefficients
        out = {n: p[n] for n in _WEIGHT_COEFFICIENTS}
        out.update({n: 1.0 for n in ("RCX1", "RCY1") if not c.get(n, 0.0)})
        return out
