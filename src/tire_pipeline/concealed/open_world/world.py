"""What a mechanism sees: channels of a run, the forces without it, and the tire to ask at other slips."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd

FX, FY, MZ = 0, 1, 2
FORCES = ("fx", "fy", "mz")
SYMBOLS = {
    "fx": "fx, N",
    "fy": "fy, N",
    "mz": "mz, N m",
    "s": "tan(slip_angle)",
    "k": "slip_ratio",
    "g": "camber, rad",
    "L": "normal_load over nominal load",
    "v": "speed over nominal speed",
    "p": "pressure over nominal pressure",
    "h": "(tread_temperature - nominal temperature) / 20 K",
    "F0": "nominal load, N",
    "R0": "radius, m",
    "c": "size",
}


@dataclass(frozen=True)
class Nominal:
    """What the groups are made dimensionless with: SI, temperature in degC."""

    load: float = 4000.0
    speed: float = 18.0
    pressure: float = 2.3e5
    temperature: float = 45.0
    radius: float = 0.317


@dataclass(frozen=True)
class World:
    """A run without the mechanism.

    `channels` has time, slip_angle, slip_ratio, camber, normal_load, speed and perhaps pressure and
    tread_temperature, SI and radians, n rows at an even rate; `forces` is (n, 3): fx, fy, mz in N, N, N m;
    `tire` gives those for other channels.
    """

    channels: pd.DataFrame
    forces: np.ndarray
    tire: Callable[[pd.DataFrame], np.ndarray]
    nominal: Nominal = Nominal()

    @property
    def step(self) -> float:
        """Time between samples, s."""
        time = self.channels["time"].to_numpy()
        return float(np.median(np.diff(time)))

    def groups(self) -> dict[str, np.ndarray]:
        """Each symbol of `SYMBOLS` but the size, (n,); a channel that is missing is at its nominal value."""
        nominal, channels = self.nominal, self.channels
        same = np.ones(len(channels))

        def of(name: str, otherwise: float) -> np.ndarray:
            return channels[name].to_numpy() if name in channels else otherwise * same

        return {
            **{name: self.forces[:, index] for index, name in enumerate(FORCES)},
            "s": np.tan(of("slip_angle", 0.0)),
            "k": of("slip_ratio", 0.0),
            "g": of("camber", 0.0),
            "L": of("normal_load", nominal.load) / nominal.load,
            "v": of("speed", nominal.speed) / nominal.speed,
            "p": of("pressure", nominal.pressure) / nominal.pressure,
            "h": (of("tread_temperature", nominal.temperature) - nominal.temperature) / 20.0,
            "F0": nominal.load * same,
            "R0": nominal.radius * same,
        }

    def path(self) -> np.ndarray:
        """Way travelled, m, (n,)."""
        return np.cumsum(self.channels["speed"].to_numpy()) * self.step

    def sliding(self) -> np.ndarray:
        """Slip speed, both directions together, m/s, (n,)."""
        groups = self.groups()
        return self.channels["speed"].to_numpy() * np.hypot(groups["s"], groups["k"])

    def added(self, **changes: np.ndarray) -> np.ndarray:
        """Change of the forces, (n, 3), of which the force channels given are not zero."""
        out = np.zeros_like(self.forces)
        for name, values in changes.items():
            out[:, FORCES.index(name)] = values
        return out

    def turned(self, angle: np.ndarray) -> np.ndarray:
        """Change of the forces, (n, 3), where the true slip angle is larger by `angle` (rad, (n,))."""
        moved = self.channels.assign(slip_angle=self.channels["slip_angle"].to_numpy() + angle)
        return self.tire(moved) - self.forces
