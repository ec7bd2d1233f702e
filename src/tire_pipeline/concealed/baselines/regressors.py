"""What the baselines regress the residual on: one group of columns for each catalogue name.

First-order forms: what a small change of each kind adds to the model's force (chain rule on the
Magic Formula; derivatives by central differences).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.concealed.cases.clean_run import model_forces
from tire_pipeline.magic_formula import TireModel

Groups = dict[str, np.ndarray]
"""Name -> columns, shape (n, 2, k): samples, forces (fx, fy), columns."""


@dataclass(frozen=True)
class Scene:
    """A recording with the model's forces and their slopes along it.

    Attributes
    ----------
    frame : pandas.DataFrame
        The recording; channels that it lacks are taken at their nominal value.
    force, by_angle, by_ratio, by_load, by_camber, friction, stiffness : ndarray, shape (n, 2)
        fx and fy of the model in N, and their derivatives by slip angle, slip ratio, normal load, camber,
        friction scale and slip stiffness scale.
    """

    frame: pd.DataFrame
    force: np.ndarray
    by_angle: np.ndarray
    by_ratio: np.ndarray
    by_load: np.ndarray
    by_camber: np.ndarray
    friction: np.ndarray
    stiffness: np.ndarray


def look_at(tire: TireModel, frame: pd.DataFrame) -> Scene:
    """Evaluate the model and its slopes along a recording."""
    defaults = {"slip_ratio": 0.0, "camber": 0.0, "speed": tire.value("LONGVL")}
    frame = frame.assign(**{k: v for k, v in defaults.items() if k not in frame})

    def slope(change: Callable[[float], np.ndarray], step: float) -> np.ndarray:
        return (change(step) - change(-step)) / (2.0 * step)

    def shifted(channel: str) -> Callable[[float], np.ndarray]:
        return lambda h: model_forces(tire, frame.assign(**{channel: frame[channel] + h}))

    def scaled(*names: str) -> Callable[[float], np.ndarray]:
        return lambda h: model_forces(tire.replace(**dict.fromkeys(names, 1.0 + h)), frame)

    return Scene(
        frame=frame,
        force=model_forces(tire, frame),
        by_angle=slope(shifted("slip_angle"), 1e-3),
        by_ratio=slope(shifted("slip_ratio"), 1e-3),
        by_load=slope(shifted("normal_load"), 1.0),
        by_camber=slope(shifted("camber"), 1e-3),
        friction=slope(scaled("LMUX", "LMUY"), 1e-2),
        stiffness=slope(scaled("LKX", "LKY"), 1e-2),
    )


def make_groups(tire: TireModel, recording: pd.DataFrame, span: tuple[float, float] | None = None) -> Groups:
    """Return the columns of every effect whose channels the recording has and moves.

    Parameters
    ----------
    tire : TireModel
    recording : pandas.DataFrame
    span : (start, end), optional
        Times that moments and drift are measured by, s, to evaluate on another run; then nothing
        is left out.

    Returns
    -------
    dict
        Name -> ndarray, shape (n, 2, k). Steps in time and states need the whole recording.
    """
    scene = look_at(tire, recording)
    groups: Groups = {}
    groups |= _scales(tire, scene) | _channels(tire, scene) | _artefacts(tire, scene)
    if "time" in recording:
        groups |= _in_time(tire, scene, span)
    if span is not None:
        return groups
    scale = 1e-6 * tire.value("FNOMIN")
    return {
        name: g
        for name, g in groups.items()
        if np.isfinite(g).all() and np.all(np.abs(g).max(axis=(0, 1)) > scale)
    }


def _stack(*columns: np.ndarray) -> np.ndarray:
    return np.stack(columns, axis=-1)


def _only(output: int, column: np.ndarray) -> np.ndarray:
    out = np.zeros((len(column), 2))
    out[:, output] = column
    return out


def _scales(tire: TireModel, s: Scene) -> Groups:
    load = (s.frame["normal_load"].to_numpy() / tire.value("FNOMIN") - 1.0)[:, None]
    slip = s.frame[["slip_angle", "slip_ratio"]].to_numpy()
    other_slip = (slip / 0.1) ** 2
    fy = s.force[:, 1:] / tire.value("FNOMIN")
    return {
        "friction_scale": _stack(s.friction),
        "stiffness_scale": _stack(s.stiffness),
        "load_sensitivity": _stack(load * s.friction),
        "combined_slip": _stack(other_slip * s.force),
        "compliance": _stack(fy * s.by_angle),
    }


def _channels(tire: TireModel, s: Scene) -> Groups:
    fz = s.frame["normal_load"].to_numpy()
    out: Groups = {}
    if np.ptp(camber := s.frame["camber"].to_numpy()) > 0.01:
        out["camber"] = _stack(_only(1, camber * fz), camber[:, None] * s.by_angle)
    if np.ptp(speed := s.frame["speed"].to_numpy()) > 0.5:
        grade = np.log(np.maximum(speed, 0.5) / tire.value("LONGVL"))[:, None]
        out["speed_dependence"] = _stack(grade * s.friction)
    if "pressure" in s.frame and np.ptp(s.frame["pressure"]) > 1e4:
        change = (s.frame["pressure"] / s.frame["pressure"].median() - 1.0).to_numpy()[:, None]
        out["inflation_pressure"] = _stack(change * s.friction, change * s.stiffness)
    if "tread_temperature" in s.frame:
        warm = (s.frame["tread_temperature"] - s.frame["tread_temperature"].mean()).to_numpy()
        out["temperature"] = _stack(warm[:, None] * s.friction, warm[:, None] * s.stiffness)
    if "turn_slip" in s.frame:
        turn = s.frame["turn_slip"].to_numpy()
        out["turn_slip"] = _stack(_only(1, turn * fz), turn[:, None] * s.by_angle)
    return out


def _artefacts(tire: TireModel, s: Scene) -> Groups:
    fz = s.frame["normal_load"].to_numpy()
    fx, fy = s.force.T
    return {
        "plysteer_conicity": _stack(_only(1, fz), s.by_angle),
        "force_offset": _stack(_only(1, np.ones_like(fz))),
        "force_gain": _stack(_only(1, fy)),
        "load_gain": _stack(fz[:, None] * s.by_load),
        "load_offset": _stack(s.by_load),
        "slip_angle_offset": _stack(s.by_angle),
        "slip_ratio_offset": _stack(s.by_ratio),
        "camber_offset": _stack(s.by_camber),
        "crosstalk": _stack(_only(0, fy), _only(1, fx)),
    }


def _in_time(tire: TireModel, s: Scene, span: tuple[float, float] | None) -> Groups:
    time = s.frame["time"].to_numpy()
    dt = np.gradient(time)
    speed = np.maximum(s.frame["speed"].to_numpy(), 0.5)
    angle = s.frame["slip_angle"].to_numpy()
    rate = np.gradient(s.force, axis=0) / dt[:, None]
    angle_rate = np.gradient(angle) / dt
    phase = np.cumsum(speed * dt) / tire.value("UNLOADED_RADIUS")
    work = np.cumsum(speed * dt * np.abs(s.force[:, 1] * np.tan(np.clip(angle, -1, 1))))
    work = (work / 1e6)[:, None]
    start, end = span or (time[0], time[-1])
    part = (time - start) / (end - start)
    moments = [(part > m)[:, None] * s.friction for m in np.linspace(0.1, 0.9, 9)]
    return {
        "relaxation_length": _stack(-s.by_angle * (angle_rate / speed)[:, None]),
        "time_delay": _stack(-rate),
        "low_pass": _stack(-rate, np.gradient(rate, axis=0) / dt[:, None]),
        "nonuniformity": _stack(np.sin(phase)[:, None] * s.by_angle, np.cos(phase)[:, None] * s.by_angle),
        "wear": _stack(work * s.friction, work * s.stiffness),
        "sensor_drift": _stack(_only(1, part)),
        "surface_change": _stack(*moments),
    }
