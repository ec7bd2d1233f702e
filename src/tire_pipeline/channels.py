"""Names of the channels that a tire is evaluated at, and of what it gives, in the order that arrays take."""

from __future__ import annotations

from typing import NamedTuple

from tire_pipeline.unit_definitions import DEGREE

SLIP_AND_LOAD = ("slip_angle", "slip_ratio", "camber", "normal_load")
"""What every force depends on: rad, -, rad, N."""

POINT_CHANNELS = (*SLIP_AND_LOAD, "speed", "pressure")
"""An operating point, in the order in which the equations take it: m/s and Pa. Turn slip comes last."""

ANGLE_CHANNELS = ("slip_angle", "camber")
"""Angles of an operating point, rad."""

OPERATING_CHANNELS = (*POINT_CHANNELS, "tread_temperature")
"""What a recording may be looked at over: an operating point, and degC."""

INPUT_CHANNELS = (*OPERATING_CHANNELS, "turn_slip", "load_transfer")
"""All that a force may depend on: the same, 1/m, and N between a wheel's load and the mean of its axle."""

TANGENTIAL_FORCES = ("fx", "fy")
"""Forces in the plane of the road, N."""

ALIGNING_MOMENT = "mz"
PLANE_FORCES = (*TANGENTIAL_FORCES, ALIGNING_MOMENT)
"""What acts in the plane of the road: its forces (N) and the moment about its normal (N m)."""

MOMENT_CHANNELS = ("mx", "my", "mz")
"""Moments, N m."""

FORCE_CHANNELS = (*TANGENTIAL_FORCES, *MOMENT_CHANNELS)
"""Forces (N) and moments (N m) in ISO W axes."""

RECORDED_CHANNELS = ("time", *INPUT_CHANNELS, *FORCE_CHANNELS)
"""Columns of a recording that have a meaning: s, an operating point, 1/m, N, forces and moments."""

SLIP_OF_FORCE = {"fy": "slip_angle", "fx": "slip_ratio", "mz": "slip_angle"}
"""The slip that each curve at pure slip runs over, in the order in which curves are shown."""

FORCE_OF_SLIP = {"slip_angle": "fy", "slip_ratio": "fx"}
"""The tangential force that each slip makes."""

FORCES_OF_MOMENT = {"mx": ("fy",), "my": ("fx",), "mz": ("fx", "fy")}
"""The tangential forces of which each moment is made (Pacejka, 3rd ed., 4.3.2: 4.E69, 4.E70, 4.E71)."""


class ShownUnit(NamedTuple):
    """How a channel is written for readers: a value in SI times ``factor`` is in ``unit``.

    Parameters
    ----------
    factor : float
    unit : str
        Empty for ratios.
    label : str
        The channel in words.
    """

    factor: float
    unit: str
    label: str


SHOWN_UNITS = {
    "time": ShownUnit(1.0, "s", "time"),
    "slip_angle": ShownUnit(1.0 / DEGREE, "deg", "slip angle"),
    "slip_ratio": ShownUnit(1.0, "", "slip ratio"),
    "camber": ShownUnit(1.0 / DEGREE, "deg", "camber"),
    "normal_load": ShownUnit(1e-3, "kN", "load"),
    "speed": ShownUnit(1.0, "m/s", "speed"),
    "pressure": ShownUnit(1e-3, "kPa", "pressure"),
    "tread_temperature": ShownUnit(1.0, "degC", "tread temperature"),
    "turn_slip": ShownUnit(1.0, "1/m", "path curvature"),
    "load_transfer": ShownUnit(1e-3, "kN", "load transfer"),
    "fx": ShownUnit(1e-3, "kN", "longitudinal force Fx"),
    "fy": ShownUnit(1e-3, "kN", "lateral force Fy"),
    "mz": ShownUnit(1.0, "N m", "aligning moment Mz"),
}
"""The units that engineers use, by channel."""

LARGEST_LOAD_OF_MODEL_CARS = 100.0
"""In N: below that no tire of a car, a motorcycle or a bicycle is used."""

TIRE_RADII = (0.004, 2.5)
"""m, of tires and wheels: models of a car at 1:87 to the largest tire of a mining truck (59/80R63: 2.0)."""

TIRE_PRESSURES = (6e4, 1.2e6)
"""Pa, of racing cars at 0.6 bar to trucks at 9 bar (ETRTO), cold; a third more when hot."""


def shown_unit(channel: str, size: float) -> ShownUnit:
    """Return how values of some size (SI) are written: a load below 100 N, a model car's, in N.

    Examples
    --------
    >>> shown_unit("pressure", 2.2e5)
    ShownUnit(factor=0.001, unit='kPa', label='pressure')
    >>> shown_unit("normal_load", 40.0).unit
    'N'
    """
    known = SHOWN_UNITS.get(channel, ShownUnit(1.0, "", channel.replace("_", " ")))
    if channel == "normal_load" and abs(size) < LARGEST_LOAD_OF_MODEL_CARS:
        return known._replace(factor=1.0, unit="N")
    return known


def unit_of(output: str) -> str:
    """Return the unit of a force or a moment."""
    return "N m" if output in MOMENT_CHANNELS else "N"


def axis_label(channel: str) -> str:
    """Return what stands beside a figure's axis, such as ``slip angle (deg)``."""
    _, unit, label = SHOWN_UNITS[channel]
    return f"{label} ({unit})" if unit else label
