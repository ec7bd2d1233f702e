"""Features of a tire's force curves, in which the bias of a measurement is simple.

A measurement's bias is a factor on friction (surface, temperature) or on slope (belt, drum, lag) far more
than it
is a step in a coefficient, and many different coefficients give nearly the same curve. By the similarity of
tire curves (Pacejka, *Tire and Vehicle Dynamics*, section 4.2) such a factor moves one feature only, if
the features are: the logarithms of stiffness and of friction level over the load, and the shape of the
curve over the reduced slip, that is slip times stiffness over friction. Then a bias is nearly the same number
for every tire.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.representations.coefficients import ALIGNING, LATERAL, LONGITUDINAL
from tire_pipeline.translation.curves.pure_slip import (
    CoefficientColumns,
    Points,
    aligning_torque,
    columns,
    cornering_stiffness,
    lateral_force,
    longitudinal_force,
    slip_stiffness,
)

LOADS = np.array([2000.0, 4000.0, 6000.0, 8000.0])
"""Normal loads at which curves are compared, N."""

REDUCED = np.array([0.25, 0.5, 0.8, 1.1, 1.5, 2.0, 2.6, 3.3])
"""Reduced slips at which curves are compared: slip times stiffness over the friction level."""

LARGEST_PEAK_SLIP = 0.25
"""Largest slip angle (rad) and slip ratio; friction level is the largest force up to there."""

CAMBER_NORMAL_LOADS = np.array([4000.0, 7000.0])
CAMBER_SLIPS = np.array([-0.14, -0.05, 0.0, 0.05, 0.14])
CAMBER_ANGLE = 0.07

_PEAK_SLIPS = np.array([0.07, 0.09, 0.11, 0.13, 0.16, 0.20, LARGEST_PEAK_SLIP])
_PEAK = Points.grid(np.concatenate([-_PEAK_SLIPS[::-1], _PEAK_SLIPS]), LOADS, [0.0])
_ORIGIN = Points.grid([0.0], LOADS, [0.0])
_TILTED = Points.grid(CAMBER_SLIPS, CAMBER_NORMAL_LOADS, [-CAMBER_ANGLE, 0.0, CAMBER_ANGLE])


@dataclass(frozen=True)
class Group:
    """Features of one output.

    Attributes
    ----------
    name : str
    coefficients : tuple of str
        What decides these features, and is changed to move them.
    names : tuple of str
        One a feature.
    of : callable
        From coefficients as columns to features (n, d).
    """

    name: str
    coefficients: tuple[str, ...]
    names: tuple[str, ...]
    of: Callable[[CoefficientColumns], np.ndarray]


def _parts(values: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Odd and even part, each (n, loads, count), from values at -slips[::-1], slips of every load."""
    curve = values.reshape(len(values), LOADS.size, 2 * count)
    up, down = curve[..., count:], curve[..., :count][..., ::-1]
    return 0.5 * (up - down), 0.5 * (up + down)


def _log(values: np.ndarray, least: float) -> np.ndarray:
    return np.log(np.maximum(values, least))


def _flat(values: np.ndarray) -> np.ndarray:
    return values.reshape(len(values), -1)


def _reduced_points(level: np.ndarray, slope: np.ndarray) -> Points:
    """Points at the reduced slips, to both sides; friction level and slope over load are (n, loads)."""
    slips = np.minimum((level / slope)[:, :, None] * REDUCED, 1.2)
    both = np.concatenate([-slips[..., ::-1], slips], axis=2)
    return Points(_flat(both), np.repeat(LOADS, 2 * REDUCED.size), np.zeros(1))


def _level(force: np.ndarray) -> np.ndarray:
    """Largest odd force over load up to ``LARGEST_PEAK_SLIP``, (n, loads)."""
    odd, _ = _parts(force, _PEAK_SLIPS.size)
    return np.maximum(np.abs(odd).max(axis=2) / LOADS, 0.1)


def _force_features(level: np.ndarray, slope: np.ndarray, force: np.ndarray) -> np.ndarray:
    odd, even = _parts(force, REDUCED.size)
    scale = (level * LOADS)[:, :, None]
    shape = _log(odd / scale, 0.02)
    return np.concatenate([np.log(slope), np.log(level), _flat(shape), _flat(even / scale)], axis=1)


