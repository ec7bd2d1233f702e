"""States along the time line: friction power, work, heat, distance, wheel turns; a part of `Data`."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import State
from tire_pipeline.mismatch.effects.shared import first_order, harmonic_power
from tire_pipeline.mismatch.model.channels import SLOW, largest
from tire_pipeline.mismatch.model.simulated import Simulated

Array = np.ndarray
OF_A_TURN = (0.88, 1.06)
"""Of the circumference of a tire without load, what a wheel rolls in one turn."""


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
                out["power"] = max(largest(self.power), 1e-12)
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
        """Return friction power followed with a lag of first order, over the largest power.

        Times ``(1 + (lag / duration)^2)^0.5``: with a lag much longer than the recording it is friction work,
        of order one.
        """
        if "heat" in self.fixed:
            return self.fixed["heat"](lag)
        first = np.zeros(self.size, bool)
        first[0] = True
        assert self.power is not None  # asked only of effects that need a time line
        power = self.power.copy()
        power[0] = 0.0
        heat = first_order(power, 1.0 - np.exp(-self.step / max(lag, 1e-9)), first)
        return heat * np.hypot(1.0, lag / self.scales["time_span"]) / self.scales["power"]

    @cached_property
    def turns_resolved(self) -> bool:
        """Whether there are at least three samples a wheel turn, in at least half of the recording."""
        if self.time is None or "speed" not in self.present:
            return False
        turns = self._turns_a_sample
        return bool(np.mean((turns < 1.0 / 3.0) & (turns > 0.0)) >= 0.5)

    @property
    def _turns_a_sample(self) -> Array:
        return np.abs(self.get("speed")) * self.step / (2.0 * np.pi * self.radius)

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
        residual = residual - self.running_mean(residual, SLOW)
        residual = np.where(self._turns_a_sample < 0.5, residual, 0.0)
        if not wobbling:
            return [residual]
        slopes = [self.slope(name)[output] for name in wobbling]
        return [residual * slope / max(float(np.sqrt(np.mean(slope**2))), 1e-12) for slope in slopes]

    def _radius_of(self, signals: list[Array]) -> float:
        """Return the radius at which some signals together have most power once a turn.

        Wave numbers are one radian apart over the way that is looked at: power changes little between them.
        """
        way, firsts = self.wheel_way, np.flatnonzero(self.start)
        ends = np.append(firsts[1:], self.size)
        whole = max(float(way[-1] - way[0]), 1e-9)
        longest = max(float(np.max(way[ends - 1] - way[firsts])), 1e-9)
        low, high = (1.0 / (part * self.radius) for part in (max(OF_A_TURN), min(OF_A_TURN)))
        count = max(int((high - low) * longest), 1) + 1
        step = (high - low) / (count - 1)
        power = np.zeros(count)
        for first, end in zip(firsts, ends, strict=True):
            power += _power([signal[first:end] for signal in signals], way[first:end], low, step, count)
        middle = low + int(np.argmax(power)) * step
        half = min(int(step * whole) + 1, self.size)
        step /= half
        power = _power(signals, way, middle - half * step, step, 2 * half + 1)
        return 1.0 / (middle + (_top(power) - half) * step)

    def relax(self, state: State, names: set[str]) -> None:
        """Lag the slips by the relaxation that the file itself states (PTY1, PTX1), if it does."""
        own = self.fixed.get("own_relaxation")
        if own is None or self.time is None or "speed" not in self.present:
            return
        if any(catalogue()[name].instead_of_file for name in names):
            return
        rolled = np.abs(self.get("speed")) * self.step
        for slip, length in own.items():
            gain = 1.0 - np.exp(-rolled / max(length, 1e-9))
            setattr(state, slip, first_order(getattr(state, slip), gain, self.start))


def _power(signals: list[Array], way: Array, first: float, step: float, count: int) -> Array:
    """Return the power of some signals together at the wave numbers ``first, first + step, ...``."""
    return np.sum([harmonic_power(signal, way, first, step, count) ** 2 for signal in signals], axis=0)


def _top(power: Array) -> float:
    """Return where the parabola through the largest value and its neighbours has its top, in steps."""
    k = int(np.clip(np.argmax(power), 1, power.size - 2))
    before, here, after = power[k - 1 : k + 2]
    bend = before - 2.0 * here + after
    return k + (0.5 * float((before - after) / bend) if bend < 0.0 else 0.0)
