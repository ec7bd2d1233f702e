"""The coefficients that a recording can determine, and those it leaves open."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

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
MIN_SPEED_SPREAD = 0.1
MIN_SLIP = 0.01
NO_CAMBER = "no camber sweeps"
ONE_PRESSURE = "one pressure only"
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
        (
            _spread(points["pressure"])
            <= share * MIN_PRESSURE_SPREAD * max(np.median(points["pressure"]), 1.0),
            ONE_PRESSURE,
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


def _spread(x: np.ndarray) -> float:
    if x.size < 2:
        return 0.0
    low, high = np.quantile(x, [0.02, 0.98])
    return float(high - low)


def _levels(load: np.ndarray, nominal_load: float) -> int:
    return len(np.unique(np.round(load / (_STEP_OF_LEVELS * nominal_load))))


def _one_sided(slip: np.ndarray) -> bool:
    return not ((slip > MIN_SLIP).any() and (slip < -MIN_SLIP).any())


def noise_alone(names: tuple[str, ...], points: Mapping[str, np.ndarray], nominal_load: float) -> set[str]:
    """Return the coefficients whose input varies by no more than its noise: it determines nothing."""
    barely = open_coefficients(names, points, nominal_load, BARELY)
    return {name for reason in (NO_CAMBER, ONE_PRESSURE, *RANGES) for name in barely.get(reason, ())}
