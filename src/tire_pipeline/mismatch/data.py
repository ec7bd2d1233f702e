"""The recording made ready for the search: channels as arrays, states, base simulation, noise."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from tire_pipeline.mismatch.effects.base import State
from tire_pipeline.mismatch.effects.shared import first_order
from tire_pipeline.mismatch.simulate import plain_forces, simulate

Array = np.ndarray
_RELATIVE_SPREAD = {"pressure": 0.03, "speed": 0.12, "normal_load": 0.1}
_ABSOLUTE_SPREAD = {
    "camber": 0.008,
    "tread_temperature": 4.0,
    "slip_angle": 0.005,
    "slip_ratio": 0.01,
    "turn_slip": 0.003,
}


@dataclass
class Data:
    """A recording (or a part of it) beside its tire model.

    Parameters
    ----------
    tire : TireModel
    channels : dict of ndarray, shape (n,)
        SI; slip_angle, slip_ratio, camber, normal_load are always there.
    recorded : dict of ndarray, shape (n,)
        fx and or fy, N.
    time : ndarray, shape (n,), optional
        s, rising.
    start : ndarray of bool, shape (n,)
        First samples of uninterrupted pieces.
    present : set of str
        Channels that the recording really has.
    beside : dict of ndarray, optional
        What another simulator has beyond the tire model that stands in for it, N.
    """

    tire: Any
    channels: dict[str, Array]
    recorded: dict[str, Array]
    time: Array | None
    start: Array
    present: set[str]
    beside: dict[str, Array] | None = None
    fixed: dict[str, Any] = field(default_factory=dict)

    @property
    def size(self) -> int:
        """Number of samples."""
        return self.channels["normal_load"].size

    @property
    def outputs(self) -> tuple[str, ...]:
        """Forces that are recorded."""
        return tuple(self.recorded)

    def driven(self, output: str) -> bool:
        """Whether the slips make this force move, so that its size can be judged."""
        sizes = {n: float(np.quantile(np.abs(b), 0.98)) for n, b in self.base.items()}
        return sizes[output] > 0.15 * max(sizes.values())

    @property
    def tire_coefficients(self) -> Any:
        """Coefficients of the model."""
        return self.tire.coefficients

    def get(self, name: str) -> Array:
        """Return one channel."""
        return self.channels[name]

    def has(self, name: str) -> bool:
        """Whether the recording has the channel."""
        return name in self.present

    def varies(self, name: str) -> bool:
        """Whether the channel is there and moves by more than sensors do."""
        if name not in self.present:
            return False
        known = self.fixed.get("varies")
        if known is not None:
            return bool(known[name])
        low, high = np.quantile(self.smooth(name), [0.005, 0.995])
        least = _ABSOLUTE_SPREAD.get(name, 0.0)
        if name in _RELATIVE_SPREAD:
            least = _RELATIVE_SPREAD[name] * abs(float(np.median(self.channels[name])))
        return bool(high - low > least)

    def smooth(self, name: str) -> Array:
        """Return a slow channel without its sensor noise: a running mean over half a second."""
        key = f"smooth {name}"
        if key not in self.fixed:
            self.fixed[key] = self._running_mean(self.channels[name], 0.5)
        return self.fixed[key]

    def _running_mean(self, x: Array, seconds: float) -> Array:
        if self.time is None or x.size < 8:
            return x
        half = int(max(seconds / max(float(np.median(self.step)), 1e-9), 1.0)) // 2
        if half < 1:
            return x
        total = np.concatenate([[0.0], np.cumsum(x)])
        firsts = np.flatnonzero(self.start)
        piece = np.cumsum(self.start) - 1
        first = firsts[piece]
        last = np.append(firsts[1:], x.size)[piece]
        i = np.arange(x.size)
        a, b = np.maximum(i - half, first), np.minimum(i + half + 1, last)
        return (total[b] - total[a]) / (b - a)

    @cached_property
    def step(self) -> Array:
        """Time step that ends at each sample, s."""
        if self.time is None:
            return np.zeros(self.size)
        d = np.diff(self.time, prepend=self.time[0])
        d[self.start] = 0.0
        typical = float(np.median(d[d > 0.0])) if np.any(d > 0.0) else 0.0
        d[self.start] = typical
        return d

    @cached_property
    def load_nominal(self) -> float:
        """Nominal load of the model, N."""
        c = self.tire.coefficients
        return float(c.get("FNOMIN", np.median(self.get("normal_load"))))

    @cached_property
    def radius(self) -> float:
        """Unloaded radius, m."""
        return float(self.tire.coefficients.get("UNLOADED_RADIUS", 0.32))

    def load_excess(self, load: Array) -> Array:
        """Return ``(Fz - Fz0) / Fz0``."""
        return (load - self.load_nominal) / self.load_nominal

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
    def base(self) -> dict[str, Array]:
        """The simulation as it is, N."""
        return simulate(self)

    @cached_property
    def all_base(self) -> dict[str, Array]:
        """fx and fy of the model, recorded or not, N."""
        return plain_forces(
            self.tire,
            slip_angle=self.get("slip_angle"),
            slip_ratio=self.get("slip_ratio"),
            camber=self.get("camber"),
            normal_load=self.get("normal_load"),
            speed=self.model_speed,
            pressure=self.model_pressure,
        )

    @cached_property
    def base_fy(self) -> Array:
        """Lateral force of the model, N."""
        return self.all_base["fy"]

    def turned_by_force(self, slip_angle: Array, steer: float) -> Array:
        """Return ``slip_angle - steer Fy`` with the force Fy that the model then gives.

        The recorded force would bring its own noise into the slip angle.
        """
        force, turned = self.base_fy, slip_angle
        for _ in range(4):
            turned = slip_angle - steer * force
            force = plain_forces(
                self.tire,
                slip_angle=turned,
                slip_ratio=self.get("slip_ratio"),
                camber=self.get("camber"),
                normal_load=self.get("normal_load"),
                speed=self.model_speed,
                pressure=self.model_pressure,
            )["fy"]
        return turned

    def slope(self, name: str, step: float) -> dict[str, Array]:
        """Return d force / d channel of the model by central differences."""
        key = f"slope {name}"
        if key not in self.fixed:
            out: dict[str, Array] = {}
            for sign in (1.0, -1.0):
                c = {n: self.get(n) for n in ("slip_angle", "slip_ratio", "camber", "normal_load")}
                c[name] = c[name] + sign * step
                f = plain_forces(self.tire, speed=self.model_speed, pressure=self.model_pressure, **c)
                for axis, value in f.items():
                    out[axis] = out.get(axis, 0.0) + sign * value / (2.0 * step)
            self.fixed[key] = out
        return self.fixed[key]

    def _stiffness(self, axis: str) -> float:
        """Slip stiffness at nominal load, N per unit of slip, positive."""
        h = 1e-3
        a = np.array([h, -h]) if axis == "fy" else np.zeros(2)
        k = np.array([h, -h]) if axis == "fx" else np.zeros(2)
        f = plain_forces(
            self.tire,
            slip_angle=a,
            slip_ratio=k,
            camber=np.zeros(2),
            normal_load=np.full(2, self.load_nominal),
        )[axis]
        return float(max(abs(f[0] - f[1]) / (2.0 * h), 1e-9))

    @cached_property
    def slope_share(self) -> Array:
        """|dFy/d slip angle| over the cornering stiffness at nominal load, 0.03 to 2."""
        share = np.abs(self.slope("slip_angle", 2e-3)["fy"]) / self._stiffness("fy")
        return np.clip(share, 0.03, 2.0)

    @cached_property
    def slope_share_x(self) -> Array:
        """|dFx/d slip ratio| over the slip stiffness at nominal load, 0.03 to 2."""
        share = np.abs(self.slope("slip_ratio", 2e-3)["fx"]) / self._stiffness("fx")
        return np.clip(share, 0.03, 2.0)

    @cached_property
    def power(self) -> Array | None:
        """Friction power ``|Fy v sin a| + |Fx v k|`` of the model, W."""
        if self.time is None or "speed" not in self.present:
            return None
        if "power" in self.fixed:
            return self.fixed["power"]
        v = np.abs(self.get("speed"))
        f = self.all_base
        out = np.abs(f["fy"] * v * np.sin(self.get("slip_angle"))) + np.abs(
            f["fx"] * v * self.get("slip_ratio")
        )
        return np.asarray(out)

    @cached_property
    def work(self) -> Array:
        """Friction work so far over all of it (of the recording that was explained)."""
        if "work" in self.fixed:
            return self.fixed["work"]
        w = np.cumsum(self.power * self.step)
        return w / self.scales["work"]

    @cached_property
    def scales(self) -> dict[str, float]:
        """What work, heat and time are measured by, so that parameters hold for other recordings too."""
        if "scales" in self.fixed:
            return self.fixed["scales"]
        out = {"work": 1.0, "power": 1.0, "time_origin": 0.0, "time_span": 1.0}
        if self.time is not None:
            out["time_origin"] = float(self.time[0])
            out["time_span"] = max(float(self.time[-1] - self.time[0]), 1e-12)
            if self.power is not None:
                out["work"] = max(float(np.sum(self.power * self.step)), 1e-12)
                out["power"] = max(float(np.quantile(self.power, 0.9)), 1e-12)
        return out

    @cached_property
    def elapsed(self) -> Array:
        """Time so far over all of it."""
        if "elapsed" in self.fixed:
            return np.asarray(self.fixed["elapsed"])
        assert self.time is not None  # asked only of effects that need a time line
        return np.asarray((self.time - self.scales["time_origin"]) / self.scales["time_span"])

    @cached_property
    def distance(self) -> Array:
        """Distance rolled, m."""
        if "distance" in self.fixed:
            return self.fixed["distance"]
        return np.cumsum(np.abs(self.get("speed")) * self.step)

    def heat(self, lag: float) -> Array:
        """Return friction power followed with a lag of first order, over its 90% quantile."""
        if "heat" in self.fixed:
            return self.fixed["heat"](lag)
        key = round(float(lag), 2)
        cache = self.fixed.setdefault("heats", {})
        if key not in cache:
            first = np.zeros(self.size, bool)
            first[0] = True
            assert self.power is not None  # asked only of effects that need a time line
            power = self.power.copy()
            power[0] = 0.0
            h = first_order(power, 1.0 - np.exp(-self.step / max(lag, 1e-3)), first)
            if len(cache) > 40:
                cache.clear()
            cache[key] = h / self.scales["power"]
        return cache[key]

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

    @cached_property
    def has_combined(self) -> bool:
        """Whether both slips are large together in at least 1% of the samples (50 at least, 5 of points)."""
        both = (np.abs(self.get("slip_angle")) > 0.015) & (np.abs(self.get("slip_ratio")) > 0.02)
        least = 5 if self.time is None else max(50, 0.005 * self.size)
        return bool(both.sum() >= least)

    @cached_property
    def turns_resolved(self) -> bool:
        """Whether there are at least three samples a wheel turn, in at least half of the recording."""
        if self.time is None or "speed" not in self.present:
            return False
        turns = np.abs(self.get("speed")) * self.step / (2.0 * np.pi * self.radius)
        return bool(np.mean((turns < 0.34) & (turns > 1e-4)) > 0.4)

    def rolling_radii(self) -> list[float]:
        """Return the rolling radius (m) at which the residual has most power once a turn."""
        if "radius" in self.fixed:
            return [self.fixed["radius"]]
        residual = self.recorded[self.outputs[-1]] - self.base[self.outputs[-1]]
        residual = residual - self._running_mean(residual, 0.4)
        turns = np.abs(self.get("speed")) * self.step / (2.0 * np.pi * self.radius)
        residual = np.where(turns < 0.4, residual, 0.0)
        rolled = self.distance
        span = max(float(rolled[-1] - rolled[0]), 1e-9)
        per_metre = np.arange(1.0 / (1.04 * self.radius), 1.0 / (0.9 * self.radius), 0.8 / span)
        if per_metre.size > 4000:
            per_metre = np.linspace(per_metre[0], per_metre[-1], 4000)
        power = np.array([np.abs(np.sum(residual * np.exp(-1j * rolled * k))) for k in per_metre])
        self.fixed["radius"] = float(1.0 / per_metre[int(np.argmax(power))])
        return [self.fixed["radius"]]

    def relax(self, state: State, names: set[str]) -> None:
        """Lag the slips by the relaxation that the file itself states (PTY1, PTX1), if it does."""
        own = self.fixed.get("own_relaxation")
        if own is None or "relaxation_length" in names or self.time is None:
            return
        speed = np.maximum(np.abs(self.get("speed")), 0.1)
        for slip, length in own.items():
            gain = 1.0 - np.exp(-self.step * speed / max(length, 1e-3))
            setattr(state, slip, first_order(getattr(state, slip), gain, self.start))

    def part(self, rows: Array) -> Data:
        """Return the rows of ``rows`` (bool), states taken over from the whole recording."""
        fixed: dict[str, Any] = {k: v for k, v in self.fixed.items() if not isinstance(v, (np.ndarray, dict))}
        fixed["own_relaxation"] = self.fixed.get("own_relaxation")
        fixed["scales"] = self.scales
        fixed["varies"] = {n: self.varies(n) for n in self.present}
        fixed["knows_camber"] = self.knows_camber
        for name in ("pressure", "speed", "tread_temperature"):
            if name in self.present:
                fixed[f"smooth {name}"] = self.smooth(name)[rows]
        if "pressure" in self.present:
            fixed["pressure_nominal"] = self.pressure_nominal
        if "speed" in self.present:
            fixed["speed_nominal"] = self.speed_nominal
        if self.time is not None:
            fixed["elapsed"] = self.elapsed[rows]
            if self.power is not None:
                fixed["distance"] = self.distance[rows]
                fixed["power"] = self.power[rows]
                fixed["work"] = self.work[rows]
                fixed["heat"] = lambda lag: self.heat(lag)[rows]
        index = np.flatnonzero(rows)
        start = self.start[rows].copy()
        start[np.flatnonzero(np.diff(index, prepend=index[0] - 2) > 1)] = True
        return Data(
            tire=self.tire,
            channels={n: c[rows] for n, c in self.channels.items()},
            recorded={n: c[rows] for n, c in self.recorded.items()},
            time=None if self.time is None else self.time[rows],
            start=start,
            present=self.present,
            beside=None if self.beside is None else {n: c[rows] for n, c in self.beside.items()},
            fixed=fixed,
        )


def most_common(x: Array) -> float:
    """Return the median of the fullest of 40 bins between the extremes."""
    finite = x[np.isfinite(x)]
    if finite.size == 0:
        return 0.0
    counts, edges = np.histogram(finite, bins=40)
    k = int(np.argmax(counts))
    inside = finite[(finite >= edges[k]) & (finite <= edges[k + 1])]
    return float(np.median(inside))
