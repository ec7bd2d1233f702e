"""States along the time line: friction power, work, heat, distance."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tire_pipeline.mismatch.effects.shared import first_order
from tire_pipeline.mismatch.model.channels import RecordedChannels, largest
from tire_pipeline.mismatch.model.nominal import Scales
from tire_pipeline.mismatch.model.simulated import BaseSimulation

Array = np.ndarray


def followed_from_cold(power: Array, step: Array, lag: float) -> Array:
    """Return a power, shape (n,), followed with a lag of first order, s, from a cold start; ``step`` in s."""
    power, first = power.copy(), np.zeros(power.size, bool)
    power[0], first[0] = 0.0, True
    return np.asarray(first_order(power, step / max(lag, 1e-9), first))


@dataclass(frozen=True, eq=False)
class States:
    """What builds up while the tire rolls, from the model's own forces.

    Parameters
    ----------
    simulation : BaseSimulation
    """

    simulation: BaseSimulation

    @property
    def _recording(self) -> RecordedChannels:
        return self.simulation.recording

    @cached_property
    def scales(self) -> Scales:
        """What work, heat and time are measured by, so that parameters hold for other recordings too."""
        known = self.simulation.nominal.reference.scales
        if known is not None:
            return known
        time = self._recording.time
        if time is None:
            return Scales()
        begin, span = float(time[0]), max(float(time[-1] - time[0]), 1e-12)
        if self.power is None:
            return Scales(time_origin=begin, time_span=span)
        work = max(float(np.sum(self.power * self._recording.step)), 1e-12)
        return Scales(work, max(largest(self.power), 1e-12), begin, span)

    @property
    def time_span(self) -> float:
        """Duration of the recording that was explained, s."""
        return self.scales.time_span

    @cached_property
    def power(self) -> Array | None:
        """Friction power ``|Fy v sin a| + |Fx v k|`` of the model, W."""
        recording = self._recording
        if recording.time is None or not recording.has("speed"):
            return None
        v = np.abs(recording.get("speed"))
        f = self.simulation.both_forces
        out = np.abs(f["fy"] * v * np.sin(recording.get("slip_angle"))) + np.abs(
            f["fx"] * v * recording.get("slip_ratio")
        )
        return np.asarray(out)

    @property
    def _known_power(self) -> Array:
        """Friction power, W, where only a recording with time and speed is asked."""
        assert self.power is not None
        return self.power

    @cached_property
    def work(self) -> Array:
        """Friction work so far over all of it (of the recording that was explained)."""
        w = np.cumsum(self._known_power * self._recording.step)
        return w / self.scales.work

    @cached_property
    def elapsed(self) -> Array:
        """Time so far over all of it."""
        return np.asarray((self._recording.time_line - self.scales.time_origin) / self.scales.time_span)

    @cached_property
    def distance(self) -> Array:
        """Distance rolled, m."""
        return np.cumsum(np.abs(self._recording.get("speed")) * self._recording.step)

    def heat(self, lag: float) -> Array:
        """Return friction power followed with a lag of first order, over the largest power.

        Times ``(1 + (lag / duration)^2)^0.5``: with a lag much longer than the recording it is friction work,
        of order one.
        """
        heat = followed_from_cold(self._known_power, self._recording.step, lag)
        return heat * np.hypot(1.0, lag / self.scales.time_span) / self.scales.power


@dataclass(frozen=True, eq=False)
class StatesOfPart:
    """States at some rows of a recording, integrated over all of it.

    Parameters
    ----------
    whole : States or StatesOfPart
        Of all rows.
    rows : ndarray of bool, shape (n,)
    """

    whole: States | StatesOfPart
    rows: Array

    @property
    def scales(self) -> Scales:
        """Those of the whole recording."""
        return self.whole.scales

    @property
    def time_span(self) -> float:
        """Duration of the whole recording, s."""
        return self.whole.time_span

    @cached_property
    def power(self) -> Array | None:
        """Friction power of the model, W."""
        return None if self.whole.power is None else self.whole.power[self.rows]

    @cached_property
    def work(self) -> Array:
        """Friction work so far over all of it."""
        return self.whole.work[self.rows]

    @cached_property
    def elapsed(self) -> Array:
        """Time so far over all of it."""
        return self.whole.elapsed[self.rows]

    @cached_property
    def distance(self) -> Array:
        """Distance rolled, m."""
        return self.whole.distance[self.rows]

    def heat(self, lag: float) -> Array:
        """Return friction power followed with a lag of first order, over the largest power."""
        return self.whole.heat(lag)[self.rows]
