"""The wheel's turns: how far it rolled, and the radius at which something comes back once a turn."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from tire_pipeline.mismatch.effects.shared import harmonic_power
from tire_pipeline.mismatch.model.channels import SLOW, RecordedChannels
from tire_pipeline.mismatch.model.simulated import BaseSimulation

Array = np.ndarray
OF_A_TURN = (0.88, 1.06)
"""Of the circumference of a tire without load, what a wheel rolls in one turn."""


@dataclass(frozen=True, eq=False)
class Wheel:
    """The wheel of a recording.

    Parameters
    ----------
    simulation : BaseSimulation
    known_way : ndarray, shape (n,), optional
        How far the wheel had rolled, m, if another recording tells: all of it for a part, the one that was
        explained for the same one again. NaN where it is not known.
    """

    simulation: BaseSimulation
    known_way: Array | None = None
    _radii: dict[tuple[str, ...], float] = field(default_factory=dict, init=False, repr=False)

    @property
    def _recording(self) -> RecordedChannels:
        return self.simulation.recording

    @cached_property
    def way(self) -> Array:
        """Distance that the wheel rolled, m: in a pause it rolls on at the speed around it."""
        if self.known_way is not None:
            return self.known_way
        return way_rolled(self._recording.get("speed"), self._recording.time_line)

    @cached_property
    def turns_resolved(self) -> bool:
        """Whether there are at least three samples a wheel turn, in at least half of the recording."""
        if self._recording.time is None or not self._recording.has("speed"):
            return False
        turns = self._turns_a_sample
        return bool(np.mean((turns < 1.0 / 3.0) & (turns > 0.0)) >= 0.5)

    @property
    def _turns_a_sample(self) -> Array:
        radius = self.simulation.nominal.radius
        return np.abs(self._recording.get("speed")) * self._recording.step / (2.0 * np.pi * radius)

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
        if wobbling not in self._radii:
            self._radii[wobbling] = self._radius_of(self._once_a_turn(wobbling))
        return self._radii[wobbling]

    def _once_a_turn(self, wobbling: tuple[str, ...]) -> list[Array]:
        """Return the fast part of the residual, times what each wobbling channel would do to the force."""
        output = self._recording.outputs[-1]
        residual = self._recording.recorded[output] - self.simulation.base[output]
        residual = residual - self._recording.running_mean(residual, SLOW)
        residual = np.where(self._turns_a_sample < 0.5, residual, 0.0)
        if not wobbling:
            return [residual]
        slopes = [self.simulation.slope(name)[output] for name in wobbling]
        return [residual * slope / max(float(np.sqrt(np.mean(slope**2))), 1e-12) for slope in slopes]

    def _radius_of(self, signals: list[Array]) -> float:
        """Return the radius at which some signals together have most power once a turn.

        Wave numbers are one radian apart over the way that is looked at: power changes little between them.
        """
        way, firsts = self.way, np.flatnonzero(self._recording.start)
        ends = np.append(firsts[1:], self._recording.size)
        whole = max(float(way[-1] - way[0]), 1e-9)
        longest = max(float(np.max(way[ends - 1] - way[firsts])), 1e-9)
        low, high = (
            1.0 / (part * self.simulation.nominal.radius) for part in (max(OF_A_TURN), min(OF_A_TURN))
        )
        count = max(int((high - low) * longest), 1) + 1
        step = (high - low) / (count - 1)
        power = np.zeros(count)
        for first, end in zip(firsts, ends, strict=True):
            power += _power([signal[first:end] for signal in signals], way[first:end], low, step, count)
        middle = low + int(np.argmax(power)) * step
        half = min(int(step * whole) + 1, self._recording.size)
        step /= half
        power = _power(signals, way, middle - half * step, step, 2 * half + 1)
        return 1.0 / (middle + (_top(power) - half) * step)


def way_rolled(speed: Array, time: Array) -> Array:
    """Return how far a wheel rolled since the first sample, m, at the mean speed of each two neighbours.

    Parameters
    ----------
    speed, time : ndarray, shape (n,)
        m/s, s.
    """
    fast = np.abs(speed)
    return np.concatenate([[0.0], np.cumsum(0.5 * (fast[1:] + fast[:-1]) * np.diff(time))])


def _power(signals: list[Array], way: Array, first: float, step: float, count: int) -> Array:
    """Return the power of some signals together at the wave numbers ``first, first + step, ...``."""
    return np.sum([harmonic_power(signal, way, first, step, count) ** 2 for signal in signals], axis=0)


def _top(power: Array) -> float:
    """Return where the parabola through the largest value and its neighbours has its top, in steps."""
    k = int(np.clip(np.argmax(power), 1, power.size - 2))
    before, here, after = power[k - 1 : k + 2]
    bend = before - 2.0 * here + after
    return k + (0.5 * float((before - after) / bend) if bend < 0.0 else 0.0)
