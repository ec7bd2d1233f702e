"""Operating points: broadcasting, ranges, and the warnings about them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

import numpy as np

from tire_pipeline.errors import TirShapeError, TirValueError
from tire_pipeline.magic_formula.coefficients import RANGES

LOOKS_LIKE_DEGREES = 1.6
"""Angles beyond this (rad) draw a warning."""

_ANGLES = ("slip_angle", "camber")


class TireRangeWarning(UserWarning):
    """Operating points lie outside the range that the tire model is valid for."""


class DegreesWarning(UserWarning):
    """Angles are so large that they look like degrees."""


def as_float_arrays(inputs: Mapping[str, object]) -> tuple[dict[str, np.ndarray], tuple[int, ...]]:
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
        try:
            arrays[name] = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError):
            raise TirValueError(f"{name} is not numeric: {value!r}", key=name) from None
    shapes = {array.shape for array in arrays.values()}
    if len(shapes) == 1:
        return arrays, shapes.pop()
    try:
        return arrays, np.broadcast_shapes(*shapes)
    except ValueError:
        listed = ", ".join(f"{k} {a.shape}" for k, a in arrays.items() if a.ndim)
        raise TirShapeError(
            f"the operating points do not broadcast against each other: {listed}",
            todo="give arrays of one shape, or scalars",
        ) from None


def apply_limits(
    arrays: dict[str, np.ndarray], coefficients: Mapping[str, float], limits: str
) -> dict[str, np.ndarray]:
    """Check the inputs (ISO axes) against the file's ranges; warn, clip or raise.

    Parameters
    ----------
    arrays : dict of str to ndarray
    coefficients : mapping
        Holds ``ALPMIN``, ``ALPMAX`` and so on; a range that is missing is not checked.
    limits : {"warn", "clip", "raise", "ignore"}

    Returns
    -------
    dict of str to ndarray
        The inputs, clipped if asked.

    Raises
    ------
    TirValueError
        If a point lies outside and ``limits`` is "raise", or ``limits`` is not known.
    """
    if limits not in ("warn", "clip", "raise", "ignore"):
        raise TirValueError(
            f"limits {limits!r} is not known", key="limits", todo='use "warn", "clip" or "raise"'
        )
    _warn_of_degrees(arrays)
    if limits == "ignore":
        return arrays
    found: list[str] = []
    for name, (low_key, high_key) in RANGES.items():
        if name not in arrays:
            continue
        low = coefficients.get(low_key, -np.inf)
        high = coefficients.get(high_key, np.inf)
        if low >= high:
            continue
        array = arrays[name]
        if array.size == 0 or (array.min() >= low and array.max() <= high):
            continue
        if limits == "clip":
            arrays[name] = np.clip(array, low, high)
            continue
        outside = (array < low) | (array > high)
        if name == "normal_load":
            outside &= array > 0
        count = int(np.count_nonzero(outside))
        if count:
            found.append(
                f"{name}: {count} of {array.size} outside {low_key} = {low:g} to {high_key} = {high:g}"
            )
    if found:
        _tell("; ".join(found), limits)
    return arrays


def _tell(found: str, limits: str) -> None:
    if limits == "raise":
        raise TirValueError(
            f"operating points lie outside the model's range ({found})",
            todo='leave them out, or use limits="clip" or "warn"',
        )
    warnings.warn(
        f"operating points lie outside the model's range and are evaluated as they are ({found})",
        TireRangeWarning,
        stacklevel=5,
    )


def _warn_of_degrees(arrays: Mapping[str, np.ndarray]) -> None:
    for name in _ANGLES:
        array = arrays.get(name)
        if array is None or array.size == 0:
            continue
        if array.max() > LOOKS_LIKE_DEGREES or array.min() < -LOOKS_LIKE_DEGREES:
            count = int(np.count_nonzero(np.abs(array) > LOOKS_LIKE_DEGREES))
            warnings.warn(
                f"{name}: {count} of {array.size} values are beyond {LOOKS_LIKE_DEGREES} rad: this looks like degrees; "
                "the model takes radians",
                DegreesWarning,
                stacklevel=5,
            )