def _lateral_plane(p: CoefficientColumns) -> tuple[np.ndarray, np.ndarray, Points]:
    level = _level(lateral_force(p, _PEAK))
    slope = np.maximum(-cornering_stiffness(p, _ORIGIN) / LOADS, 1.0)
    return level, slope, _reduced_points(level, slope)


def lateral_features(p: CoefficientColumns) -> np.ndarray:
    """ln cornering stiffness over load, ln friction level, ln shape, even force over friction; (n, 72)."""
    level, slope, points = _lateral_plane(p)
    return _force_features(level, slope, -lateral_force(p, points))


def camber_features(p: CoefficientColumns) -> np.ndarray:
    """Change of the lateral force by camber, over the load; (n, 20)."""
    return _flat(_change_by_camber(lateral_force(p, _TILTED)))


def _change_by_camber(values: np.ndarray) -> np.ndarray:
    curve = values.reshape(len(values), CAMBER_NORMAL_LOADS.size, 3, CAMBER_SLIPS.size)
    load = CAMBER_NORMAL_LOADS[None, :, None, None]
    return (curve[:, :, [0, 2]] - curve[:, :, [1]]) / load


def longitudinal_features(p: CoefficientColumns) -> np.ndarray:
    """ln slip stiffness over load, ln friction level, ln shape, even force over friction; (n, 72)."""
    level = _level(longitudinal_force(p, _PEAK))
    slope = np.maximum(slip_stiffness(p, _ORIGIN) / LOADS, 1.0)
    force = longitudinal_force(p, _reduced_points(level, slope))
    return _force_features(level, slope, force)


def aligning_features(p: CoefficientColumns) -> np.ndarray:
    """Odd and even torque over friction level, load and radius, and its change by camber; (n, 84)."""
    level, _, points = _lateral_plane(p)
    odd, even = _parts(aligning_torque(p, points), REDUCED.size)
    scale = (level * LOADS * p["UNLOADED_RADIUS"])[:, :, None]
    tilted = _change_by_camber(aligning_torque(p, _TILTED)) / p["UNLOADED_RADIUS"][:, :, None, None]
    return np.concatenate([_flat(odd / scale), _flat(even / scale), _flat(tilted)], axis=1)


def _names(*blocks: tuple[str, np.ndarray]) -> tuple[str, ...]:
    named = []
    for what, slips in blocks:
        ats = [f" at reduced slip {slip:g}" for slip in slips] if slips.size else [""]
        named += [f"{what}{at}, {load:.0f} N" for load in LOADS for at in ats]
    return tuple(named)


_NONE = np.array([])
_CAMBER_AT = tuple(
    f"at slip angle {slip:g}, camber {tilt:g}, {load:.0f} N"
    for load in CAMBER_NORMAL_LOADS
    for tilt in (-CAMBER_ANGLE, CAMBER_ANGLE)
    for slip in CAMBER_SLIPS
)

GROUPS: tuple[Group, ...] = (
    Group(
        "lateral",
        tuple(name for name in LATERAL if name not in ("PDY3", "PEY4", "PKY3", "PHY3", "PVY3", "PVY4")),
        _names(
            ("ln cornering stiffness", _NONE),
            ("ln friction level", _NONE),
            ("ln shape", REDUCED),
            ("even lateral force", REDUCED),
        ),
        lateral_features,
    ),
    Group(
        "camber",
        ("PDY3", "PEY4", "PKY3", "PHY3", "PVY3", "PVY4"),
        tuple(f"lateral force by camber {at}" for at in _CAMBER_AT),
        camber_features,
    ),
    Group(
        "longitudinal",
        LONGITUDINAL,
        _names(
            ("ln slip stiffness", _NONE),
            ("ln friction level", _NONE),
            ("ln shape", REDUCED),
            ("even longitudinal force", REDUCED),
        ),
        longitudinal_features,
    ),
    Group(
        "aligning",
        ALIGNING,
        (
            *_names(("aligning torque", REDUCED), ("even aligning torque", REDUCED)),
            *(f"aligning torque by camber {at}" for at in _CAMBER_AT),
        ),
        aligning_features,
    ),
)


def encode(table: pd.DataFrame) -> dict[str, np.ndarray]:
    """Return the features of every tire, by group: each (n, d)."""
    p = columns(table)
    return {group.name: group.of(p) for group in GROUPS}
