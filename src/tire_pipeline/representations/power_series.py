"""The Magic Formula as a power series: k1, k2, k3 and D at three loads (thesis, 4.2.4, App. C).

Two forms share the code. ``published`` is Appendix C as printed: features k1, k2, k3, D, the root of
C with the plus sign. ``stable``, the default, uses k1, r2 = k2/k1^3, r3 = k3/k1^5, D, in which B has
dropped out of r2 and r3. With y = 1/C^2 and s = 1 + r2 the published equation for C becomes

    40 y^2 + 32 s y + (r3 + 10 s - 1) = 0,

whose roots are the tire's own y and y (128 E + 48) / 80. They meet at E = 1/4, and the second one
goes through zero (C infinite) at E = -3/8. The printed plus sign in front of the inner root takes the
greater C^2: the right one for E > 1/4 and E < -3/8, the wrong one between, and the wrong one is the
further off the nearer E is to -3/8. The stable form takes the root nearest to the source tire's C.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula.equations.shapes import sine_curve
from tire_pipeline.representations.base import CURVE_LOADS, CURVE_SLIP_ANGLES
from tire_pipeline.representations.curve_fit import fit_lateral
from tire_pipeline.representations.lateral_curve import (
    LateralFactors,
    lateral_factors,
    lateral_force,
)

FORMS = ("stable", "published")
_N_LOADS = len(CURVE_LOADS)
_LEAST_S, _MOST_S = 1e-2, 60.0  # -s between these: C between 16 and 0.2 where the roots meet


class PowerSeries:
    """Twelve features: three derivatives of the normalised curve at the origin and D, at 3 loads.

    Parameters
    ----------
    form : {"stable", "published"}
        Which features, and how they are decoded (see the module).
    """

    name: ClassVar[str] = "power_series"

    def __init__(self, form: str = "stable") -> None:
        if form not in FORMS:
            raise DomainError(f"there is no form {form!r}", todo=f"choose one of {FORMS}")
        self.form = form
        self.spread = np.ones((2, _N_LOADS))

    @property
    def feature_names(self) -> tuple[str, ...]:
        """Feature and load, by feature first."""
        names = ("k1", "k2", "k3", "D") if self.form == "published" else ("k1", "r2", "r3", "D")
        return tuple(f"{name}_{load:.0f}" for name in names for load in CURVE_LOADS)

    def fit(self, table: pd.DataFrame, *, seed: int = 0) -> Self:
        """Learn the spread of r2 and r3, by which "nearest" is measured."""
        if self.form == "stable":
            _, r2, r3, _ = np.split(self.encode(table), 4, axis=1)
            self.spread = np.maximum(np.stack([r2.std(axis=0), r3.std(axis=0)]), 1e-12)
        return self

    def encode(self, table: pd.DataFrame) -> np.ndarray:
        """Return the features, shape (n, 12)."""
        factors = lateral_factors(table, CURVE_LOADS)
        curvature = np.minimum(factors.curvature, 1.0)
        k1, k2, k3 = derivatives(factors.stiffness, factors.shape, curvature)
        if self.form == "stable":
            k2, k3 = k2 / k1**3, k3 / k1**5
        return np.concatenate([k1, k2, k3, factors.peak], axis=1)

    def decode_curves(self, features: np.ndarray, source: pd.DataFrame) -> np.ndarray:
        """Return the curves, N, shape (n, 3, 100), without shifts, as Appendix C has none.

        An imaginary solution gives NaN in the published form; the stable one has none.
        """
        factor, shape, curvature, peak = self._solve(features, source)
        b, c, d, e = (each[..., None] for each in (factor, shape, peak, curvature))
        return np.asarray(sine_curve(b, c, d, e, CURVE_SLIP_ANGLES))

    def decode(self, features: np.ndarray, source: pd.DataFrame) -> pd.DataFrame:
        """Return the source tires with coefficients fitted to the decoded curves.

        The published form fits the bare curves; the stable one adds the source's shifts and
        one-sided curvature, which no feature describes. A tire with an imaginary published
        solution comes back as it was.
        """
        if self.form == "published":
            curves = self.decode_curves(features, source)
        else:
            factor, shape, curvature, peak = self._solve(features, source)
            own = lateral_factors(source, CURVE_LOADS)
            changed = LateralFactors(
                stiffness=factor,
                shape=shape,
                peak=peak,
                curvature=curvature,
                e_side=own.e_side,
                horizontal_shift=own.horizontal_shift,
                vertical_shift=own.vertical_shift,
            )
            curves = lateral_force(changed, CURVE_SLIP_ANGLES)
        return fit_lateral(curves, source, CURVE_LOADS, CURVE_SLIP_ANGLES)

    def is_real(self, features: np.ndarray) -> np.ndarray:
        """Tell which rows have a real, positive C at all three loads, shape (n,)."""
        _, r2, r3, _ = self._ratios(features)
        return np.isfinite(_inverse_square_shapes(r2, r3)).any(axis=0).all(axis=1)

    def to_state(self) -> dict[str, Any]:
        """Return the form and the spread."""
        return {"representation": self.name, "form": self.form, "spread": self.spread}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        back = cls(form=str(state["form"]))
        back.spread = np.asarray(state["spread"], dtype=float)
        return back

    def _ratios(self, features: np.ndarray) -> tuple[np.ndarray, ...]:
        k1, second, third, peak = np.split(np.asarray(features, dtype=float), 4, axis=1)
        if self.form == "published":
            second, third = second / k1**3, third / k1**5
        return k1, second, third, peak

    def _solve(self, features: np.ndarray, source: pd.DataFrame) -> tuple[np.ndarray, ...]:
        k1, r2, r3, peak = self._ratios(features)
        if self.form == "published":
            # plus sign of the inner root = the greater C^2 = the smaller positive 1/C^2
            smaller, greater = _inverse_square_shapes(r2, r3)
            inverse_square = np.where(np.isnan(smaller), greater, smaller)
        else:
            own = lateral_factors(source, CURVE_LOADS).shape
            r2, r3 = nearest_real(r2, r3, self.spread)
            both = _inverse_square_shapes(r2, r3)
            away = np.abs(both**-0.5 - own)
            nearest = np.where(np.isnan(away), np.inf, away).argmin(axis=0)
            inverse_square = np.take_along_axis(both, nearest[None], axis=0)[0]
        shape = inverse_square**-0.5
        curvature = -(1 + r2) / (2 * inverse_square) - 1
        return k1 / shape, shape, curvature, peak


def derivatives(
    stiffness: np.ndarray, shape: np.ndarray, curvature: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return k1, k2, k3: first, third and fifth derivative of MF/D at the origin (Appendix C).

    Parameters
    ----------
    stiffness, shape, curvature : ndarray
        B in 1/rad, C and E.
    """
    b, c, e = stiffness, shape, curvature
    k1 = b * c
    k2 = -(b**3) * c * (c**2 + 2 * e + 2)
    k3 = b**5 * c * (c**4 + c**2 * (20 * e + 20) + 64 * e + 24)
    return k1, k2, k3


