"""The tire model at points that may lie outside of its ranges."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from tire_pipeline.channels import ALIGNING_MOMENT, POINT_CHANNELS, SLIP_AND_LOAD, TANGENTIAL_FORCES

Array = np.ndarray
_FRICTION_AND_STIFFNESS = {
    "fx": ("friction_x", "slip_stiffness"),
    "fy": ("friction_y", "cornering_stiffness"),
}


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


def forces_at(tire: Any, channels: Mapping[str, Array]) -> dict[str, Array]:
    """Return the model's fx and fy in N at the slips, cambers and loads of some channels.

    Parameters
    ----------
    tire : TireModel
    channels : mapping of ndarray, shape (n,)
        SI; what is not recorded is zero.
    """
    zero = np.zeros(channels["normal_load"].size)
    return plain_forces(tire, **{n: channels.get(n, zero) for n in SLIP_AND_LOAD})


def moment_at(tire: Any, channels: Mapping[str, Array]) -> Array:
    """Return the aligning moment in N m at some channels, as :func:`forces_at`; NaN without a radius."""
    inputs = {n: channels[n] for n in POINT_CHANNELS if n in channels}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return np.asarray(tire.forces(**inputs, limits="ignore", outputs=(ALIGNING_MOMENT,)).mz, float)


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
