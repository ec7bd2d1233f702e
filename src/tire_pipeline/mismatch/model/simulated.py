"""The simulation as it is, its slopes, and its forces in a changed state of slips and tire."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from tire_pipeline.channels import MOMENT_CHANNELS, SLIP_AND_LOAD
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.mismatch.effects.base import State
from tire_pipeline.mismatch.effects.shared import first_order
from tire_pipeline.mismatch.model.channels import SMALL, RecordedChannels, largest
from tire_pipeline.mismatch.model.nominal import NominalConditions
from tire_pipeline.mismatch.model.plain_forces import plain_forces

Array = np.ndarray
DIFFERENCE = float(np.cbrt(np.finfo(float).eps))
"""Step of a central difference, as a part of what a channel usually is: the rounding is then as small as the
error of the difference (Nocedal and Wright, Numerical Optimization, 2nd ed., 8.1)."""


@dataclass(frozen=True, eq=False)
class BaseSimulation:
    """The model at the recorded points, before any effect is added.

    Parameters
    ----------
    nominal : NominalConditions
    beside : mapping of ndarray, shape (n,), optional
        What another simulator has beyond the tire model that stands in for it, N.
    own_relaxation : mapping of str to float, optional
        Slip -> the relaxation length that the file itself states, m.
    """

    nominal: NominalConditions
    beside: Mapping[str, Array] | None = None
    own_relaxation: Mapping[str, float] | None = None
    _slopes: dict[str, dict[str, Array]] = field(default_factory=dict, init=False, repr=False)

    @property
    def recording(self) -> RecordedChannels:
        """What is recorded."""
        return self.nominal.recording

    def as_recorded(self) -> State:
        """Return slips, camber and load as they were recorded, at a tire that nothing has changed."""
        zero = np.zeros(self.recording.size)
        return State(
            slip_angle=self.recording.get("slip_angle"),
            slip_ratio=self.recording.get("slip_ratio"),
            camber=self.recording.get("camber"),
            normal_load=self.recording.get("normal_load"),
            log_friction=zero,
            log_friction_y=zero,
            log_stiffness=zero,
            log_stiffness_y=zero,
            pressure=self.nominal.model_pressure,
        )

    def relax(self, state: State) -> None:
        """Lag the slips by the relaxation that the file itself states (PTY1, PTX1), if it does."""
        recording = self.recording
        if self.own_relaxation is None or recording.time is None or not recording.has("speed"):
            return
        rolled = np.abs(recording.get("speed")) * recording.step
        for slip, length in self.own_relaxation.items():
            step = rolled / max(length, 1e-9)
            setattr(state, slip, first_order(getattr(state, slip), step, recording.start))

    def forces(self, state: State) -> dict[str, Array]:
        """Return fx and fy, N, by similarity: friction m and stiffness k turn F(s) into m F(s k / m).

        The slip angle counts from where the side force is zero.
        """
        m_x, ratio_x, m_y, ratio_y = _similarity(state)
        slip_angle = self._similar_slip_angle(state, ratio_y)
        tire = self._tire(state)

        def at(load: Array) -> dict[str, Array]:
            return plain_forces(
                tire,
                slip_angle=slip_angle,
                slip_ratio=state.slip_ratio * ratio_x,
                camber=state.camber,
                normal_load=load,
                speed=self.nominal.model_speed,
                pressure=state.pressure,
            )

        forces = _mean_of_wheels(state, at)
        fx = forces["fx"] * np.exp(m_x)
        fy = (forces["fy"] + state.added_y) * np.exp(m_y)
        if self.beside is not None:
            fx = fx + self.beside.get("fx", 0.0)
            fy = fy + self.beside.get("fy", 0.0)
        return {"fx": fx, "fy": fy}

    def moments(self, state: State, names: Sequence[str]) -> dict[str, Array]:
        """Return some of mx, my, mz, N m, by similarity.

        Friction m and stiffness k turn M(s) into m M(s k / m), with the lateral pair of m and k for mx and
        mz and the longitudinal one for my.
        """
        m_x, ratio_x, m_y, ratio_y = _similarity(state)
        slip_angle = self._similar_slip_angle(state, ratio_y)
        known = (("speed", self.nominal.model_speed), ("pressure", state.pressure))
        more: dict[str, Any] = {n: v for n, v in known if v is not None}
        tire = self._tire(state)

        def at(load: Array) -> dict[str, Array]:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                out = tire.forces(
                    slip_angle=slip_angle,
                    slip_ratio=state.slip_ratio * ratio_x,
                    camber=state.camber,
                    normal_load=load,
                    limits="ignore",
                    outputs=tuple(names),
                    **more,
                )
            return {n: np.asarray(getattr(out, n), float) for n in names}

        scale = {"mx": np.exp(m_y), "my": np.exp(m_x), "mz": np.exp(m_y)}
        return {n: moment * scale[n] for n, moment in _mean_of_wheels(state, at).items()}

    def _similar_slip_angle(self, state: State, ratio: Array) -> Array:
        """Return the slip angle at which the model is asked, rad.

        It counts from where the side force is zero, as with LMUY and LKY: camber, ply steer and conicity
        act as a slip angle (Pacejka, 3rd ed., 4.2: the equivalent slip angle).
        """
        plain = state.slip_angle * ratio
        return plain + self.straight_ahead * (1.0 - ratio) if (ratio != 1.0).any() else plain

    def _tire(self, state: State) -> TireModel:
        tire = self.nominal.tire
        return tire.replace(**state.coefficients) if state.coefficients else tire

    @cached_property
    def base(self) -> dict[str, Array]:
        """The simulation as it is, N."""
        state = self.as_recorded()
        self.relax(state)
        forces = self.forces(state)
        return {name: forces[name] for name in self.recording.outputs}

    @cached_property
    def base_moments(self) -> dict[str, Array]:
        """The moments of the simulation as it is, N m."""
        state = self.as_recorded()
        self.relax(state)
        return self.moments(state, MOMENT_CHANNELS)

    def driven(self, output: str) -> bool:
        """Whether this force is there and the slips make it move, so that its size can be judged."""
        sizes = {n: largest(b) for n, b in self.base.items()}
        return sizes.get(output, 0.0) > SMALL * max(sizes.values())

    @cached_property
    def both_forces(self) -> dict[str, Array]:
        """fx and fy of the model, recorded or not, without any relaxation, N."""
        return self._forces_at()

    def _forces_at(self, **inputs: Array) -> dict[str, Array]:
        """Return fx and fy, N, at some inputs, and as recorded in the others."""
        return plain_forces(
            self.nominal.tire,
            **{n: inputs[n] if n in inputs else self.recording.get(n) for n in SLIP_AND_LOAD},
            speed=self.nominal.model_speed,
            pressure=self.nominal.model_pressure,
        )

    def turned_by_force(self, slip_angle: Array, steer: float, steer_by_fx: float = 0.0) -> Array:
        """Return ``slip_angle - steer Fy - steer_by_fx Fx`` with the forces that the model then gives.

        The recorded forces would bring their own noise into the slip angle. Solved by the secant method:
        taking the last step's force again and again does not end where the turn is as large as the angle.
        """

        def wanted(angle: Array) -> Array:
            force = self._forces_at(slip_angle=angle)
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
        if name not in self._slopes:
            self._slopes[name] = self._slope_at({name: self.recording.get(name)}, name)
        return self._slopes[name]

    def _slope_at(self, at: dict[str, Array], name: str) -> dict[str, Array]:
        """Return d force / d channel at some inputs, and as recorded in the others."""
        step = DIFFERENCE * (self.nominal.load if name == "normal_load" else 1.0)
        out: dict[str, Array] = {}
        for sign in (1.0, -1.0):
            there = self._forces_at(**{**at, name: at[name] + sign * step})
            for axis, value in there.items():
                out[axis] = out.get(axis, 0.0) + sign * value / (2.0 * step)
        return out

    @cached_property
    def straight_ahead(self) -> Array:
        """Slip angle (rad) without a side force at the recorded camber and load, by the slope at zero."""
        zero = np.zeros(self.recording.size)
        straight = {"slip_angle": zero, "slip_ratio": zero}
        return self._over_slope(-self._forces_at(**straight)["fy"], straight)

    @cached_property
    def shift_by_thrust(self) -> Array:
        """Slip angle (rad) for a side force as large as the load, by the slope while rolling straight."""
        zero = np.zeros(self.recording.size)
        straight = {"slip_angle": zero, "slip_ratio": zero, "camber": zero}
        return self._over_slope(self.recording.get("normal_load"), straight)

    def _over_slope(self, force: Array, straight: dict[str, Array]) -> Array:
        """Return the slip angle for a side force, rad, by the slope there; 0 where there is none."""
        slope = self._slope_at(straight, "slip_angle")["fy"]
        return np.divide(force, slope, out=np.zeros(self.recording.size), where=np.abs(slope) > 1.0)

    def _stiffness(self, axis: str) -> float:
        """Slip stiffness at nominal load, N per unit of slip, positive."""
        h = DIFFERENCE
        a = np.array([h, -h]) if axis == "fy" else np.zeros(2)
        k = np.array([h, -h]) if axis == "fx" else np.zeros(2)
        f = plain_forces(
            self.nominal.tire,
            slip_angle=a,
            slip_ratio=k,
            camber=np.zeros(2),
            normal_load=np.full(2, self.nominal.load),
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


def _mean_of_wheels(state: State, at: Callable[[Array], dict[str, Array]]) -> dict[str, Array]:
    """Return what one wheel gives at its load, or the mean of two that share it unevenly."""
    if state.load_apart is None:
        return at(state.normal_load)
    apart = np.minimum(state.load_apart, state.normal_load)
    more, less = at(state.normal_load + apart), at(state.normal_load - apart)
    return {name: 0.5 * (more[name] + less[name]) for name in more}


def _similarity(state: State) -> tuple[Array, Array, Array, Array]:
    """Log friction and factor of the slip, along and across."""
    m_x, m_y = state.log_friction, state.log_friction + state.log_friction_y
    ratio_y = np.exp(state.log_stiffness + state.log_stiffness_y - m_y)
    ratio_x = np.exp(state.log_stiffness - m_x)
    return m_x, ratio_x, m_y, ratio_y