def _inverse_square_shapes(r2: np.ndarray, r3: np.ndarray) -> np.ndarray:
    """Return both solutions 1/C^2 (smaller first), NaN where imaginary, shape (2, ...)."""
    s = 1 + r2
    inner = 1024 * s**2 - 160 * (r3 + 10 * s - 1)
    # a little below zero is the double root seen through rounding
    rounding = 1e-9 * (1024 * s**2 + np.abs(160 * (r3 + 10 * s - 1)))
    root = np.sqrt(np.where(inner < -rounding, np.nan, np.maximum(inner, 0.0)))
    both = np.stack([-32 * s - root, -32 * s + root]) / 80
    return np.where(both > 1e-9, both, np.nan)


def nearest_real(r2: np.ndarray, r3: np.ndarray, spread: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Move imaginary solutions to the nearest point where both roots meet (E = 1/4).

    Parameters
    ----------
    r2, r3 : ndarray, shape (n, L)
    spread : ndarray, shape (2, L)
        Units of r2 and r3 in which distance is measured.

    Returns
    -------
    r2, r3 : ndarray
        As given where there is a real C; elsewhere on the curve r3 = 1 - 10 s + 6.4 s^2, s < 0.
    """
    wrong = np.isnan(_inverse_square_shapes(r2, r3)).all(axis=0)
    if not wrong.any():
        return r2, r3
    unit2, unit3 = (np.broadcast_to(unit, r2.shape)[wrong][:, None] for unit in spread)
    want2, want3 = r2[wrong][:, None], r3[wrong][:, None]
    low = np.full(len(want2), np.log(_LEAST_S))
    high = np.full(len(want2), np.log(_MOST_S))
    for _ in range(6):
        logs = np.linspace(low, high, 101, axis=1)
        s = -np.exp(logs)
        boundary = 1 - 10 * s + 6.4 * s**2
        distance = ((s - 1 - want2) / unit2) ** 2 + ((boundary - want3) / unit3) ** 2
        best = np.take_along_axis(logs, distance.argmin(axis=1)[:, None], axis=1)[:, 0]
        width = (high - low) / 50
        low = np.maximum(best - width, np.log(_LEAST_S))
        high = np.minimum(best + width, np.log(_MOST_S))
    best = -np.exp(best)
    r2, r3 = r2.copy(), r3.copy()
    r2[wrong], r3[wrong] = best - 1, 1 - 10 * best + 6.4 * best**2
    return r2, r3
