"""The model with effects added: channels -> slips at the tire -> forces -> what is recorded."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.mismatch.effects import State, catalogue

Array = np.ndarray
_FRICTION_AND_STIFFNESS = {
    "fx": ("friction_x", "slip_stiffness"),
    "fy": ("friction_y", "cornering_stiffness"),
}
Change = tuple[str, Mapping[str, float]]


def plain_forces(
    tire: Any,
    *,
    slip_angle: Array,
    slip_ratio: Array,
    camber: Array,
    normal_load: Array,
    speed: Array | None = None,
    pressure: Array | None = None,
) -> dict[str, Array]:
    """Return the model's fx and fy in N at points that may lie outside of its ranges.

    Parameters
    ----------
    tire : TireModel
    slip_angle, slip_ratio, camber, normal_load, speed, pressure : ndarray, shape (n,)
        rad, 1, rad, N, m/s, Pa.
    """
    more = {}
    if speed is not None:
        more["speed"] = speed
    if pressure is not None:
        more["pressure"] = pressure
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # trial repairs make angles that look like degrees
        out = tire.forces(
            slip_angle=slip_angle,
            slip_ratio=slip_ratio,
            camber=camber,
            normal_load=normal_load,
            limits="ignore",
            outputs=TANGENTIAL_FORCES,
            **more,
        )
    return {"fx": np.asarray(out.fx, float), "fy": np.asarray(out.fy, float)}


def slip_at_peak(tire: Any, output: str, load: Array) -> Array:
    """Return the slip at which the linear force would be as large as the largest one: where the curve bends.

    Parameters
    ----------
    tire : TireModel
    output : str
        ``"fx"`` or ``"fy"``.
    load : ndarray, shape (n,)
        N.
    """
    friction, stiffness = _FRICTION_AND_STIFFNESS[output]
    found = tire.forces(normal_load=load, limits="ignore", outputs=(friction, stiffness))
    most, slope = (np.abs(np.asarray(getattr(found, name), float)) for name in (friction, stiffness))
    return np.maximum(most * load, 1e-9) / np.maximum(slope, 1e-9)


def simulate(data: Any, changes: Sequence[Change] = ()) -> dict[str, Array]:
    """Simulate the recording with effects added.

    Parameters
    ----------
    data : Data
        The prepared recording; it holds the tire.
    changes : sequence of (name, parameters)
        Effects and their parameters; one that is not given does nothing.

    Returns
    -------
    dict of ndarray
        One array for each of ``data.outputs``, N.
    """
    state, effects = _at_the_tire(data, changes)
    state.forces = _tire(data, state)
    for effect, p in effects:
        effect.outputs(state, data, p)
    return {name: state.forces[name] for name in data.outputs}


def simulate_moments(data: Any, changes: Sequence[Change], names: Sequence[str]) -> dict[str, Array]:
    """Simulate moments with effects added.

    Effects act on the slips and on the tire; those on recorded forces (gain, offset, delay) leave the
    moments as they are. Friction m and stiffness k turn M(s) into m M(s k / m), with the lateral pair of
    m and k for mx and mz and the longitudinal one for my.

    Parameters
    ----------
    data : Data
    changes : sequence of (name, parameters)
    names : sequence of str
        Some of ``mx, my, mz``.

    Returns
    -------
    dict of ndarray, shape (n,)
        N m.
    """
    state, _ = _at_the_tire(data, changes)
    m_x, ratio_x, m_y, ratio_y = _similarity(state)
    tire = data.tire.replace(**state.coefficients) if state.coefficients else data.tire
    more = {
        n: v for n, v in (("speed", data.model_speed), ("pressure", data.model_pressure)) if v is not None
    }
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        out = tire.forces(
            slip_angle=state.slip_angle * ratio_y,
            slip_ratio=state.slip_ratio * ratio_x,
            camber=state.camber,
            normal_load=state.normal_load,
            limits="ignore",
            outputs=tuple(names),
            **more,
        )
    scale = {"mx": np.exp(m_y), "my": np.exp(m_x), "mz": np.exp(m_y)}
    return {n: np.asarray(getattr(out, n), float) * scale[n] for n in names}


def _at_the_tire(data: Any, changes: Sequence[Change]) -> tuple[State, list[tuple[Any, Mapping[str, float]]]]:
    """What the tire sees and what it is like, and the effects in their order."""
    effects: list[tuple[Any, Mapping[str, float]]] = [
        (catalogue()[name], {**catalogue()[name].zeros(data), **p}) for name, p in changes
    ]
    effects.sort(key=lambda e: e[0].order)
    zero = np.zeros(data.size)
    state = State(
        slip_angle=data.get("slip_angle"),
        slip_ratio=data.get("slip_ratio"),
        camber=data.get("camber"),
        normal_load=data.get("normal_load"),
        log_friction=zero,
        log_friction_y=zero,
        log_stiffness=zero,
        log_stiffness_y=zero,
    )
    for effect, p in effects:
        effect.inputs(state, data, p)
    data.relax(state, {name for name, _ in changes})
    for effect, p in effects:
        effect.tire(state, data, p)
    return state, effects


def _similarity(state: State) -> tuple[Any, Any, Any, Any]:
    """Log friction and factor of the slip, along and across."""
    m_x, m_y = state.log_friction, state.log_friction + state.log_friction_y
    ratio_y = np.exp(state.log_stiffness + state.log_stiffness_y - m_y)
    ratio_x = np.exp(state.log_stiffness - m_x)
    return m_x, ratio_x, m_y, ratio_y


def _tire(data: Any, state: State) -> dict[str, Array]:
    """Evaluate the tire by similarity: friction m and stiffness k turn F(s) into m F(s k / m)."""
    tire = data.tire.replace(**state.coefficients) if state.coefficients else data.tire
    m_x, ratio_x, m_y, ratio_y = _similarity(state)
    forces = plain_forces(
        tire,
        slip_angle=state.slip_angle * ratio_y,
        slip_ratio=state.slip_ratio * ratio_x,
        camber=state.camber,
        normal_load=state.normal_load,
        speed=data.model_speed,
        pressure=data.model_pressure,
    )
    fx = forces["fx"] * np.exp(m_x)
    fy = (forces["fy"] + state.added_y) * np.exp(m_y)
    if data.beside is not None:
        fx = fx + data.beside.get("fx", 0.0)
        fy = fy + data.beside.get("fy", 0.0)
    return {"fx": fx, "fy": fy}
