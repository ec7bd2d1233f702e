"""The simulation as it is and its slopes; a part of `Data`."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.mismatch.model.forces import plain_forces, simulate
from tire_pipeline.mismatch.model.nominal import NominalConditions

Array = np.ndarray
DIFFERENCE = float(np.cbrt(np.finfo(float).eps))
"""Step of a central difference, as a part of what a channel usually is: the rounding is then as small as the
error of the difference (Nocedal and Wright, Numerical Optimization, 2nd ed., 8.1)."""


class Simulated(NominalConditions):
    """Forces of the model at the recorded points."""

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

    def turned_by_force(self, slip_angle: Array, steer: float, steer_by_fx: float = 0.0) -> Array:
        """Return ``slip_angle - steer Fy - steer_by_fx Fx`` with the forces that the model then gives.

        The recorded forces would bring their own noise into the slip angle. Solved by the secant method:
        taking the last step's force again and again does not end where the turn is as large as the angle.
        """

        def wanted(angle: Array) -> Array:
            force = plain_forces(
                self.tire,
                slip_angle=angle,
                slip_ratio=self.get("slip_ratio"),
                camber=self.get("camber"),
                normal_load=self.get("normal_load"),
                speed=self.model_speed,
                pressure=self.model_pressure,
            )
            return slip_angle - steer * force["fy"] - steer_by_fx * force["fx"]

        before, here = slip_angle, wanted(slip_angle)
        miss_before = before - here
        for _ in range(3):
            miss = here - wanted(here)
            slope = (miss - miss_before) / np.where(here == before, 1.0, here - before)
            slope = np.where(here == before, 1.0, np.clip(slope, 1.0 / 3.0, 3.0))
            before, miss_before, here = here, miss, here - miss / slope
        return here

    def slope(self, name: str) -> dict[str, Array]:
        """Return d force / d channel of the model by central differences."""
        key = f"slope {name}"
        if key not in self.fixed:
            at = {n: self.get(n) for n in SLIP_AND_LOAD}
            self.fixed[key] = self._slope_at(at, name)
        return self.fixed[key]

    def _slope_at(self, at: dict[str, Array], name: str) -> dict[str, Array]:
        """Return d force / d channel at some inputs, one a sample."""
        step = DIFFERENCE * (self.load_nominal if name == "normal_load" else 1.0)
        out: dict[str, Array] = {}
        for sign in (1.0, -1.0):
            c = {**at, name: at[name] + sign * step}
            f = plain_forces(self.tire, speed=self.model_speed, pressure=self.model_pressure, **c)
            for axis, value in f.items():
                out[axis] = out.get(axis, 0.0) + sign * value / (2.0 * step)
        return out

    @cached_property
    def shift_by_thrust(self) -> Array:
        """Slip angle (rad) for a side force as large as the load, by the slope while rolling straight."""
        zero, load = np.zeros(self.size), self.get("normal_load")
        straight = {"slip_angle": zero, "slip_ratio": zero, "camber": zero, "normal_load": load}
        slope = self._slope_at(straight, "slip_angle")["fy"]
        return np.divide(load, slope, out=np.zeros(self.size), where=np.abs(slope) > 1.0)

    def _stiffness(self, axis: str) -> float:
        """Slip stiffness at nominal load, N per unit of slip, positive."""
        h = DIFFERENCE
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
        """|dFy/d slip angle| over the cornering stiffness at nominal load, at most 2."""
        share = np.abs(self.slope("slip_angle")["fy"]) / self._stiffness("fy")
        return np.minimum(share, 2.0)

    @cached_property
    def slope_share_x(self) -> Array:
        """|dFx/d slip ratio| over the slip stiffness at nominal load, at most 2."""
        share = np.abs(self.slope("slip_ratio")["fx"]) / self._stiffness("fx")
        return np.minimum(share, 2.0)
