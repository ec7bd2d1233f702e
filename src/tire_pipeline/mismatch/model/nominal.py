"""Nominal values of the model: load, pressure and speed, and whether it responds to camber."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.mismatch.model.channels import RecordedChannels, least_spread

Array = np.ndarray
OF_CAMBER = {
    "fx": frozenset(["PDX3", "RBX3"]),
    "fy": frozenset("PDY3 PEY4 PEY5 PKY3 PKY6 PKY7 PHY3 PVY3 PVY4 RBY4 RVY3".split()),
    "mz": frozenset("QBZ4 QBZ5 QDZ3 QDZ4 QDZ8 QDZ9 QDZ10 QDZ11 QEZ5 QHZ3 QHZ4 SSZ3 SSZ4".split()),
}
"""Coefficients through which each force of a model, and its aligning moment, answers to camber."""
_SHARE_OF_LEVEL = 0.1
"""Share of a recording that makes a level: so there are ten at most, and each costs a search."""
_PRESSURES_OF_FILE = ("NOMPRES", "INFLPRES")
_OF_PRESSURE = "PPX1 PPX2 PPX3 PPX4 PPY1 PPY2 PPY3 PPY4".split()


@dataclass(frozen=True)
class Scales:
    """What work, heat and time are measured by, so that parameters hold for other recordings too.

    Parameters
    ----------
    work : float
        Friction work of the whole recording, J.
    power : float
        Largest friction power, W.
    time_origin, time_span : float
        Begin and duration of the recording, s.
    """

    work: float = 1.0
    power: float = 1.0
    time_origin: float = 0.0
    time_span: float = 1.0


@dataclass(frozen=True)
class Reference:
    """What is taken over from the recording that was explained where a part of it, or another one, is used.

    What is None is found in the recording that is used.

    Parameters
    ----------
    scales : Scales, optional
    pressure_nominal, speed_nominal : float, optional
        At which the model is right, Pa and m/s.
    load_range : (low, high), optional
        Loads that the effects were fitted to, N.
    measured : set of str, optional
        Channels that were recorded.
    relaxes : bool
        Whether the forces follow slip as late as the file itself states.
    """

    scales: Scales | None = None
    pressure_nominal: float | None = None
    speed_nominal: float | None = None
    load_range: tuple[float, float] | None = None
    measured: Set[str] | None = None
    relaxes: bool = True

    def to_sidecar(self) -> dict[str, object]:
        """Return the numbers among it by name."""
        out: dict[str, object] = {}
        if self.scales is not None:
            out["scales"] = asdict(self.scales)
        if self.load_range is not None:
            out["load_range"] = dict(zip(("low", "high"), self.load_range, strict=True))
        stated = {"pressure_nominal": self.pressure_nominal, "speed_nominal": self.speed_nominal}
        return {**out, **{name: value for name, value in stated.items() if value is not None}}


@dataclass(frozen=True, eq=False)
class NominalConditions:
    """What a tire model refers to, beside a recording: load, pressure, speed, radius, camber.

    Parameters
    ----------
    tire : TireModel
    recording : RecordedChannels
    reference : Reference
        Of the recording that was explained, if it is another one.
    """

    tire: TireModel
    recording: RecordedChannels
    reference: Reference = Reference()

    @property
    def coefficients(self) -> Mapping[str, float]:
        """Coefficients of the model."""
        return self.tire.coefficients

    @cached_property
    def load(self) -> float:
        """Nominal load of the model, N; the median of the recording where it has none."""
        return float(self.coefficients.get("FNOMIN", np.median(self.recording.get("normal_load"))))

    @property
    def load_range(self) -> tuple[float, float]:
        """Least and largest load that the file says it holds for, N; infinite where it gives no range."""
        return loads_of_file(self.tire)

    @cached_property
    def radius(self) -> float:
        """Unloaded radius, m."""
        return float(self.coefficients.get("UNLOADED_RADIUS", ASSUMED_RADIUS))

    def load_excess(self, load: Array, right_at: float = 1.0) -> Array:
        """Return ``Fz / Fz0 - right_at``, which fades outside of the loads that the effects were fitted to.

        A line through the recorded loads does not hold at others: it goes to zero there, over the width of
        what was recorded, and the model that came in stays.
        """
        if self.reference.load_range is None:
            return load / self.load - right_at
        low, high = self.reference.load_range
        inside = np.clip(load, low, high)
        width = max(high - low, least_spread("normal_load", load))
        faded = 1.0 - np.abs(load - inside) / width
        return (inside / self.load - right_at) * np.maximum(faded, 0.0)

    @cached_property
    def pressure_levels(self) -> list[float]:
        """Pressures at which the model may be right, Pa: the file's, or the most common, others, the first.

        Others are those at which the recording stays, whatever their order. A pressure that drifts has none.
        """
        nominal = self.pressure
        if nominal == self.pressure_of_file:
            return [nominal]
        pressure = self.recording.smooth("pressure")
        least, found = least_spread("pressure", pressure), [nominal]
        for level in (*levels(self.recording.channels["pressure"], least), float(pressure[0])):
            if all(abs(level - other) > least for other in found):
                found.append(level)
        return found

    @cached_property
    def pressure_of_file(self) -> float | None:
        """Pressure at which the file says that it is right, Pa: the first of its values that was recorded."""
        c, missing = self.coefficients, self.tire.defaulted
        stated = [float(c.get(k, 0.0) or 0.0) for k in _PRESSURES_OF_FILE if k not in missing]
        pressure = self.recording.channels["pressure"]
        recorded = [p for p in stated if pressure.min() <= p <= pressure.max()]
        return next((p for p in recorded + stated if p > 0.0), None)

    @property
    def off_pressure(self) -> bool:
        """Whether the pressure stays at another one than that at which the file says that it is right."""
        stated = self.pressure_of_file if self.recording.has("pressure") else None
        return stated is not None and self._stays_off("pressure", stated)

    @property
    def off_camber(self) -> bool:
        """Whether the camber stays at one that is not zero, and that the file does not say it holds for."""
        *_, low, high = self.tire.ranges.get("camber", (np.inf, -np.inf))
        return self._stays_off("camber", 0.0) and not (
            low <= float(np.median(self.recording.channels["camber"])) <= high
        )

    def _stays_off(self, channel: str, value: float) -> bool:
        """Whether a channel is recorded and stays at another value than this one."""
        if not self.recording.has(channel) or self.recording.varies(channel):
            return False
        x = self.recording.channels[channel]
        return bool(abs(np.median(x) - value) > least_spread(channel, x))

    @cached_property
    def pressure(self) -> float:
        """Pressure at which the model is right, Pa.

        The file's if it was recorded, or if the recording stays at one other pressure; else the most common.
        """
        if self.reference.pressure_nominal is not None:
            return self.reference.pressure_nominal
        if self.off_pressure and self.pressure_of_file is not None:
            return self.pressure_of_file
        return self._stated("pressure", *_PRESSURES_OF_FILE)

    @cached_property
    def speed(self) -> float:
        """Speed at which the model is right, m/s: the file's if it was recorded, else the most common one."""
        if self.reference.speed_nominal is not None:
            return self.reference.speed_nominal
        return self._stated("speed", "LONGVL")

    def _stated(self, channel: str, *keys: str) -> float:
        """Return the first of some values of the file that the channel had, or its most common value."""
        c, missing = self.coefficients, self.tire.defaulted
        x = self.recording.channels[channel]
        for key in keys:
            value = float(c.get(key, 0.0) or 0.0)
            if key not in missing and x.min() <= value <= x.max():
                return value
        return most_common(x)

    @cached_property
    def speed_excess(self) -> Array:
        """``(v - v0) / v0``; v0 is LONGVL, else the speed that is most common."""
        v = self.recording.smooth("speed")
        return (v - self.speed) / self.speed

    @property
    def model_speed(self) -> Array | None:
        """Speed for the model, if it is recorded."""
        return self.recording.channels.get("speed") if self.recording.has("speed") else None

    @property
    def model_pressure(self) -> Array | None:
        """Pressure for the model, if it is recorded and the model asks for it."""
        if self.recording.has("pressure") and self.tire.version.startswith("6"):
            return self.recording.channels["pressure"]
        return None

    @cached_property
    def knows_camber(self) -> bool:
        """Whether the model's lateral force responds to camber."""
        return any(self.coefficients.get(key, 0.0) for key in OF_CAMBER["fy"])

    @cached_property
    def knows_pressure(self) -> bool:
        """Whether the model's forces answer to pressure: without a nominal one nothing is off it."""
        able = self.tire.version.startswith("6") and self.coefficients.get("NOMPRES", 0.0) > 0.0
        return able and any(self.coefficients.get(key, 0.0) for key in _OF_PRESSURE)


