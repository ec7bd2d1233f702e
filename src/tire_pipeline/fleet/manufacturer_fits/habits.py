"""How each manufacturer fits: nominal load, weights, bounds, starts and frozen coefficients."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from tire_pipeline.fleet.manufacturer_fits.formula import FITTED_ALIGNING, FITTED_LATERAL, FITTED_LONGITUDINAL

# coefficient: start, expected spread (for the weak penalty), lower bound, upper bound
_LATERAL_TABLE: dict[str, tuple[float, float, float, float]] = {
    "PCY1": (1.40, 0.10, 1.05, 1.80),
    "PDY1": (0.95, 0.30, 0.40, 1.80),
    "PDY2": (-0.12, 0.10, -0.80, 0.40),
    "PDY3": (2.0, 2.0, -10.0, 20.0),
    "PEY1": (-0.5, 0.50, -5.0, 0.95),
    "PEY2": (-0.3, 0.25, -3.0, 3.0),
    "PEY3": (0.0, 0.10, -0.8, 0.8),
    "PEY4": (0.0, 2.0, -20.0, 20.0),
    "PKY1": (-20.0, 10.0, -60.0, -6.0),
    "PKY2": (1.8, 0.8, 0.6, 5.0),
    "PKY3": (0.4, 0.4, -2.0, 3.0),
    "PHY1": (0.0, 0.01, -0.05, 0.05),
    "PHY2": (0.0, 0.01, -0.05, 0.05),
    "PHY3": (0.05, 0.05, -0.4, 0.4),
    "PVY1": (0.0, 0.02, -0.2, 0.2),
    "PVY2": (0.0, 0.02, -0.2, 0.2),
    "PVY3": (0.0, 0.20, -2.0, 2.0),
    "PVY4": (0.0, 0.20, -2.0, 2.0),
}
_LONGITUDINAL_TABLE: dict[str, tuple[float, float, float, float]] = {
    "PCX1": (1.55, 0.15, 1.10, 1.95),
    "PDX1": (1.0, 0.30, 0.40, 1.90),
    "PDX2": (-0.10, 0.10, -0.80, 0.40),
    "PDX3": (0.5, 3.0, -12.0, 12.0),
    "PEX1": (0.2, 0.5, -4.0, 0.95),
    "PEX2": (0.0, 0.3, -3.0, 3.0),
    "PEX3": (0.0, 0.2, -2.0, 2.0),
    "PEX4": (0.0, 0.2, -0.9, 0.9),
    "PKX1": (22.0, 10.0, 5.0, 70.0),
    "PKX2": (-2.0, 5.0, -30.0, 30.0),
    "PKX3": (-0.1, 0.3, -1.5, 1.5),
    "PHX1": (0.0, 0.005, -0.03, 0.03),
    "PHX2": (0.0, 0.005, -0.03, 0.03),
    "PVX1": (0.0, 0.02, -0.1, 0.1),
    "PVX2": (0.0, 0.02, -0.1, 0.1),
}
_ALIGNING_TABLE: dict[str, tuple[float, float, float, float]] = {
    "QBZ1": (9.0, 4.0, 1.0, 30.0),
    "QBZ2": (-1.5, 1.5, -15.0, 15.0),
    "QBZ3": (0.0, 0.8, -8.0, 8.0),
    "QBZ4": (0.0, 0.5, -3.0, 3.0),
    "QBZ5": (0.0, 0.5, -3.0, 3.0),
    "QBZ9": (10.0, 5.0, 0.0, 40.0),
    "QBZ10": (0.0, 0.3, -1.0, 2.0),
    "QCZ1": (1.15, 0.10, 0.9, 1.6),
    "QDZ1": (0.11, 0.05, 0.02, 0.30),
    "QDZ2": (0.0, 0.02, -0.15, 0.15),
    "QDZ3": (0.0, 0.5, -4.0, 4.0),
    "QDZ4": (0.0, 4.0, -30.0, 30.0),
    "QDZ6": (0.0, 0.01, -0.05, 0.05),
    "QDZ7": (0.0, 0.01, -0.05, 0.05),
    "QDZ8": (0.0, 0.2, -1.0, 1.0),
    "QDZ9": (0.0, 0.1, -1.0, 1.0),
    "QEZ1": (-1.5, 1.5, -12.0, 0.95),
    "QEZ2": (0.3, 0.8, -6.0, 6.0),
    "QEZ3": (0.0, 0.4, -4.0, 4.0),
    "QEZ4": (0.0, 0.1, -0.7, 0.7),
    "QEZ5": (0.0, 1.0, -6.0, 6.0),
    "QHZ1": (0.0, 0.006, -0.04, 0.04),
    "QHZ2": (0.0, 0.006, -0.04, 0.04),
    "QHZ3": (0.05, 0.05, -0.5, 0.5),
    "QHZ4": (0.0, 0.05, -0.5, 0.5),
}


@dataclass(frozen=True)
class Habit:
    """One manufacturer's way of fitting.

    Attributes
    ----------
    nominal_fixed : float or None
        F_z0 in N, the same for all tires; else it follows from the tire.
    nominal_share : float
        F_z0 over rated load where ``nominal_fixed`` is ``None``, rounded to 50 N.
    load_power : float
        Weights go with (F_z/rated load) to this power.
    centre_weight : float
        Extra weight of small slip.
    ridge : float
        Strength of the penalty that holds coefficients near the start values.
    start : dict of str to float
        Own start values, in place of the common ones.
    bounds : dict of str to (float, float)
        Own bounds.
    frozen : dict of str to float
        Coefficients never fitted, and their values.
    sometimes_frozen : dict of str to (float, float)
        Coefficients frozen in a share of the projects: (share, value).
    """

    nominal_fixed: float | None = None
    nominal_share: float = 0.8
    load_power: float = -0.5
    centre_weight: float = 0.0
    ridge: float = 1.0
    start: dict[str, float] = field(default_factory=dict)
    bounds: dict[str, tuple[float, float]] = field(default_factory=dict)
    frozen: dict[str, float] = field(default_factory=dict)
    sometimes_frozen: dict[str, tuple[float, float]] = field(default_factory=dict)


_RARELY_FITTED = {"QBZ4": 0.0, "QDZ4": 0.0, "QEZ5": 0.0, "QHZ4": 0.0}

HABITS: dict[str, Habit] = {
    "A": Habit(
        nominal_fixed=4000.0,
        load_power=-0.7,
        ridge=1.1,
        frozen={**_RARELY_FITTED, "QBZ10": 0.0},
        sometimes_frozen={"PHY2": (0.25, 0.0)},
    ),
    "B": Habit(
        nominal_share=0.75,
        load_power=-0.3,
        ridge=2.0,
        start={"PCY1": 1.42},
        frozen={**_RARELY_FITTED, "QBZ5": 0.0, "PEX4": 0.0, "PDX3": 0.0},
        sometimes_frozen={"PVY2": (0.3, 0.0), "PEY3": (0.5, 0.0)},
    ),
    "C": Habit(
        nominal_fixed=5000.0,
        load_power=-0.5,
        centre_weight=0.8,
        ridge=1.5,
        bounds={"PCY1": (1.15, 1.60)},
        frozen={**_RARELY_FITTED, "QEZ3": 0.0, "PEX3": 0.0},
        sometimes_frozen={"PHY2": (0.3, 0.0), "PCY1": (0.15, 1.3)},
    ),
    "D": Habit(
        nominal_share=0.85,
        load_power=-0.45,
        ridge=1.9,
        frozen=_RARELY_FITTED,
        sometimes_frozen={"PHY2": (0.1, 0.0)},
    ),
    "E": Habit(
        nominal_share=0.70,
        load_power=-0.55,
        centre_weight=0.4,
        ridge=1.5,
        start={"PCY1": 1.37, "PEY1": -0.5},
        frozen={**_RARELY_FITTED, "QBZ3": 0.0, "QEZ2": 0.0},
        sometimes_frozen={"PVY2": (0.15, 0.0)},
    ),
    "F": Habit(
        nominal_fixed=6000.0,
        load_power=-0.3,
        ridge=2.2,
        start={"PCY1": 1.34},
        bounds={"PEY1": (-3.0, 0.8)},
        frozen={**_RARELY_FITTED, "PEX3": 0.0, "PHX2": 0.0, "PVX2": 0.0},
        sometimes_frozen={"PHY2": (0.3, 0.0), "PVY2": (0.3, 0.0)},
    ),
}
_TINY_LIKE = {"G": "A", "H": "B", "I": "C", "J": "D", "K": "F"}


def habit_of(category: str) -> Habit:
    """Fitting habit of a category; the tiny ones copy a large one's."""
    return HABITS[_TINY_LIKE.get(category, category)]


