"""Relaxation: the force needs a distance to build up."""

from __future__ import annotations

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.context import Context
from tire_pipeline.mismatch.effects.shared import first_order, relaxation_lengths

_IN_RADII = (0.1, 4.0)
"""Length over the unloaded radius that a tire can have: about 0.5 to 3 for the lateral force, less along."""


class RelaxationLength(Effect):
    """Slip acts on the tire only after a distance rolled: a lag that is shorter at speed.

    Covers a length that is constant, falls with slip, or changes with load (PTY2) in proportion, or both;
    one for both slips, or another one along the wheel (PTX1) where both forces move. A tire's length is 0.1
    to 4 of its radii. Not covered: a lag of camber and of the aligning moment (gyroscopic couple), of
    second order.
    """

    name = "relaxation_length"
    title = "relaxation length"
    equation = (
        "length / v d(slip')/dt + slip' = slip, forces from slip'; length *= slope(slip) "
        "/ slope(0) where `fades`; length *= 1 + load (Fz - Fz0) / Fz0; that of the slip ratio *= along"
    )
    source = "von Schlippe and Dietrich 1941; Pacejka, 3rd ed., 7.2 (PTX, PTY of MF 5.2)"
    needs_time = True
    used = ("speed",)
    dynamic = True
    instead_of_file = True
    family = "lag"
    prior_source = "About a radius in side slip and less in braking (Pacejka, 3rd ed., ch. 7)"
    parameters = (
        Parameter("length", "m", 0.0, 10.0, 0.002, prior=1.0, prior_in="radius"),
        Parameter("fades", "1", 0.0, 1.0, 0.1, form=True),
        Parameter("load", "1", -1.0, 2.0, 0.02, further=True, prior=0.5),
        Parameter("along", "1", 0.05, 3.0, 0.02, zero=1.0, further=True, prior=0.5),
    )
    looks_like = {
        "time_delay": "a delay is the same at every speed",
        "low_pass": "a filter is the same at every speed",
    }
    told_by = {"time_delay": "speed", "low_pass": "speed"}
    experiment = "record the same slip-angle sine at two speeds that differ by a factor of two or more"
    order = 30

    def starts(self, data: Context) -> list[dict[str, float]]:
        """Two sizes, in radii of the wheel, with the length constant or falling with slip, or with load."""
        radius, zero = data.nominal.radius, self.zeros(data)
        loads = (0.0, self.parameter("load").prior) if data.varies("normal_load") else (0.0,)
        return [
            {**zero, "length": s * radius, "fades": f, "load": by_load}
            for s in (0.3, 1.2)
            for f in (0.0, 1.0)
            for by_load in loads
        ]

    def free(self, data: Context, start: Parameters) -> tuple[str, ...]:
        """Return the length, its change with load if it has one, and along the wheel; it fades or not."""
        names = ["length"]
        if start["load"]:
            names.append("load")
        if data.simulation.driven("fx") and data.simulation.driven("fy"):
            names.append("along")
        return tuple(names)

    def outside(self, data: Context, p: Parameters) -> bool:
        """Whether no tire has such a length: it is a matter of the contact patch and the carcass."""
        low, high = _IN_RADII
        return not low <= p["length"] / data.nominal.radius <= high

    def inputs(self, state: State, data: Context, p: Parameters) -> None:
        """Lag the slips."""
        if p["length"] <= 0.0:
            return
        rolled = data.step * np.maximum(np.abs(data.get("speed")), 0.1)
        by_load = np.maximum(1.0 + p["load"] * data.nominal.load_excess(state.normal_load), 0.05)
        slips = (
            ("slip_angle", data.simulation.slope_share, 1.0),
            ("slip_ratio", data.simulation.slope_share_x, p["along"]),
        )
        for slip, share, along in slips:
            length = p["length"] * (1.0 - p["fades"] + p["fades"] * share) * by_load * along
            step = rolled / np.maximum(length, 1e-9)
            setattr(state, slip, first_order(getattr(state, slip), step, data.start))

    def coefficients(self, tire: TireModel, p: Parameters) -> dict[str, float]:
        """PTY1, PTY2 and PTX1, so that the length at nominal load is the one found (MF 5.x).

        Nothing where the length was found to change with load.
        """
        if str(getattr(tire, "version", "5.2")).startswith("6") or p["load"]:
            return {}
        zero, unit = (relaxation_lengths(tire.replace(PTY1=one, PTY2=2.0, PTX1=one)) for one in (0.0, 1.0))
        across, along = (unit[slip] - zero[slip] for slip in ("slip_angle", "slip_ratio"))
        if not (across > 0.0 and along > 0.0):  # a scale factor of 0: no coefficient helps
            return {}
        sought = p["along"] * p["length"]
        return {"PTY1": p["length"] / across, "PTY2": 2.0, "PTX1": (sought - zero["slip_ratio"]) / along}