def loads_of_file(tire: TireModel) -> tuple[float, float]:
    """Return the least and the largest load that a file says it holds for, N; infinite without a range."""
    *_, low, high = tire.ranges.get("normal_load", (-np.inf, np.inf))
    return low, high


def levels(x: Array, least: float) -> list[float]:
    """Return the values at which a channel stays, the most common first.

    Parameters
    ----------
    x : ndarray, shape (n,)
    least : float
        What is nearer to each other is one level.

    Examples
    --------
    >>> levels(np.repeat([3.0, 2.0, 2.5, 9.0], [40, 50, 30, 1]), least=0.1)
    [2.0, 3.0, 2.5]
    """
    pieces = np.split(np.sort(x), np.flatnonzero(np.diff(np.sort(x)) > least) + 1)
    kept = [piece for piece in pieces if piece.size >= _SHARE_OF_LEVEL * x.size]
    return [float(np.median(piece)) for piece in sorted(kept, key=len, reverse=True)]


def most_common(x: Array) -> float:
    """Return the median of the fullest of equal bins, as many as the root of the number of values."""
    finite = x[np.isfinite(x)]
    if finite.size == 0:
        return 0.0
    counts, edges = np.histogram(finite, bins="sqrt")
    k = int(np.argmax(counts))
    inside = finite[(finite >= edges[k]) & (finite <= edges[k + 1])]
    return float(np.median(inside))
