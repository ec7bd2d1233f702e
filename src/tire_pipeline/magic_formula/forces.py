"""Forces and moments at operating points: arguments in, arrays out."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.lib.stride_tricks import as_strided

from tire_pipeline.channels import ANGLE_CHANNELS, POINT_CHANNELS
from tire_pipeline.errors import TirValueError
from tire_pipeline.magic_formula.compiled import engine
from tire_pipeline.magic_formula.equations.jit import HAVE_NUMBA
from tire_pipeline.magic_formula.equations.numpy_form import OUTPUTS
from tire_pipeline.magic_formula.parameters import inputs
from tire_pipeline.magic_formula.parameters.axes import Signs, is_mirrored, signs_of
from tire_pipeline.magic_formula.parameters.points import OperatingPoints
from tire_pipeline.magic_formula.parameters.tire_parameters import TireParameters

_BUFFER = 32768
"""Points at a time where the arguments have to be broadcast against each other."""


NEEDS_RADIUS = ("mx", "my", "mz", "trail", "relaxation_lateral", "relaxation_longitudinal")
"""Outputs that are proportional to ``UNLOADED_RADIUS``; turn slip needs it for all outputs."""

_BY_CARCASS = {
    "relaxation_lateral": "LATERAL_STIFFNESS",
    "relaxation_longitudinal": "LONGITUDINAL_STIFFNESS",
}  # MF 6.1 takes these instead of the radius where it has them
_STACK_LEVEL_OF_RADIUS = 4
_NUMBERS = frozenset((float, int, np.float64))


class MissingRadiusWarning(UserWarning):
    """Moments are NaN because the model has no ``UNLOADED_RADIUS``.

    See Also
    --------
    tire_pipeline.magic_formula.TireModel.forces : Its ``outputs`` say what is wanted; forces need no radius.
    tire_pipeline.tir.read_tir : Takes the radius (m) where a file lacks it.

    Notes
    -----
    Moments, the pneumatic trail and the relaxation lengths are in proportion to the radius. In MF 6.1 and 6.2
    the relaxation lengths follow from the stiffness of the carcass where the file has it.

    Examples
    --------
    >>> import warnings
    >>> from tire_pipeline.magic_formula import TireModel
    >>> given = {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1, "PKY1": -20, "PKY2": 2}
    >>> tire = TireModel.from_coefficients(given)
    >>> with warnings.catch_warnings(record=True) as told:
    ...     forces = tire.forces(slip_angle=0.05, normal_load=4000.0, outputs=("fy", "mz"))
    >>> print(told[0].message)
    the model has no UNLOADED_RADIUS: no value (NaN) for mz; state the radius (m) by model.replace(...
    """


@dataclass(frozen=True)
class TireForces:
    """Forces and moments of the contact patch, and intermediate results. None: not requested.

    Attributes
    ----------
    fx, fy : float or ndarray
        Longitudinal and lateral force (N).
    mx, my, mz : float or ndarray
        Overturning, rolling resistance and aligning moment (N m); NaN where the model has no
        ``UNLOADED_RADIUS``, and so are the trail and other results in proportion to the radius.
    trail : float or ndarray
        Pneumatic trail (m).
    friction_x, friction_y : float or ndarray
        Peak friction coefficients mu_x and mu_y.
    cornering_stiffness : float or ndarray
        K_y, slope of the side force over the slip angle (N/rad); negative in ISO W axes.
    slip_stiffness : float or ndarray
        K_x, slope of the longitudinal force over the slip ratio (N).
    relaxation_lateral, relaxation_longitudinal : float or ndarray
        Relaxation lengths (m).

    See Also
    --------
    TireModel.forces : What returns it.

    Notes
    -----
    Signs are those of the axes that were asked for; in ISO W axes a positive slip angle gives a negative Fy
    for the usual signs of coefficients (docs/reference/axes.md).

    Examples
    --------
    >>> from tire_pipeline.magic_formula import TireModel
    >>> tire = TireModel.from_coefficients(
    ...     {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1.0, "PKY1": -20, "PKY2": 2}
    ... )
    >>> found = tire.forces(slip_angle=0.05, normal_load=4000, outputs=["fy"])
    >>> round(float(found.fy), 1), found.mz
    (-2629.0, None)
    """

    fx: Any = None
    fy: Any = None
    mx: Any = None
    my: Any = None
    mz: Any = None
    trail: Any = None
    friction_x: Any = None
    friction_y: Any = None
    cornering_stiffness: Any = None
    slip_stiffness: Any = None
    relaxation_lateral: Any = None
    relaxation_longitudinal: Any = None

    def __repr__(self) -> str:
        asked = {f.name: getattr(self, f.name) for f in fields(self) if getattr(self, f.name) is not None}
        return f"TireForces({', '.join(f'{name}={_in_short(value)}' for name, value in asked.items())})"


def _in_short(value: Any) -> str:
    """A number with five digits; of many, their shape and range."""
    numbers = np.asarray(value, float)
    if numbers.size == 1:
        return f"{numbers.item():.5g}"
    seen = numbers[np.isfinite(numbers)]
    ends = f", {seen.min():.5g} to {seen.max():.5g}" if seen.size else ""
    return f"<{' x '.join(map(str, numbers.shape))}{ends}>"


def tire_forces(
    model: TireParameters,
    points: OperatingPoints,
    *,
    side: str | None = None,
    axes: str = "ISO",
    limits: str = "warn",
    outputs: Sequence[str] | None = None,
) -> TireForces:
    """Evaluate a tire model; see :meth:`TireModel.forces`."""
    point = model.channels_at(points)
    turn_slip = points.turn_slip
    if (
        HAVE_NUMBA
        and model.moderate
        and not model.lacks_radius
        and axes == "ISO"
        and side is None
        and turn_slip.__class__ in _NUMBERS
    ):
        quick = _one_point(model, point, turn_slip, limits, outputs)
        if quick is not None:
            return quick
    wanted = checked_outputs(outputs)
    signs = signs_of(axes, is_mirrored(side, model.metadata.get("MODEL.TYRESIDE")))
    given = dict(zip(POINT_CHANNELS, point, strict=True))
    arrays, shape = inputs.as_float_arrays({**given, "turn_slip": turn_slip})
    flipped = {name: getattr(signs, name) < 0 for name in ANGLE_CHANNELS}
    arrays, largest = inputs.apply_limits(arrays, model.ranges, limits, flipped)
    turn = arrays.pop("turn_slip")
    turning = model.family == 6 and bool(turn.any() if turn.ndim else turn)
    if model.lacks_radius:
        _warn_of_radius(model, wanted, turning)
    values = _evaluate(
        model,
        [*arrays.values(), turn * signs.turn_slip] if turning else list(arrays.values()),
        shape,
        _sign_vector(signs),
        wanted,
        largest,
    )
    return TireForces(**dict(zip(wanted, values, strict=True)))


def _one_point(
    model: TireParameters,
    point: tuple[Any, ...],
    turn_slip: Any,
    limits: str,
    outputs: Sequence[str] | None,
) -> TireForces | None:
    """Evaluate one ordinary point in ISO axes without arrays; None if it is not an ordinary one."""
    for x in point:
        if x.__class__ not in _NUMBERS:
            return None
    if turn_slip != 0 or limits != "warn":
        return None
    if not (abs(point[0]) <= inputs.LOOKS_LIKE_DEGREES and abs(point[2]) <= inputs.LOOKS_LIKE_DEGREES):
        return None
    for place, low, high in model.range_list:
        if not low <= point[place] <= high:
            return None
    values = engine.run_point(model.packed, model.family, point)
    if outputs is None:
        found = object.__new__(TireForces)
        vars(found).update(zip(OUTPUTS, values, strict=True))  # a frozen dataclass takes three times as long
        return found
    return TireForces(**{name: values[OUTPUTS.index(name)] for name in checked_outputs(outputs)})


def _warn_of_radius(model: TireParameters, wanted: Sequence[str], turning: bool) -> None:
    lost = [name for name in wanted if turning or _needs_radius(model, name)]
    if not lost:
        return
    place = f" of {model.path}" if model.path else ""
    warnings.warn(
        f"the model{place} has no UNLOADED_RADIUS: no value (NaN) for {', '.join(lost)}; state the radius "
        "(m) by model.replace(UNLOADED_RADIUS=...) or read_tir(path, unloaded_radius=...)",
        MissingRadiusWarning,
        stacklevel=_STACK_LEVEL_OF_RADIUS,
    )


def _needs_radius(model: TireParameters, name: str) -> bool:
    carcass = _BY_CARCASS.get(name) if model.family == 6 else None
    return name in NEEDS_RADIUS and not (carcass and model.value(carcass) != 0)


@lru_cache(maxsize=16)
def _sign_vector(signs: Signs) -> np.ndarray:
    by_output = [getattr(signs, name, 1.0) for name in OUTPUTS]
    by_output[OUTPUTS.index("cornering_stiffness")] = signs.fy * signs.slip_angle
    vector = np.array([signs.slip_angle, signs.camber, *by_output])
    vector.flags.writeable = False
    return vector


def _evaluate(
    model: TireParameters,
    arrays: list[np.ndarray],
    shape: tuple[int, ...],
    signs: np.ndarray,
    wanted: Sequence[str],
    largest: float,
) -> list[Any]:
    """Arrange the points as rows, evaluate them, and reshape the results."""
    matrix = model.packed[None, :]
    size = math.prod(shape)
    if all(_is_row(x, shape) for x in arrays):
        rows = [x.reshape(1, -1) if x.shape == shape else _repeated(x, size) for x in arrays]
        out = engine.run(matrix, model.family, rows[:6], signs, wanted, largest, *rows[6:])[0]
    else:
        out = np.empty((len(wanted), size))
        start = 0
        flags: Any = ["external_loop", "buffered", "delay_bufalloc", "zerosize_ok"]
        with np.nditer(arrays, flags, [["readonly"]] * len(arrays), order="C", buffersize=_BUFFER) as chunks:
            chunks.reset()
            for chunk in chunks:
                rows = [x[None, :] for x in chunk]
                stop = start + rows[0].shape[1]
                out[:, start:stop] = engine.run(
                    matrix, model.family, rows[:6], signs, wanted, largest, *rows[6:]
                )[0]
                start = stop
    if not shape:
        return [row[0] for row in out]
    return [row.reshape(shape) for row in out]


def _is_row(x: np.ndarray, shape: tuple[int, ...]) -> bool:
    return x.size == 1 or (x.shape == shape and (x.ndim == 1 or x.flags.c_contiguous))


def _repeated(x: np.ndarray, size: int) -> np.ndarray:
    return as_strided(x.reshape(1), (1, size), (0, 0), writeable=False)


def checked_outputs(outputs: Sequence[str] | None) -> tuple[str, ...]:
    """Return the names of the outputs that are asked for; all of them for None.

    Raises
    ------
    TirValueError
        For a name that is not an output.
    """
    if outputs is None:
        return OUTPUTS
    unknown = [name for name in outputs if name not in OUTPUTS]
    if unknown:
        raise TirValueError(
            f"outputs {unknown} are not known", key="outputs", todo=f"use some of {list(OUTPUTS)}"
        )
    return tuple(outputs)
