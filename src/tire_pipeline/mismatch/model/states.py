"""States along the time line: friction power, work, heat, distance, wheel turns; a part of `Data`."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import State
from tire_pipeline.mismatch.effects.shared import first_order, harmonic_power
from tire_pipeline.mismatch.model.simulated import Simulated

Array = np.ndarray
_MOST_WAVES = 4000


class States(Simulated):
    """What builds up while the tire rolls, from the model's own forces."""

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
        """Return friction power followed with a lag of first order, over the power's 90% quantile.

        Times ``(1 + (lag / duration)^2)^0.5``: with a lag much longer than the recording it is friction work,
        of order one.
        """
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
            cache[key] = h * np.hypot(1.0, lag / self.scales["time_span"]) / self.scales["power"]
        return cache[key]

    @cached_property
    def turns_resolved(self) -> bool:
        """Whether there are at least three samples a wheel turn, in at least half of the recording."""
        if self.time is None or "speed" not in self.present:
            return False
        turns = np.abs(self.get("speed")) * self.step / (2.0 * np.pi * self.radius)
        return bool(np.mean((turns < 0.34) & (turns > 1e-4)) > 0.4)

    @cached_property
    def wheel_way(self) -> Array:
        """Distance that the wheel rolled, m: in a pause it rolls on at the speed around it."""
        if "wheel_way" in self.fixed:
            return self.fixed["wheel_way"]
        assert self.time is not None  # asked only of effects that need a time line
        speed = np.abs(self.get("speed"))
        way = np.zeros(self.size)
        way[1:] = np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(self.time))
        return way

    def rolling_radius(self, wobbling: tuple[str, ...] = ()) -> float:
        """Return the rolling radius (m) at which the residual has most power once a turn.

        First by the power of each piece of the recording by itself, then by all of it in one phase, near the
        radius so found: the wheel rolls on in the pauses, and a long recording tells radii apart that no
        single piece does.

        Parameters
        ----------
        wobbling : tuple of str
            Channels that wobble once a turn. The force follows by its slope there, which changes with the
            slip, so that the power of the force itself lies beside the wheel's frequency. None: the force
            has a harmonic of its own.
        """
        key = " ".join(("radius", *wobbling))
        if key not in self.fixed:
            self.fixed[key] = self._radius_of(self._once_a_turn(wobbling))
        return float(self.fixed[key])

    def _once_a_turn(self, wobbling: tuple[str, ...]) -> list[Array]:
        """Return the fast part of the residual, times what each wobbling channel would do to the force."""
        output = self.outputs[-1]
        residual = self.recorded[output] - self.base[output]
        residual = residual - self.running_mean(residual, 0.4)
        turns = np.abs(self.get("speed")) * self.step / (2.0 * np.pi * self.radius)
        residual = np.where(turns < 0.4, residual, 0.0)
        if not wobbling:
            return [residual]
        steps = {"slip_angle": 2e-3, "normal_load": 0.01 * self.load_nominal}
        slopes = [self.slope(name, steps[name])[output] for name in wobbling]
        return [residual * slope / max(float(np.sqrt(np.mean(slope**2))), 1e-12) for slope in slopes]

    def _radius_of(self, signals: list[Array]) -> float:
        """Return the radius at which some signals together have most power once a turn."""
        way, firsts = self.wheel_way, np.flatnonzero(self.start)
        ends = np.append(firsts[1:], self.size)
        span = max(float(way[-1] - way[0]), 1e-9)
        longest = max(float(np.max(way[ends - 1] - way[firsts])), 1e-9)
        low, high = 1.0 / (1.04 * self.radius), 1.0 / (0.9 * self.radius)
        count = int(np.clip((high - low) * longest / 0.8, 2, _MOST_WAVES))
        step = (high - low) / (count - 1)
        power = np.zeros(count)
        for first, end in zip(firsts, ends, strict=True):
            power += _power([signal[first:end] for signal in signals], way[first:end], low, step, count)
        best = low + int(np.argmax(power)) * step
        half = int(np.clip(np.ceil(step * span / 0.8), 1, _MOST_WAVES // 2))
        for width, points in ((step, half), (step / half, 20)):
            power = _power(signals, way, best - width, width / points, 2 * points + 1)
            best += (int(np.argmax(power)) - points) * width / points
        return 1.0 / best

    def relax(self, state: State, names: set[str]) -> None:
        """Lag the slips by the relaxation that the file itself states (PTY1, PTX1), if it does."""
        own = self.fixed.get("own_relaxation")
        if own is None or self.time is None or "speed" not in self.present:
            return
        if any(catalogue()[name].instead_of_file for name in names):
            return
        speed = np.maximum(np.abs(self.get("speed")), 0.1)
        for slip, length in own.items():
            gain = 1.0 - np.exp(-self.step * speed / max(length, 1e-3))
            setattr(state, slip, first_order(getattr(state, slip), gain, self.start))


def _power(signals: list[Array], way: Array, first: float, step: float, count: int) -> Array:
    """Return the power of some signals together at the wave numbers ``first, first + step, ...``."""
    return np.sum([harmonic_power(signal, way, first, step, count) ** 2 for signal in signals], axis=0)
