"""Where a stage of a fit may start and how far it may go: typical values, what the data show, bounds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.random import Generator

from tire_pipeline.channels import SLIP_OF_FORCE, TANGENTIAL_FORCES
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import BOUNDS, PRESSURE_BOUNDS, Stage
from tire_pipeline.magic_formula.model import TireModel

_NO_SLIP = 1e-6
"""Slips below this are zero."""


def typical_values(names: list[str], model: TireModel, from_start: bool) -> dict[str, float]:
    """Return the values that open coefficients are pulled towards: the start model's, or typical ones."""
    values = {name: _bound_of(name)[2] for name in names}
    if from_start:
        values.update({n: model.coefficients[n] for n in names if n in model.coefficients})
    return values


def _bound_of(name: str) -> tuple[float, float, float]:
    return BOUNDS.get(name, PRESSURE_BOUNDS)


def bounds_of(names: list[str], first: Mapping[str, float]) -> tuple[np.ndarray, np.ndarray]:
    """Return the lowest and highest values: a start outside of the usual ones widens them; signs are kept."""
    low = np.array([_bound_of(n)[0] for n in names])
    high = np.array([_bound_of(n)[1] for n in names])
    begin = np.array([first[n] for n in names])
    low = np.where(begin < low, begin - np.abs(begin), low)
    high = np.where(begin > high, begin + np.abs(begin), high)
    for i, name in enumerate(names):
        if name == "PKY1":
            low[i], high[i] = (low[i], -0.5) if first[name] < 0 else (0.5, high[i])
        elif name in ("PEY1", "PEX1", "QEZ1", "REX1", "REY1"):
            high[i] = 1.0
    return low, high


def first_values(
    stage: Stage, typical: Mapping[str, float], here: Mapping[str, np.ndarray], measured: np.ndarray
) -> dict[str, float]:
    """Return the start without a model: typical values, and rough estimates from the data."""
    first = dict(typical)
    load = here["normal_load"]
    slip = here[SLIP_OF_FORCE.get(stage.output, "slip_angle")]
    if stage.title.endswith("pure slip") and stage.output in TANGENTIAL_FORCES:
        friction = float(np.quantile(np.abs(measured) / load, 0.98))
        letter = stage.output[1].upper()
        first[f"PD{letter}1"] = min(max(1.05 * friction, 0.05), 3.5)
        slope = _slope_at_small_slip(slip, measured / load)
        if stage.output == "fy" and slope != 0:
            first["PKY1"] = float(np.clip(1.6 * slope, -190, 190))
        elif slope > 1:
            first["PKX1"] = min(slope, 190.0)
    return first


def _slope_at_small_slip(slip: np.ndarray, normalised: np.ndarray) -> float:
    """Return the slope over the smallest fifth of the slips, or else to the smallest one that is not zero.

    Sweeps in steps of two degrees have nothing but zero among their smallest fifth. A slip that is held, as
    in braking at one slip angle, moves by noise: its slope there says nothing, not even its sign.
    """
    size = np.abs(slip)
    small = size < max(0.03, float(np.quantile(size, 0.2)))
    if small.any() and np.ptp(slip[small]) > max(_NO_SLIP, 0.5 * size[small].max()):
        return float(np.polyfit(slip[small], normalised[small], 1)[0])
    moved = size > _NO_SLIP
    if not moved.any():
        return 0.0
    small = moved & (size < 1.01 * size[moved].min())
    return float(slip[small] @ normalised[small] / (slip[small] @ slip[small]))


def values_of(
    models: Sequence[TireModel], typical: Mapping[str, float], bounds: tuple[np.ndarray, np.ndarray]
) -> list[np.ndarray]:
    """Return the values that other models have of some coefficients, within bounds; typical ones they lack.

    Parameters
    ----------
    models : sequence of TireModel
    typical : mapping
        Value of each coefficient, in the order of the bounds.
    bounds : (ndarray, ndarray), shape (m,) each
    """
    return [np.clip([m.coefficients.get(n, x) for n, x in typical.items()], *bounds) for m in models]


def starting_points(
    first: np.ndarray, bounds: tuple[np.ndarray, np.ndarray], spread: np.ndarray, number: int, rng: Generator
) -> list[np.ndarray]:
    """Return the first values, and others drawn around them: as far as tires differ, or as bounds allow.

    The curvature, bounded by 1, has a kink that least squares do not cross: fits with other signs of PEY2 and
    PEY3 are found from starts that have them, and about one in ten does.
    """
    low, high = bounds
    wide = 0.3 * np.maximum(np.abs(first), 0.33 * (high - low))
    points = [first]
    for i in range(number - 1):
        shift = rng.standard_normal(first.size) * (wide if i % 2 else 2.0 * spread)
        points.append(np.clip(first + shift, low, high))
    return points
