"""Derivatives of forces and moments with respect to coefficients."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from tire_pipeline.channels import PLANE_FORCES, POINT_CHANNELS
from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula.derivatives.gradients import gradients_of
from tire_pipeline.magic_formula.equations.jit import HAVE_NUMBA, compiled
from tire_pipeline.magic_formula.equations.numpy_form import SATURATION, relative_pressure
from tire_pipeline.magic_formula.equations.shapes import clamp
from tire_pipeline.magic_formula.parameters.coefficients import INDEX, Coefficients
from tire_pipeline.magic_formula.parameters.inputs import as_float_arrays
from tire_pipeline.magic_formula.parameters.points import OperatingPoints, refuse_turn_slip
from tire_pipeline.magic_formula.parameters.tire_parameters import TireParameters

_POINTS_AT_ONCE = 4096


def jacobian(
    model: TireParameters,
    names: Sequence[str],
    points: OperatingPoints,
    *,
    outputs: Sequence[str] = PLANE_FORCES,
    out: Mapping[str, np.ndarray] | None = None,
) -> dict[str, np.ndarray]:
    """Return d(output) / d(coefficient) at operating points.

    Parameters
    ----------
    model : TireParameters
    names : sequence of str
        Coefficients, by ``.tir`` name; a column of zeros for one that the output does not depend on.
    points : OperatingPoints
        In ISO W axes. Ranges are not checked, turn slip is not supported.
    outputs : sequence of str
        Some of "fx", "fy", "mx", "my", "mz".
    out : mapping of str to ndarray of shape (len(names), number of points), optional
        Arrays to write each output's derivatives into, which saves allocating new ones.

    Returns
    -------
    dict of str to ndarray of shape (*shape of the points, len(names))

    Raises
    ------
    TirValueError
        For a name that is not a coefficient, an output without derivatives, or points with turn slip.
    TirShapeError
        If the arguments do not broadcast.

    Notes
    -----
    Analytic: the equations are differentiated backwards once (:mod:`.derive`). At a kink (a bound, a
    magnitude, a sign) it is the derivative of one side.
    """
    refuse_turn_slip(points, "derivatives")
    arrays, shape = as_float_arrays(dict(zip(POINT_CHANNELS, model.channels_at(points), strict=True)))
    flat = [np.ascontiguousarray(np.broadcast_to(x, shape)).reshape(-1) for x in arrays.values()]
    found = packed_jacobian(model.packed, model.family, names, flat, outputs, out)
    return {name: value.T.reshape(*shape, len(names)) for name, value in found.items()}


def packed_jacobian(
    vector: np.ndarray,
    family: int,
    names: Sequence[str],
    points: Sequence[np.ndarray],
    outputs: Sequence[str],
    given: Mapping[str, np.ndarray] | None = None,
) -> dict[str, np.ndarray]:
    """Return the derivatives with respect to some of a packed vector's coefficients.

    Parameters
    ----------
    vector : ndarray
        Packed coefficients.
    family : {5, 6}
    names : sequence of str
    points : six contiguous ndarrays of shape (points,)
        Slip angle, slip ratio, camber, load, speed, pressure.
    outputs : sequence of str
    given : mapping of str to C-contiguous ndarray of shape (len(names), points), optional
        Arrays to write the results into.

    Returns
    -------
    dict of str to ndarray of shape (len(names), points)
    """
    unknown = [name for name in names if name not in INDEX]
    if unknown:
        raise TirValueError(f"{unknown} are not coefficients", todo="use names of COEFFICIENT_NAMES")
    module = gradients_of(family)
    p: Any = Coefficients(*vector.tolist())
    alpha, kappa, gamma, fz, speed, pressure = points
    with np.errstate(all="ignore"):
        loaded = fz > 0.0
        load = np.where(loaded, np.minimum(fz, SATURATION), p.FNOMIN)
        state = [clamp(x, SATURATION) for x in (alpha, kappa, gamma)]
        state += [load, clamp(speed, SATURATION), relative_pressure(p, pressure)]
    found = {}
    for output in outputs:
        if output not in module.OVER:
            raise TirValueError(f"{output!r} has no derivatives", todo=f"use some of {list(module.OVER)}")
        rows, absent = _places(tuple(module.OVER[output]), tuple(names))
        out = np.empty((len(names), len(fz))) if given is None else given[output]
        out[absent] = 0.0
        _fill(family, output, np.asarray(vector), p, state, rows, out)
        if not loaded.all():
            out[:, ~loaded] = 0.0
        found[output] = out
    return found


@lru_cache(maxsize=1000)
def _places(over: tuple[str, ...], names: tuple[str, ...]) -> tuple[np.ndarray, list[int]]:
    """Return the row for the derivative over each coefficient, -1 for none, and the rows that stay empty."""
    place = {name: i for i, name in enumerate(names)}
    rows = np.array([place.get(name, -1) for name in over])
    return rows, [i for name, i in place.items() if name not in over]


def _fill(
    family: int,
    output: str,
    vector: np.ndarray,
    p: Any,
    state: Sequence[np.ndarray],
    rows: np.ndarray,
    out: np.ndarray,
) -> None:
    if HAVE_NUMBA and max(np.abs(x).max(initial=0.0) for x in (state[0], state[2])) <= 1e4:
        _compiled(family, output)(vector, *state, rows, out)
        return
    gradient = getattr(gradients_of(family), output)
    for start in range(0, out.shape[1], _POINTS_AT_ONCE):
        part = slice(start, start + _POINTS_AT_ONCE)
        with np.errstate(all="ignore"):
            values = gradient(p, *(x[part] for x in state))
        for row, value in zip(rows, values, strict=True):
            if row >= 0:
                out[row, part] = value


@lru_cache(maxsize=10)
def _compiled(family: int, output: str) -> Callable[..., None]:
    from numba import types

    from tire_pipeline.magic_formula.compiled import fast_math

    assert fast_math is not None  # it has taught numba the operations
    vector = types.Array(types.float64, 1, "C", readonly=True)
    signature = types.void(
        *([vector] * 7),
        types.Array(types.int64, 1, "C", readonly=True),
        types.Array(types.float64, 2, "C"),
    )
    return compiled(getattr(gradients_of(family), f"loop_{output}"), signature)
