"""Key figures of a tire, and the points at which they are evaluated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tire_pipeline.channels import PLANE_FORCES
from tire_pipeline.magic_formula.forces import tire_forces
from tire_pipeline.magic_formula.parameters.points import OperatingPoints
from tire_pipeline.magic_formula.parameters.tire_parameters import TireParameters
from tire_pipeline.unit_definitions import DEGREE

LARGEST_SLIP_ANGLE = np.deg2rad(15.0)
LARGEST_SLIP_RATIO = 0.3
SHARES_OF_LOAD = (0.5, 1.0, 1.5)
_POINTS_OF_CURVE = 301
_FEWEST_LOADS = 2
_SMALL_CAMBER = 0.01
"""rad; either way, for the slope."""


@dataclass(frozen=True)
class KeyFigure:
    """One number of a tire.

    Attributes
    ----------
    name : str
    value : float
        NaN if the model does not determine it.
    unit : str
    """

    name: str
    value: float
    unit: str


def key_figures(model: TireParameters, normal_load: float | None = None) -> list[KeyFigure]:
    """Return the key figures of a tire.

    At pure slip, without camber, at the nominal pressure.

    Parameters
    ----------
    model : TireParameters
    normal_load : float, optional
        N; ``FNOMIN`` if left out.

    Returns
    -------
    list of KeyFigure
        Stiffness, peak friction and the slips of the peaks, camber stiffness, pneumatic trail and largest
        aligning moment, relaxation lengths. Of a force without a level (``PDX1``, ``PDY1``) or a stiffness
        all are NaN: what is left of it is an offset. The camber stiffness is positive where the force points
        to the side to which the wheel leans, as in every tire.

    Examples
    --------
    >>> from tire_pipeline.magic_formula import TireModel
    >>> tire = TireModel.from_coefficients(
    ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
    ... )
    >>> figure = key_figures(tire)[0]
    >>> figure.name, round(figure.value), figure.unit
    ('cornering stiffness', 1117, 'N/deg')
    """
    load = model.value("FNOMIN") if normal_load is None else float(normal_load)
    side = forces_over(model, "slip_angle", load)
    ahead = forces_over(model, "slip_ratio", load)
    still = tire_forces(model, OperatingPoints(normal_load=load), limits="ignore")
    angle, force = np.degrees(side["slip"]), np.abs(side["fy"])
    ratio, pull = ahead["slip"], np.abs(ahead["fx"])
    torque = np.abs(side["mz"])
    sideways = _stiffness(model, "PDY1", still.cornering_stiffness)
    along = _stiffness(model, "PDX1", still.slip_stiffness)
    if np.isnan(sideways):
        force = np.zeros_like(force)
    if np.isnan(along):
        pull = np.zeros_like(pull)
    return [
        KeyFigure("cornering stiffness", sideways * DEGREE, "N/deg"),
        KeyFigure("largest lateral friction", _peak(force) / load, ""),
        KeyFigure("slip angle of the peak", _at_peak(angle, force), "deg"),
        KeyFigure("slip stiffness", along, "N"),
        KeyFigure("largest longitudinal friction", _peak(pull) / load, ""),
        KeyFigure("slip ratio of the peak", _at_peak(ratio, pull), ""),
        KeyFigure("camber stiffness", camber_stiffness(model, load) * DEGREE, "N/deg"),
        KeyFigure("pneumatic trail", _trail(model, still), "m"),
        KeyFigure("largest aligning moment", _peak(torque), "N m"),
        KeyFigure("lateral relaxation length", _positive(still.relaxation_lateral), "m"),
        KeyFigure("longitudinal relaxation length", _positive(still.relaxation_longitudinal), "m"),
    ]


def forces_over(model: TireParameters, slip: str, normal_load: float, **more: Any) -> dict[str, np.ndarray]:
    """Return forces over one slip, the other one zero, within the range of the file.

    Parameters
    ----------
    model : TireParameters
    slip : {"slip_angle", "slip_ratio"}
    normal_load : float
        N.
    **more
        ``camber`` (rad), ``pressure`` (Pa), as for :meth:`TireModel.forces`.

    Returns
    -------
    dict of ndarray, shape (301,)
        ``slip`` (rad or 1), ``fx``, ``fy`` (N), ``mz`` (N m).
    """
    x = slip_range(model, slip)
    fields: dict[str, Any] = {slip: x, "normal_load": normal_load, **more}
    found = tire_forces(model, OperatingPoints(**fields), limits="ignore", outputs=PLANE_FORCES)
    return {"slip": x, "fx": found.fx, "fy": found.fy, "mz": found.mz}


def slip_range(model: TireParameters, slip: str) -> np.ndarray:
    """Return slips to look at: to 15 degrees or a ratio of 0.3, or to where the file's range ends."""
    most = LARGEST_SLIP_ANGLE if slip == "slip_angle" else LARGEST_SLIP_RATIO
    low, high = model.ranges[slip][2:] if slip in model.ranges else (-most, most)
    return np.linspace(max(low, -most), min(high, most), _POINTS_OF_CURVE)


def usual_loads(models: Sequence[TireParameters]) -> list[float]:
    """Return loads to look at, within all files' ranges (N).

    Half, one and one and a half nominal loads; where the range holds only one, its ends and middle.
    """
    ranges = [model.ranges["normal_load"][2:] for model in models if "normal_load" in model.ranges]
    low, high = max((r[0] for r in ranges), default=0.0), min((r[1] for r in ranges), default=np.inf)
    nominal = float(np.mean([model.value("FNOMIN") for model in models]))
    inside = [share * nominal for share in SHARES_OF_LOAD if low <= share * nominal <= high]
    if len(inside) < _FEWEST_LOADS and 0.0 < low < high < np.inf:
        return [low, 0.5 * (low + high), high]
    return inside or [nominal]


def camber_stiffness(model: TireParameters, normal_load: float) -> float:
    """Return the side force to the side to which the wheel leans, N/rad, while rolling straight.

    NaN where the model has none.

    Parameters
    ----------
    model : TireParameters
    normal_load : float
        N.
    """
    either = np.array([-_SMALL_CAMBER, _SMALL_CAMBER])
    found = tire_forces(model, OperatingPoints(normal_load=normal_load, camber=either), limits="ignore")
    stiffness = -float(np.diff(found.fy)[0]) / (2.0 * _SMALL_CAMBER)
    return stiffness if model.value("PDY1") and stiffness else float("nan")


def _trail(model: TireParameters, still: Any) -> float:
    """Pneumatic trail while rolling straight, m; NaN where the model has none."""
    return float(still.trail) if model.value("QDZ1") and model.value("PDY1") else float("nan")


def _stiffness(model: TireParameters, level: str, value: Any) -> float:
    """Magnitude of a stiffness; NaN if it is zero, or there is no force that it would be of."""
    return abs(float(value)) if model.value(level) and float(value) else float("nan")


def _peak(size: np.ndarray) -> float:
    most = float(np.max(size))
    return most if most > 0.0 else float("nan")


def _at_peak(slip: np.ndarray, size: np.ndarray) -> float:
    """Slip of the largest force, NaN if the force still grows where the range ends or is zero everywhere."""
    place = int(np.argmax(size))
    inside = 0 < place < size.size - 1 and size[place] > 0.0
    return abs(float(slip[place])) if inside else float("nan")


def _positive(value: Any) -> float:
    return float(value) if float(value) > 0.0 else float("nan")
