"""Typical tires: a fit stays near them in the directions that its rows leave open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

FEW_POINTS = 2
"""Points a coefficient below which the least misfit says nothing, as the curve runs through the noise."""

FORMULA_ERROR = 0.01
"""How far a Magic Formula is off a real tire, over the largest force: what one of few points can say."""

SPREAD: dict[str, float] = {
    "PCY1": 0.2,
    "PDY1": 0.3,
    "PDY2": 0.1,
    "PDY3": 4.0,
    "PEY1": 0.5,
    "PEY2": 0.5,
    "PEY3": 0.3,
    "PEY4": 40.0,
    "PEY5": 30.0,
    "PKY1": 15.0,
    "PKY2": 1.0,
    "PKY3": 0.5,
    "PKY4": 0.35,
    "PKY5": 25.0,
    "PKY6": 0.5,
    "PKY7": 0.2,
    "PHY1": 0.003,
    "PHY2": 0.003,
    "PHY3": 0.04,
    "PVY1": 0.02,
    "PVY2": 0.02,
    "PVY3": 0.3,
    "PVY4": 0.2,
    "PPY1": 0.4,
    "PPY2": 0.5,
    "PPY3": 0.1,
    "PPY4": 0.1,
    "PPY5": 0.4,
    "PCX1": 0.2,
    "PDX1": 0.3,
    "PDX2": 0.1,
    "PDX3": 4.0,
    "PEX1": 1.5,
    "PEX2": 1.5,
    "PEX3": 0.3,
    "PEX4": 0.3,
    "PKX1": 9.0,
    "PKX2": 8.0,
    "PKX3": 0.3,
    "PHX1": 0.001,
    "PHX2": 0.001,
    "PVX1": 0.03,
    "PVX2": 0.01,
    "PPX1": 0.4,
    "PPX2": 0.3,
    "PPX3": 0.05,
    "PPX4": 0.25,
    "QBZ1": 4.0,
    "QBZ2": 3.0,
    "QBZ3": 3.0,
    "QBZ4": 1.0,
    "QBZ5": 1.5,
    "QBZ9": 60.0,
    "QCZ1": 0.2,
    "QDZ1": 0.02,
    "QDZ2": 0.012,
    "QDZ3": 0.8,
    "QDZ4": 9.0,
    "QDZ6": 0.004,
    "QDZ7": 0.004,
    "QDZ8": 0.2,
    "QDZ9": 0.17,
    "QDZ10": 0.5,
    "QDZ11": 2.0,
    "QEZ1": 3.0,
    "QEZ2": 3.5,
    "QEZ3": 2.5,
    "QEZ4": 1.4,
    "QEZ5": 200.0,
    "QHZ1": 0.005,
    "QHZ2": 0.005,
    "QHZ3": 0.15,
    "QHZ4": 0.2,
    "PPZ1": 0.5,
    "PPZ2": 0.25,
    "RBX1": 6.0,
    "RBX2": 12.0,
    "RBX3": 300.0,
    "RCX1": 0.06,
    "REX1": 1.2,
    "REX2": 0.2,
    "RHX1": 0.004,
    "RBY1": 10.0,
    "RBY2": 11.0,
    "RBY3": 0.03,
    "RBY4": 800.0,
    "RCY1": 0.3,
    "REY1": 0.3,
    "REY2": 0.1,
    "RHY1": 0.015,
    "RHY2": 0.003,
    "RVY1": 0.08,
    "RVY2": 0.04,
    "RVY3": 9.0,
    "RVY4": 44.0,
    "RVY5": 1.4,
    "RVY6": 12.0,
    "SSZ1": 0.02,
    "SSZ2": 0.025,
    "SSZ3": 0.85,
    "SSZ4": 0.4,
    "QSX1": 0.002,
    "QSX2": 4.0,
    "QSX3": 0.5,
    "QSX4": 5.0,
    "QSX5": 0.4,
    "QSX6": 7.0,
    "QSX7": 0.55,
    "QSX8": 2.2,
    "QSX9": 0.25,
    "QSX10": 0.35,
    "QSX11": 2.0,
    "PPMX1": 0.015,
    "QSY1": 0.005,
    "QSY3": 0.0005,
    "QSY4": 0.00003,
    "QSY7": 0.5,
    "QSY8": 0.6,
}
"""Coefficient -> how much tires differ in it: half of the range of the middle four fifths of 16 public files
of cars and trucks, or their standard deviation, within a factor of two (`benchmarks/few_points.py` prints
both). Of the others, no file has a value but 0."""

_OTHER_SPREADS = 0.05
"""The spread of a coefficient that no file has, over the range of its bounds."""


@dataclass(frozen=True)
class Pull:
    """Rows that pull coefficients towards typical tires.

    Parameters
    ----------
    centre : ndarray, shape (m,)
        Where to.
    spread : ndarray, shape (m,)
        How much tires differ.
    strength : ndarray, shape (m,)
        Force of one row, a unit of the spread away.
    """

    centre: np.ndarray
    spread: np.ndarray
    strength: np.ndarray

    def residuals(self, values: np.ndarray) -> np.ndarray:
        """Return one row a coefficient, in the unit of the force."""
        return self.strength * (values - self.centre) / self.spread

    def jacobian(self) -> np.ndarray:
        """Return their derivatives, shape (m, m)."""
        return np.diag(self.strength / self.spread)

    def times(self, strength: float | np.ndarray) -> Pull:
        """Return the pull with another strength, one for all or one a coefficient."""
        return Pull(self.centre, self.spread, np.broadcast_to(strength, self.centre.shape))


def pull(names: Sequence[str], typical: Mapping[str, float], bounds: tuple[np.ndarray, np.ndarray]) -> Pull:
    """Return the pull on a stage's coefficients, with no strength yet.

    Parameters
    ----------
    names : sequence of str
    typical : mapping of str to float
        Where to: the values of tires in general or of the model that the fit starts from.
    bounds : pair of ndarray
    """
    low, high = bounds
    centre = np.array([typical[name] for name in names])
    spread = np.array(
        [SPREAD.get(n, _OTHER_SPREADS * (up - down)) for n, up, down in zip(names, high, low, strict=True)]
    )
    stiff = [i for i, name in enumerate(names) if name in ("PKY1", "PKX1")]
    spread[stiff] = np.maximum(spread[stiff], 0.5 * np.abs(centre[stiff]))
    return Pull(centre, spread, np.zeros(len(names)))
