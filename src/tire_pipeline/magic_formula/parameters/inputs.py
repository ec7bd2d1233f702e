"""Operating points: broadcasting, ranges, and the warnings about them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from tire_pipeline.channels import ANGLE_CHANNELS
from tire_pipeline.errors import TirShapeError, TirValueError

LOOKS_LIKE_DEGREES = 1.6
"""Angles beyond this (rad) cause a warning."""

_VALUES_AT_ONCE = 1 << 20
_STACK_LEVEL_OF_INPUTS = 5


class TireRangeWarning(UserWarning):
    """Operating points lie outside the range that the tire model is valid for.

    See Also
    --------
    tire_pipeline.magic_formula.TireModel.forces : With ``limits`` it clips, raises or is silent instead.
    DegreesWarning : Warns of angles that no range would explain.

    Notes
    -----
    The ranges are those of the file: FZMIN and FZMAX, ALPMIN and ALPMAX, and so on. A range that the file
    does not state causes no warning.

    Examples
    --------
    >>> import warnings
    >>> from tire_pipeline.magic_formula import TireModel
    >>> given = {"FNOMIN": 4000, "FZMAX": 6000, "PCY1": 1.3, "PDY1": 1, "PKY1": -20, "PKY2": 2}
    >>> tire = TireModel.from_coefficients(given)
    >>> with warnings.catch_warnings(record=True) as told:
    ...     forces = tire.forces(slip_angle=0.05, normal_load=7000.0, outputs=("fy",))
    >>> print(told[0].message)
    operating points lie outside ... (normal_load: 1 of 1 outside FZMIN = -inf to FZMAX = 6000)
    """


class DegreesWarning(UserWarning):
    """Angles are so large that they look like degrees.

    See Also
    --------
    TireRangeWarning : Warns of values beyond the ranges that the file states.

    Notes
    -----
    A slip angle or camber beyond 1.6 rad (92 degrees) is one that no tire has. The warning comes whatever
    ``limits`` are.

    Examples
    --------
    >>> import warnings
    >>> from tire_pipeline.magic_formula import TireModel
    >>> given = {"FNOMIN": 4000, "PCY1": 1.3, "PDY1": 1, "PKY1": -20, "PKY2": 2}
    >>> tire = TireModel.from_coefficients(given)
    >>> with warnings.catch_warnings(record=True) as told:
    ...     forces = tire.forces(slip_angle=5.0, normal_load=4000.0, limits="ignore", outputs=("fy",))
    >>> print(told[0].message)
    slip_angle: 1 of 1 values are beyond 1.6 rad: this looks like degrees; the model takes radians
    """


def as_float_arrays(inputs: Mapping[str, Any]) -> tuple[dict[str, np.ndarray], tuple[int, ...]]:
    """Return the inputs as float arrays and the shape they broadcast to.

    Raises
    ------
    TirValueError
        If an input is not numeric.
    TirShapeError
        If the inputs do not broadcast; it names the arrays and their shapes.
    """
    arrays: dict[str, np.ndarray] = {}
    for name, value in inputs.items():
        if isinstance(value, str):
            raise TirValueError(f"{name} is not numeric: {value!r}", key=name)
        try:
            array = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError):
            raise TirValueError(f"{name} is not numeric: {value!r}", key=name) from None
        arrays[name] = array if array.flags.aligned else array.copy()
    shapes = {array.shape for array in arrays.values()}
    if len(shapes) == 1:
        return arrays, shapes.pop()
    try:
        return arrays, np.broadcast_shapes(*shapes)
    except ValueError:
        listed = ", ".join(f"{k} {a.shape}" for k, a in arrays.items() if a.ndim)
        raise TirShapeError(
            f"the operating points do not broadcast against each other: {listed}",
            todo="pass arrays of one shape, or scalars",
        ) from None


def apply_limits(
    arrays: dict[str, np.ndarray],
    ranges: Mapping[str, tuple[str, str, float, float]],
    limits: str,
    flipped: Mapping[str, bool],
) -> tuple[dict[str, np.ndarray], float]:
    """Check the inputs against the file's ranges; warn, clip or raise.

    Parameters
    ----------
    arrays : dict of str to ndarray
    ranges : mapping
        Input -> names and values of the two ends of its range.
    limits : {"warn", "clip", "raise", "ignore"}
    flipped : mapping of str to bool
        The inputs whose sign is the other way round than in the file's axes.

    Returns
    -------
    arrays : dict of str to ndarray
        The inputs, clipped if asked.
    largest_angle : float
        The largest magnitude of slip angle and camber.

    Raises
    ------
    TirValueError
        If a point lies outside and ``limits`` is "raise", or ``limits`` is not known.
    """
    if limits not in ("warn", "clip", "raise", "ignore"):
        raise TirValueError(
            f"limits {limits!r} is not known", key="limits", todo='use "warn", "clip" or "raise"'
        )
    extremes = {name: _extremes(array) for name, array in arrays.items()}
    largest_angle = max(max(-low, high) for low, high in (extremes[name] for name in ANGLE_CHANNELS))
    if largest_angle > LOOKS_LIKE_DEGREES:
        _warn_of_degrees(arrays, extremes)
    if limits == "ignore":
        return arrays, largest_angle
    found: list[str] = []
    for name, (low_key, high_key, low, high) in ranges.items():
        if flipped.get(name):
            low, high = -high, -low
        least, most = extremes[name]
        if least >= low and most <= high:
            continue
        if limits == "clip":
            clipped = np.clip(arrays[name], low, high)
            # a load of zero or less means no contact, whatever the range
            arrays[name] = np.where(arrays[name] > 0, clipped, 0) if name == "normal_load" else clipped
            continue
        count = _count_outside(arrays[name], low, high, name == "normal_load")
        if count:
            found.append(
                f"{name}: {count} of {arrays[name].size} outside {low_key} = {low:g} to {high_key} = {high:g}"
            )
    if found:
        _tell("; ".join(found), limits)
    return arrays, largest_angle


def _extremes(array: np.ndarray) -> tuple[float, float]:
    if array.size == 1:
        value = array.item()
        return value, value
    if array.size == 0:
        return 0.0, 0.0
    return float(array.min()), float(array.max())


def _count_outside(array: np.ndarray, low: float, high: float, is_load: bool) -> int:
    flat = array.reshape(-1)
    count = 0
    for start in range(0, flat.size, _VALUES_AT_ONCE):
        part = flat[start : start + _VALUES_AT_ONCE]
        outside = (part < low) | (part > high)
        if is_load:
            outside &= part > 0
        count += int(np.count_nonzero(outside))
    return count


def _tell(found: str, limits: str) -> None:
    if limits == "raise":
        raise TirValueError(
            f"operating points lie outside the model's range ({found})",
            todo='leave them out, or use limits="clip" or "warn"',
        )
    warnings.warn(
        f"operating points lie outside the model's range and are evaluated as they are ({found})",
        TireRangeWarning,
        stacklevel=_STACK_LEVEL_OF_INPUTS,
    )


def _warn_of_degrees(arrays: Mapping[str, np.ndarray], extremes: Mapping[str, tuple[float, float]]) -> None:
    for name in ANGLE_CHANNELS:
        low, high = extremes[name]
        if max(-low, high) > LOOKS_LIKE_DEGREES:
            count = _count_outside(arrays[name], -LOOKS_LIKE_DEGREES, LOOKS_LIKE_DEGREES, False)
            warnings.warn(
                f"{name}: {count} of {arrays[name].size} values are beyond {LOOKS_LIKE_DEGREES} rad: "
                "this looks like degrees; the model takes radians",
                DegreesWarning,
                stacklevel=_STACK_LEVEL_OF_INPUTS,
            )