def nominal_loads(habit: Habit, rated_load: np.ndarray) -> np.ndarray:
    """F_z0 that a manufacturer chooses.

    Parameters
    ----------
    habit : Habit
    rated_load : ndarray, shape (n,)
        N.

    Returns
    -------
    ndarray, shape (n,)
    """
    if habit.nominal_fixed is not None:
        return np.full(rated_load.shape, habit.nominal_fixed)
    return np.round(habit.nominal_share * rated_load / 50.0) * 50.0


@dataclass(frozen=True)
class Setup:
    """Start, spread, bounds of one output's coefficients; arrays of shape (n, p)."""

    start: np.ndarray
    stiffness: np.ndarray
    lower: np.ndarray
    upper: np.ndarray


def fit_setup(names: list[str], habit: Habit, freeze_draw: np.ndarray) -> Setup:
    """Set up the fit of one output for n measurements.

    Parameters
    ----------
    names : list of str
        :data:`.formula.FITTED_LATERAL`, :data:`.formula.FITTED_LONGITUDINAL` or
        :data:`.formula.FITTED_ALIGNING`.
    habit : Habit
    freeze_draw : ndarray, shape (n,)
        Uniform in [0, 1), one a physical tire: decides what is frozen in its project.

    Returns
    -------
    Setup
    """
    table = {**_LATERAL_TABLE, **_LONGITUDINAL_TABLE, **_ALIGNING_TABLE}
    rows = np.array([table[name] for name in names])
    count = freeze_draw.size
    start, spread, lower, upper = (np.tile(rows[:, k], (count, 1)) for k in range(4))
    for k, name in enumerate(names):
        if name in habit.start:
            start[:, k] = habit.start[name]
        if name in habit.bounds:
            lower[:, k], upper[:, k] = habit.bounds[name]
        if name in habit.frozen:
            start[:, k] = lower[:, k] = upper[:, k] = habit.frozen[name]
        if name in habit.sometimes_frozen:
            share, value = habit.sometimes_frozen[name]
            # another part of the draw for each coefficient, so that they freeze independently
            frozen = (freeze_draw * (7.0 + 4.0 * k)) % 1.0 < share
            for array in (start, lower, upper):
                array[frozen, k] = value
    return Setup(start, habit.ridge / spread**2, lower, upper)


__all__ = [
    "FITTED_ALIGNING",
    "FITTED_LATERAL",
    "FITTED_LONGITUDINAL",
    "HABITS",
    "Habit",
    "Setup",
    "fit_setup",
    "habit_of",
    "nominal_loads",
]
