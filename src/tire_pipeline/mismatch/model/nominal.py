"""What the model itself says: nominal load, pressure and speed, and whether it answers to camber."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.mismatch.model.channels import RecordedChannels, least_spread

Array = np.ndarray
OF_CAMBER = {
    "fx": frozenset(["PDX3", "RBX3"]),
    "fy": frozenset("PDY3 PEY4 PEY5 PKY3 PKY6 PKY7 PHY3 PVY3 PVY4 RBY4 RVY3".split()),
}
"""Coefficients through which each force of a model answers to camber."""
_PRESSURES_OF_FILE = ("NOMPRES", "INFLPRES")


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
        width = max(high - low, least_spread("normal_load", load))
        faded = 1.0 - np.abs(load - inside) / width
        return (inside - self.load_nominal) / self.load_nominal * np.maximum(faded, 0.0)

    @cached_property
    def pressure_levels(self) -> list[float]:
        """Pressures at which the model may be right, Pa: the file's, or the most common and the first."""
        nominal = self.pressure_nominal
        if nominal == self.pressure_of_file:
            return [nominal]
        pressure = self.smooth("pressure")
        first = float(pressure[0])
        return [nominal] + ([first] if abs(first - nominal) > least_spread("pressure", pressure) else [])

    @cached_property
    def pressure_of_file(self) -> float | None:
        """Pressure at which the file says that it is right, Pa: the first of its values that was recorded."""
        c, missing = self.tire.coefficients, getattr(self.tire, "defaulted", {})
        stated = [float(c.get(k, 0.0) or 0.0) for k in _PRESSURES_OF_FILE if k not in missing]
        pressure = self.channels["pressure"]
        recorded = [p for p in stated if pressure.min() <= p <= pressure.max()]
        return next((p for p in recorded + stated if p > 0.0), None)

    @property
    def off_pressure(self) -> bool:
        """Whether the pressure stays at another one than that at which the file says that it is right."""
        if "pressure" not in self.present or self.varies("pressure") or self.pressure_of_file is None:
            return False
        pressure = self.channels["pressure"]
        return bool(abs(np.median(pressure) - self.pressure_of_file) > least_spread("pressure", pressure))

    @cached_property
    def pressure_nominal(self) -> float:
        """Pressure at which the model is right, Pa.

        The file's if it was recorded, or if the recording stays at one other pressure; else the most common.
        """
        if "pressure_nominal" in self.fixed:
            return float(self.fixed["pressure_nominal"])
        if self.off_pressure and self.pressure_of_file is not None:
            return self.pressure_of_file
        return self._stated("pressure", *_PRESSURES_OF_FILE)

    @cached_property
    def speed_nominal(self) -> float:
        """Speed at which the model is right, m/s: the file's if it was recorded, else the most common one."""
        if "speed_nominal" in self.fixed:
            return float(self.fixed["speed_nominal"])
        return self._stated("speed", "LONGVL")

    def _stated(self, channel: str, *keys: str) -> float:
        """Return the first of some values of the file that the channel had, or its most common value."""
        c, missing = self.tire.coefficients, getattr(self.tire, "defaulted", {})
        x = self.channels[channel]
        for key in keys:
            value = float(c.get(key, 0.0) or 0.0)
            if key not in missing and x.min() <= value <= x.max():
                return value
        return most_common(x)

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
        c = self.tire.coefficients
        return any(c.get(key, 0.0) for key in OF_CAMBER["fy"])


def most_common(x: Array) -> float:
    """Return the median of the fullest of equal bins, as many as the root of the number of values."""
    finite = x[np.isfinite(x)]
    if finite.size == 0:
        return 0.0
    counts, edges = np.histogram(finite, bins="sqrt")
    k = int(np.argmax(counts))
    inside = finite[(finite >= edges[k]) & (finite <= edges[k + 1])]
    return float(np.median(inside))
