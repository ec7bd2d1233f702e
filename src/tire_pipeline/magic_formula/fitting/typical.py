"""What tires are like, for fits to few points: a formula with as many coefficients fits nothing else then."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

FEW_POINTS = 5
"""Points a coefficient from which the recording speaks for itself."""

FORMULA_ERROR = 0.01
"""How far a Magic Formula is off a real tire, over the largest force: what a point can say at best."""

SPREAD: dict[str, float] = {
    "PCY1": 0.2,
    "PDY1": 0.3,
    "PDY2": 0.1,
    "PDY3": 4.0,
    "PEY1": 0.5,
    "PEY2": 0.5,
    "PEY3": 0.3,
    "PEY4": 40.0,
    "PKY1": 15.0,
    "PKY2": 1.0,
    "PKY3": 0.5,
    "PHY1": 0.003,
    "PHY2": 0.003,
    "PHY3": 0.04,
    "PVY1": 0.02,
    "PVY2": 0.02,
    "PVY3": 0.3,
    "PVY4": 0.2,
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
}
"""Coefficient -> how much tires differ in it: half of the range of the middle four fifths of 16 public files
of cars and trucks, or their standard deviation, within a factor of two (`benchmarks/few_points.py` prints
both). Others are left to the data."""


@dataclass(frozen=True)
class Pull:
    """Rows that draw coefficients to what tires are like.

    Parameters
    ----------
    which : ndarray of int, shape (m,)
        The stage's coefficients that are drawn.
    centre : ndarray, shape (m,)
        Where to.
    weight : ndarray, shape (m,)
        Force a unit of the coefficient.
    count : int
        Of the stage's coefficients.
    """

    which: np.ndarray
    centre: np.ndarray
    weight: np.ndarray
    count: int

    def residuals(self, values: np.ndarray) -> np.ndarray:
        """Return one row a coefficient that is drawn, in the unit of the force."""
        return self.weight * (values[self.which] - self.centre)

    def jacobian(self) -> np.ndarray:
        """Return their derivatives, shape (m, count)."""
        rows = np.zeros((self.which.size, self.count))
        rows[np.arange(self.which.size), self.which] = self.weight
        return rows


def pull(names: Sequence[str], typical: Mapping[str, float], measured: np.ndarray) -> Pull | None:
    """Return what draws a stage's coefficients, or None where points are many or nothing is known.

    Parameters
    ----------
    names : sequence of str
    typical : mapping of str to float
        Where to: the values of tires in general or of the model that the fit starts from.
    measured : ndarray, shape (n,)
        Force of the stage's points.
    """
    which = [i for i, name in enumerate(names) if name in SPREAD]
    if not which or measured.size >= FEW_POINTS * len(names):
        return None
    error = FORMULA_ERROR * float(np.abs(measured).max())
    known = [names[i] for i in which]
    return Pull(
        np.array(which),
        np.array([typical[name] for name in known]),
        np.array([error / SPREAD[name] for name in known]),
        len(names),
    )
