"""Many tires at many points in one call, on plain arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Unpack

import numpy as np

from tire_pipeline.channels import ANGLE_CHANNELS, PLANE_FORCES, POINT_CHANNELS
from tire_pipeline.errors import TirShapeError, TirValueError
from tire_pipeline.magic_formula.compiled import engine
from tire_pipeline.magic_formula.forces import checked_outputs
from tire_pipeline.magic_formula.parameters.coefficients import (
    COEFFICIENT_NAMES,
    INDEX,
    family_of,
    missing_defaults,
    pack_mapping,
)
from tire_pipeline.magic_formula.parameters.inputs import as_float_arrays
from tire_pipeline.magic_formula.parameters.points import (
    OperatingPoints,
    PointFields,
    points_of,
    refuse_turn_slip,
)
from tire_pipeline.magic_formula.parameters.tire_parameters import TireParameters

_NEUTRAL_OF_VERSION = {version: pack_mapping({}, missing_defaults({}, version)) for version in ("5.2", "6.1")}


def pack(model: TireParameters) -> np.ndarray:
    """Return a model's coefficients as a vector.

    Parameters
    ----------
    model : TireParameters
        Of any version.

    Returns
    -------
    ndarray of shape (len(COEFFICIENT_NAMES),)
        In the order of ``COEFFICIENT_NAMES``, SI units; a copy.

    See Also
    --------
    pack_matrix : The same for a table of many tires.
    model_of : The way back.

    Notes
    -----
    Names are those of the ``.tir`` format. What the model lacks has its neutral value, 0 or 1.

    Examples
    --------
    >>> from tire_pipeline.magic_formula import COEFFICIENT_NAMES, TireModel
    >>> tire = TireModel.from_coefficients(
    ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
    ... )
    >>> float(pack(tire)[COEFFICIENT_NAMES.index("PDY1")])
    1.0
    """
    return model.packed.copy()


def pack_matrix(values: Any, names: Sequence[str], version: str = "5.2") -> np.ndarray:
    """Return packed coefficients of many tires.

    Parameters
    ----------
    values : array_like of shape (tires, len(names))
        Coefficients by ``.tir`` name, SI units. NaN stands for a coefficient that the tire lacks.
    names : sequence of str
        Names of the columns; those that the equations do not use are ignored.
    version : str
        Determines the defaults of missing coefficients, as in :class:`TireModel`.

    Returns
    -------
    ndarray of shape (tires, len(COEFFICIENT_NAMES))
        Coefficients in the order of ``COEFFICIENT_NAMES``, SI units.

    Raises
    ------
    TirShapeError
        If there are not as many columns as names.
    TirValueError
        If a tire has no nominal load.

    See Also
    --------
    pack : The same for one model.
    forces_batch : Forces of what is packed.

    Notes
    -----
    Missing nominal and inflation pressure stand in for each other, as in :class:`TireModel`.

    Examples
    --------
    >>> matrix = pack_matrix([[4000.0, 1.3, 1.0, -20.0, 2.0]], ["FNOMIN", "PCY1", "PDY1", "PKY1", "PKY2"])
    >>> round(float(forces_batch(matrix, slip_angle=0.05, normal_load=4000.0)["fy"][0, 0]), 1)
    -2629.0
    """
    values = np.asarray(values, dtype=np.float64)
    if values.ndim != 2 or values.shape[1] != len(names):
        raise TirShapeError(
            f"coefficients have shape {values.shape}, but there are {len(names)} names",
            todo="pass one row per tire and one column per name",
        )
    neutral = _NEUTRAL_OF_VERSION["5.2" if family_of(version) == 5 else "6.1"]
    matrix = np.tile(neutral, (len(values), 1))
    for column, name in enumerate(names):
        place = INDEX.get(name)
        if place is not None:
            given = values[:, column]
            matrix[:, place] = np.where(np.isnan(given), matrix[:, place], given)
    for name, other in (("NOMPRES", "INFLPRES"), ("INFLPRES", "NOMPRES")):
        empty = matrix[:, INDEX[name]] == 0
        matrix[empty, INDEX[name]] = matrix[empty, INDEX[other]]
    if not (matrix[:, INDEX["FNOMIN"]] > 0).all():
        bad = np.flatnonzero(~(matrix[:, INDEX["FNOMIN"]] > 0))
        raise TirValueError(
            f"{len(bad)} tires have no positive FNOMIN (rows {bad[:5].tolist()} ...)", key="FNOMIN"
        )
    return matrix


def forces_batch(
    matrix: np.ndarray,
    points: OperatingPoints | None = None,
    *,
    version: str = "5.2",
    outputs: Sequence[str] = PLANE_FORCES,
    **channels: Unpack[PointFields],
) -> dict[str, np.ndarray]:
    """Evaluate many tires, each at the same points or each at its own.

    Parameters
    ----------
    matrix : ndarray of shape (tires, len(COEFFICIENT_NAMES))
        Packed coefficients (:func:`pack`, :func:`pack_matrix`); all of versions of one family of equations.
    points : OperatingPoints, optional
        In ISO W axes; or pass its fields by keyword. They broadcast together to (points,), or to (tires,
        points) where each tire has its own. Speed and pressure left out: each tire's ``LONGVL`` and nominal
        pressure. Turn slip is not supported.
    **channels : float or array_like
        ``normal_load`` (N), ``slip_angle`` (rad), ``slip_ratio``, ``camber`` (rad), ``speed`` (m/s),
        ``pressure`` (Pa); see :class:`.OperatingPoints`.
    version : str
        A version of the family: "5.2" (also for PAC2002, 5.0, 5.1) or "6.1" (also for 6.2).
    outputs : sequence of str
        Fields of :class:`TireForces` to compute.

    Returns
    -------
    dict of str to ndarray of shape (tires, points)
        Ranges are not checked here.

    Raises
    ------
    TirShapeError
        If shapes do not fit.
    TirValueError
        For an unknown output, or points with turn slip.

    See Also
    --------
    TireModel.forces : One tire, with ranges, sides, other axes and turn slip.
    pack_matrix : Coefficients of many tires from a table.

    Notes
    -----
    The equations are those of :meth:`TireModel.forces`: Appendix A of the thesis for 5.2; Pacejka, Tire and
    Vehicle Dynamics, 3rd edition, section 4.3.2 for 6.1 and 6.2.

    Examples
    --------
    >>> matrix = pack_matrix([[4000.0, 1.3, 1.0, -20.0, 2.0]], ["FNOMIN", "PCY1", "PDY1", "PKY1", "PKY2"])
    >>> forces_batch(matrix, slip_angle=[0.0, 0.05], normal_load=4000.0)["fy"].shape
    (1, 2)
    """
    matrix = np.ascontiguousarray(matrix, dtype=np.float64)
    if matrix.ndim != 2 or matrix.shape[1] != len(COEFFICIENT_NAMES):
        raise TirShapeError(
            f"packed coefficients have shape {matrix.shape}, not (tires, {len(COEFFICIENT_NAMES)})",
            todo="use pack or pack_matrix",
        )
    wanted = checked_outputs(outputs)
    given = points_of(points, channels)
    refuse_turn_slip(given, "forces of many tires")
    own = {"speed": matrix[:, [INDEX["LONGVL"]]], "pressure": matrix[:, [INDEX["NOMPRES"]]]}
    at = given._asdict()
    arrays, shape = as_float_arrays(
        {name: own[name] if at[name] is None else at[name] for name in POINT_CHANNELS}
    )
    tires = len(matrix)
    if len(shape) > 2 or (len(shape) == 2 and shape[0] not in (1, tires)):
        raise TirShapeError(
            f"points have shape {shape}; it must be (points,) or ({tires}, points)",
            todo="pass one row per tire",
        )
    full = (tires, shape[-1] if shape else 1)
    rows = [np.broadcast_to(x, full) for x in arrays.values()]
    largest = max(float(np.abs(arrays[name]).max(initial=0.0)) for name in ANGLE_CHANNELS)
    out = engine.run(matrix, family_of(version), rows, engine.NO_SIGNS, wanted, largest)
    return {name: out[:, k] for k, name in enumerate(wanted)}
