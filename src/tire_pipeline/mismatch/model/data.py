"""The recording made ready: channels as arrays, states, base simulation, noise."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from tire_pipeline.channels import FORCE_OF_SLIP
from tire_pipeline.mismatch.model.channels import ABSOLUTE_SPREAD, SMALL, largest
from tire_pipeline.mismatch.model.states import States

Array = np.ndarray


@dataclass
class Data(States):
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

    def driven(self, output: str) -> bool:
        """Whether this force is there and the slips make it move, so that its size can be judged."""
        sizes = {n: largest(b) for n, b in self.base.items()}
        return sizes.get(output, 0.0) > SMALL * max(sizes.values())

    @property
    def tire_coefficients(self) -> Any:
        """Coefficients of the model."""
        return self.tire.coefficients

    @property
    def load_range(self) -> tuple[float, float]:
        """Least and largest load that the file says it holds for, N; infinite where it gives no range."""
        *_, low, high = self.tire.ranges.get("normal_load", (-np.inf, np.inf))
        return low, high

    @cached_property
    def has_combined(self) -> bool:
        """Whether both slips are large together in at least 1% of the samples: beyond three least spreads."""
        slips = [np.abs(self.get(n)) / ABSOLUTE_SPREAD[n] for n in FORCE_OF_SLIP]
        return largest(np.min(slips, axis=0)) > 3.0

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
                fixed["wheel_way"] = self.wheel_way[rows]
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
