"""Relaxation: the force needs a distance to build up."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.effects.base import Effect, Parameter, Parameters, State
from tire_pipeline.mismatch.effects.shared import first_order


class RelaxationLength(Effect):
    """Slip acts on the tire only after a distance rolled: a lag that is shorter at speed."""

    name = "relaxation_length"
    title = "relaxation length"
    equation = (
        "length / v d(slip')/dt + slip' = slip, forces from slip'; length *= slope(slip) "
        "/ slope(0) where `fades`"
    )
    source = "von Schlippe and Dietrich 1941; Pacejka, 3rd ed., 7.2 (PTX, PTY of MF 5.2)"
    needs_time = True
    dynamic = True
    parameters = (
        Parameter("length", "m", 0.0, 3.0, 0.02),
        Parameter("fades", "1", 0.0, 1.0, 0.1),
    )
    looks_like = {
        "time_delay": "a delay is the same at every speed",
        "low_pass": "a filter is the same at every speed",
    }
    experiment = "the same slip-angle sine at two speeds that differ by a factor of two or more"
    order = 30

    def absent(self, data: object) -> str | None:
        """Ask for speed besides (it need not vary)."""
        missing = super().absent(data)
        if missing is None and not data.has("speed"):  # type: ignore[attr-defined]
            missing = "speed is not recorded"
        return missing

    def starts(self, data: object) -> list[dict[str, float]]:
        """Two sizes, with the length constant or falling with slip."""
        return [{"length": s, "fades": f} for s in (0.1, 0.4) for f in (0.0, 1.0)]

    def free(self, data: object, start: Parameters) -> tuple[str, ...]:
        """Return the length; the form is one of the two."""
        return ("length",)

    def inputs(self, state: State, data: object, p: Parameters) -> None:
        """Lag the slips."""
        if p["length"] <= 0.0:
            return
        step = data.step * np.maximum(np.abs(data.get("speed")), 0.1)  # type: ignore[attr-defined]
        for slip, share in (("slip_angle", data.slope_share), ("slip_ratio", data.slope_share_x)):  # type: ignore[attr-defined]
            length = p["length"] * (1.0 - p["fades"] + p["fades"] * share)
            gain = 1.0 - np.exp(-step / np.maximum(length, 1e-3))
            setattr(state, slip, first_order(getattr(state, slip), gain, data.start))  # type: ignore[attr-defined]

    def coefficients(self, tire: object, p: Parameters) -> dict[str, float]:
        """PTY1, PTY2 and PTX1, so that the length at nominal load is the one found (MF 5.x)."""
        c = tire.coefficients  # type: ignore[attr-defined]
        if str(getattr(tire, "version", "5.2")).startswith("6"):
            return {}
        radius = c.get("UNLOADED_RADIUS", 0.3)
        at_nominal = float(np.sin(2.0 * np.arctan(0.5)))
        return {"PTY1": p["length"] / (radius * at_nominal), "PTY2": 2.0, "PTX1": p["length"] / radius}
