"""What the model itself says: nominal load, pressure and speed, and whether it answers to camber."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.mismatch.model.channels import RecordedChannels
from tire_pipeline.mismatch.model.forces import plain_forces

Array = np.ndarray


class NominalConditions(RecordedChannels):
    """Nominal values of the model beside a recording; a part of `Data`."""

    @cached_property
    def load_nominal(self) -> float:
        """Nominal load of the model, N."""
        c = self.tire.coefficients
        return float(c.get("FNOMIN", np.median(self.get("normal_load"))))

    @cached_property
    def radius(self) -> float:
        """Unloaded radius, m."""
        return float(self.tire.coefficients.get("UNLOADED_RADIUS", ASSUMED_RADIUS))

    def load_excess(self, load: Array) -> Array:
        """Return ``(Fz - Fz0) / Fz0``, which fades outside of the loads that the effects were fitted to.

        A line through the recorded loads says nothing of others: it goes to zero there, over the width of
        what was recorded, and the model that came in stays.
        """
        excess = (load - self.load_nominal) / self.load_nominal
        known = self.fixed.get("load_range")
        if known is None:
            return excess
        low, high = known["low"], known["high"]
        inside = np.clip(load, low, high)
        faded = 1.0 - np.abs(load - inside) / max(high - low, 0.1 * self.load_nominal)
        return (inside - self.load_nominal) / self.load_nominal * np.maximum(faded, 0.0)

    @cached_property
    def pressure_levels(self) -> list[float]:
        """Pressures at which the model may be right, Pa: the file's, or the most common and the first."""
        nominal = self.pressure_nominal
        c, missing = self.tire.coefficients, getattr(self.tire, "defaulted", {})
        if any(c.get(k) == nominal and k not in missing for k in ("NOMPRES", "INFLPRES")):
            return [nominal]
        first = float(np.median(self.smooth("pressure")[: max(self.size // 20, 1)]))
        return [nominal] + ([first] if abs(first / nominal - 1.0) > 0.03 else [])

    @cached_property
    def pressure_nominal(self) -> float:
        """Pressure at which the model is right, Pa."""
        if "pressure_nominal" in self.fixed:
            return float(self.fixed["pressure_nominal"])
        c = self.tire.coefficients
        p = self.channels["pressure"]
        for key in ("NOMPRES", "INFLPRES"):
            value = float(c.get(key, 0.0) or 0.0)
            if key not in getattr(self.tire, "defaulted", {}) and p.min() * 0.7 < value < p.max() * 1.4:
                return value
        return most_common(p)

    @cached_property
    def speed_nominal(self) -> float:
        """Speed at which the model is right, m/s."""
        if "speed_nominal" in self.fixed:
            return float(self.fixed["speed_nominal"])
        value = float(self.tire.coefficients.get("LONGVL", 0.0) or 0.0)
        v = self.channels["speed"]
        defaulted = "LONGVL" in getattr(self.tire, "defaulted", {})
        return (
            value
            if value > 0.0 and not defaulted and v.min() * 0.8 < value < v.max() * 1.2
            else most_common(v)
        )

    @cached_property
    def speed_excess(self) -> Array:
        """``(v - v0) / v0``; v0 is LONGVL, else the speed that is most common."""
        v = self.smooth("speed")
        return (v - self.speed_nominal) / self.speed_nominal

    @property
    def model_speed(self) -> Array | None:
        """Speed for the model, if it is recorded."""
        return self.channels.get("speed") if "speed" in self.present else None

    @property
    def model_pressure(self) -> Array | None:
        """Pressure for the model, if it is recorded and the model asks for it."""
        if "pressure" in self.present and str(getattr(self.tire, "version", "")).startswith("6"):
            return self.channels["pressure"]
        return None

    @cached_property
    def knows_camber(self) -> bool:
        """Whether the model's lateral force answers to camber."""
        if "knows_camber" in self.fixed:
            return bool(self.fixed["knows_camber"])
        n = 41
        a = np.linspace(-0.1, 0.1, n)
        args = {"slip_angle": a, "slip_ratio": np.zeros(n), "normal_load": np.full(n, self.load_nominal)}
        f0 = plain_forces(self.tire, camber=np.zeros(n), **args)["fy"]
        f1 = plain_forces(self.tire, camber=np.full(n, 0.05), **args)["fy"]
        return bool(np.max(np.abs(f1 - f0)) > 0.002 * np.max(np.abs(f0)))


def most_common(x: Array) -> float:
    """Return the median of the fullest of 40 bins between the extremes."""
    finite = x[np.isfinite(x)]
    if finite.size == 0:
        return 0.0
    counts, edges = np.histogram(finite, bins=40)
    k = int(np.argmax(counts))
    inside = finite[(finite >= edges[k]) & (finite <= edges[k + 1])]
    return float(np.median(inside))
