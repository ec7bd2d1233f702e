"""The operating points that a tire is evaluated at."""

from __future__ import annotations

from typing import Any, NamedTuple, TypedDict

import numpy as np

from tire_pipeline.channels import POINT_CHANNELS as POINT_CHANNELS
from tire_pipeline.errors import TirValueError


class OperatingPoints(NamedTuple):
    """Where a tire is evaluated. Fields broadcast against each other; a value does not change.

    Attributes
    ----------
    normal_load : float or array_like
        Vertical load (N). At a load of zero or less every output is zero.
    slip_angle, slip_ratio, camber : float or array_like
        Slip angle (rad), longitudinal slip (-1 is a locked wheel), camber (rad).
    speed : float or array_like, optional
        Forward speed (m/s), for the rolling resistance; ``LONGVL`` if left out.
    pressure : float or array_like, optional
        Inflation pressure (Pa); the nominal one if left out. Only MF 6.1 and 6.2 use it.
    turn_slip : float or array_like
        Curvature of the path (1/m). 0 everywhere switches the turn slip equations off. Only MF 6.1 and 6.2.

    See Also
    --------
    TireModel.forces : Forces there.
    TireModel.jacobian : Their derivatives with respect to coefficients.
    forces_batch : Forces of many tires.

    Notes
    -----
    ISO W axes unless ``axes`` says otherwise where the points are used (docs/reference/axes.md).

    Examples
    --------
    >>> from tire_pipeline.magic_formula import OperatingPoints, TireModel
    >>> tire = TireModel.from_coefficients({"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2})
    >>> points = OperatingPoints(normal_load=4000.0, slip_angle=[0.0, 0.05])
    >>> tire.forces(points).fy.round(1).tolist() == tire.forces(**points._asdict()).fy.round(1).tolist()
    True
    """

    normal_load: Any
    slip_angle: Any = 0.0
    slip_ratio: Any = 0.0
    camber: Any = 0.0
    speed: Any = None
    pressure: Any = None
    turn_slip: Any = 0.0


class PointFields(TypedDict, total=False):
    """The fields of :class:`OperatingPoints` as keywords."""

    normal_load: Any
    slip_angle: Any
    slip_ratio: Any
    camber: Any
    speed: Any
    pressure: Any
    turn_slip: Any


def points_of(points: OperatingPoints | None, channels: PointFields) -> OperatingPoints:
    """Return the points that were given, either as one value or as keywords.

    Raises
    ------
    TirValueError
        If both are given.
    TypeError
        If there is no normal load, or a keyword is not a channel.
    """
    if points is None:
        return OperatingPoints(**channels)
    if channels:
        raise TirValueError(
            f"operating points are given, and {', '.join(channels)} beside them",
            todo="pass one OperatingPoints, or channels by keyword",
        )
    return points


def refuse_turn_slip(points: OperatingPoints, what: str) -> None:
    """Raise if there is turn slip at the points: only :meth:`.TireModel.forces` supports it.

    Raises
    ------
    TirValueError
        It names what is not available with turn slip.
    """
    if np.any(np.asarray(points.turn_slip) != 0.0):
        raise TirValueError(
            f"{what} are not available with turn slip",
            key="turn_slip",
            todo="use TireModel.forces, or leave it out",
        )
