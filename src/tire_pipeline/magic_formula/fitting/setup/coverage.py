"""The coefficients that a recording can determine, and those it leaves open."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.magic_formula.fitting.setup.measured import bulk
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import (
    BY_PRESSURE,
    BY_SPEED,
    CAMBER,
    CAMBER_AND_LOAD,
    LOAD,
    LOAD_SQUARED,
    ONE_SIDED_RATIO,
    ONE_SIDED_SLIP,
)

MIN_LOAD_SPREAD = 0.15
"""Spread of loads, over the nominal one, from which they count as different: a flat belt that holds one load
lets it fluctuate by 0.05 to 0.11."""
_STEP_OF_LEVELS = 0.2
"""Step of load, over the nominal one, from one level to the next."""
MIN_CAMBER = np.deg2rad(0.4)
MIN_PRESSURE_SPREAD = 0.05
"""Spread of pressures, over the median, from which they count as different. A rig that holds one pressure
lets it ripple by 0.02 to 0.04 as load and slip change. Stiffness goes with a power of pressure in which tires
differ by 0.4 (``SPREAD``): half of 0.05 either side changes the force by less than a formula's own error."""
WIDE_PRESSURE_SPREAD = 0.15
"""Spread of pressures, over the median, that counts as different without set pressures, as where a tire warms
up: half of it either side changes the force by three times a formula's own error."""
_PRESSURE_GAP = 0.25
"""Of the range of pressures, that lies empty between two set ones. Of a pressure that scatters, goes evenly
or as a wave, ``_PRESSURES_BETWEEN`` of the rows take up to 0.1; between 10 and 12 psi of a flat belt it is
most of it."""
_PRESSURES_BETWEEN = 0.02
_CAMBER_LEVEL = np.deg2rad(1.0)
_PRESSURES_OF_EACH = 0.1
"""Of the rows at one load and camber that has to be at another pressure."""
MIN_SPEED_SPREAD = 0.1
MIN_SLIP = 0.01
NO_CAMBER = "no camber sweeps"
ONE_PRESSURE = "one pressure only"
PRESSURE_WITH_LOAD = "each pressure at loads or cambers of its own"
RANGES = ("one load only", "one load only at camber", "one speed only")
BARELY = 0.5
"""An input that varies by less than this share of what counts as different varies by its noise."""


def open_coefficients(
    names: tuple[str, ...], points: Mapping[str, np.ndarray], nominal_load: float, share: float = 1.0
) -> dict[str, list[str]]:
    """Return the coefficients of a stage that its points cannot determine, by the reason.

    Parameters
    ----------
    names : tuple of str
    points : mapping of str to ndarray
        The stage's points, by canonical column.
    nominal_load : float
    share : float
        Of the spreads that count as different.

    Returns
    -------
    dict of str to list of str
        Reason, as in "no camber sweeps", -> names.
    """
    load, camber = points["normal_load"], points["camber"]
    tilted = np.abs(camber) > MIN_CAMBER
    loads_differ = _spread(load) > share * MIN_LOAD_SPREAD * nominal_load
    rules = [
        (not tilted.any(), NO_CAMBER, CAMBER | CAMBER_AND_LOAD),
        (not loads_differ, "one load only", LOAD | LOAD_SQUARED | CAMBER_AND_LOAD),
        (_levels(load, nominal_load) < 3, "fewer than three loads", LOAD_SQUARED),
        (
            tilted.any() and _spread(load[tilted]) <= share * MIN_LOAD_SPREAD * nominal_load,
            "one load only at camber",
            CAMBER_AND_LOAD,
        ),
        (_one_sided(points["slip_angle"]), "slip angles of one sign only", ONE_SIDED_SLIP),
        (_one_sided(points["slip_ratio"]), "slip ratios of one sign only", ONE_SIDED_RATIO),
        (not _pressures_differ(points["pressure"], share), ONE_PRESSURE, BY_PRESSURE),
        (
            not _pressures_differ_at_a_load(points, nominal_load, share),
            PRESSURE_WITH_LOAD,
            BY_PRESSURE,
        ),
        (
            _spread(points["speed"]) <= share * MIN_SPEED_SPREAD * max(np.median(points["speed"]), 1.0),
            "one speed only",
            BY_SPEED,
        ),
    ]
    found: dict[str, list[str]] = {}
    left = list(names)
    for applies, reason, concerned in rules:
        if applies:
            hit = [name for name in left if name in concerned]
            if hit:
                found[reason] = hit
                left = [name for name in left if name not in concerned]
    return found


def _pressures_differ(pressure: np.ndarray, share: float) -> bool:
    """Whether pressures were set that are farther apart than the scatter about each, or differ widely.

    The ripple of one set pressure follows the load and the force, and not the other way round.
    """
    spread = _spread(pressure) / max(float(np.median(pressure)), 1.0)
    if spread <= share * MIN_PRESSURE_SPREAD:
        return False
    return share < 1.0 or spread > WIDE_PRESSURE_SPREAD or _in_levels(pressure)


def _in_levels(pressure: np.ndarray) -> bool:
    """Whether the values lie about levels, with next to nothing between two of them."""
    low, high = bulk(pressure)
    ordered = np.sort(np.clip(pressure, low, high))
    few = max(1, int(_PRESSURES_BETWEEN * ordered.size))
    return float((ordered[few:] - ordered[:-few]).max()) > _PRESSURE_GAP * (high - low)


def _pressures_differ_at_a_load(points: Mapping[str, np.ndarray], nominal_load: float, share: float) -> bool:
    """Whether the pressure differs at one and the same load and camber: else these might do what it does."""
    pressure = points["pressure"]
    level = np.round(points["normal_load"] / (_STEP_OF_LEVELS * nominal_load))
    leaning = np.round(points["camber"] / _CAMBER_LEVEL)
    _, group = np.unique(np.column_stack([level, leaning]), axis=0, return_inverse=True)
    least = share * MIN_PRESSURE_SPREAD * max(float(np.median(pressure)), 1.0)
    for rows in np.split(np.argsort(group, kind="stable"), np.cumsum(np.bincount(group))[:-1]):
        low, high = np.quantile(pressure[rows], [_PRESSURES_OF_EACH, 1.0 - _PRESSURES_OF_EACH])
        if high - low > least:
            return True
    return False


def _spread(x: np.ndarray) -> float:
    if x.size < 2:
        return 0.0
    low, high = bulk(x)
    return high - low


def _levels(load: np.ndarray, nominal_load: float) -> int:
    return len(np.unique(np.round(load / (_STEP_OF_LEVELS * nominal_load))))


def _one_sided(slip: np.ndarray) -> bool:
    return not ((slip > MIN_SLIP).any() and (slip < -MIN_SLIP).any())


def noise_alone(names: tuple[str, ...], points: Mapping[str, np.ndarray], nominal_load: float) -> set[str]:
    """Return the coefficients whose input varies by no more than its noise: it determines nothing."""
    barely = open_coefficients(names, points, nominal_load, BARELY)
    return {name for reason in (NO_CAMBER, ONE_PRESSURE, *RANGES) for name in barely.get(reason, ())}
