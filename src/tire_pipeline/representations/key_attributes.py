"""Cornering stiffness, peak force and slip angle at the peak, at three loads (thesis, 4.2.2)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd

from tire_pipeline.magic_formula.equations.shapes import sine_curve
from tire_pipeline.representations.base import CURVE_LOADS, CURVE_SLIP_ANGLES
from tire_pipeline.representations.curve_fit import fit_lateral
from tire_pipeline.representations.lateral_curve import lateral_factors, lateral_force

PEAK_SLIP_ANGLES = np.linspace(0.0, 0.25, 501)
"""Where the peak is looked for, rad: the positive half of the thesis' force curves."""

_SLIP_AT_ZERO = 1e-4
_MOST_SHAPE = 50.0


class KeyAttributes:
    """Nine features: cornering stiffness, peak force, slip angle at the peak at 4, 6 and 8 kN.

    The peak is that of the positive slip angles up to 0.25 rad, as a positive force; the
    stiffness keeps its sign (files in ISO W axes have a negative one). Decoding is Appendix D.
    """

    name: ClassVar[str] = "key_attributes"

    @property
    def feature_names(self) -> tuple[str, ...]:
        """Attribute and load, by attribute first."""
        attributes = ("cornering_stiffness", "peak_force", "peak_slip_angle")
        return tuple(f"{a}_{load:.0f}" for a in attributes for load in CURVE_LOADS)

    def fit(self, table: pd.DataFrame, *, seed: int = 0) -> Self:
        """Learn nothing."""
        return self

    def encode(self, table: pd.DataFrame) -> np.ndarray:
        """Return the attributes, shape (n, 9): N/rad, N, rad."""
        factors = lateral_factors(table, CURVE_LOADS)
        near = lateral_force(factors, np.array([-_SLIP_AT_ZERO, _SLIP_AT_ZERO]))
        stiffness = (near[..., 1] - near[..., 0]) / (2 * _SLIP_AT_ZERO)
        curve = lateral_force(factors, PEAK_SLIP_ANGLES) * np.sign(stiffness)[..., None]
        top = curve.argmax(axis=-1)
        peak, slip = _parabola_top(curve, top)
        return np.concatenate([stiffness, peak, slip], axis=1)

    def decode_curves(self, features: np.ndarray, source: pd.DataFrame) -> np.ndarray:
        """Return the curves of Appendix D, N, shape (n, 3, 100)."""
        stiffness, peak, slip = np.split(np.asarray(features, dtype=float), 3, axis=1)
        shape, factor = shape_and_stiffness_factor(stiffness, peak, slip)
        b, c, d = (each[..., None] for each in (factor, shape, peak))
        return np.asarray(sine_curve(b, c, d, 0.0, CURVE_SLIP_ANGLES))

    def decode(self, features: np.ndarray, source: pd.DataFrame) -> pd.DataFrame:
        """Return the source tires, fitted to the curves of Appendix D."""
        curves = self.decode_curves(features, source)
        return fit_lateral(curves, source, CURVE_LOADS, CURVE_SLIP_ANGLES)

    def is_real(self, features: np.ndarray) -> np.ndarray:
        """Every set of attributes has a curve (see :func:`shape_and_stiffness_factor`)."""
        return np.ones(len(features), dtype=bool)

    def to_state(self) -> dict[str, Any]:
        """Return the name; nothing is learnt."""
        return {"representation": self.name}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls()


def shape_and_stiffness_factor(
    stiffness: np.ndarray, peak: np.ndarray, slip: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Solve Appendix D for C and B with E = 0 and D = peak.

    C arctan(K x / (C D)) = pi / 2 grows with C towards K x / D: it has a solution only where
    K x / D > pi / 2. Elsewhere the straight line through the origin reaches the peak's height
    too late for any C; the largest C that is tried, 50, comes closest and is given.

    Parameters
    ----------
    stiffness, peak, slip : ndarray
        Cornering stiffness, N/rad (any sign), peak force, N, and its slip angle, rad, both > 0.

    Returns
    -------
    shape, factor : ndarray
        C, and B in 1/rad with the sign of the stiffness.
    """
    reach = np.abs(stiffness) * slip / peak
    low = np.full_like(reach, 1e-3)
    high = np.full_like(reach, _MOST_SHAPE)
    for _ in range(60):
        middle = (low + high) / 2
        short = middle * np.arctan(reach / middle) < np.pi / 2
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    shape = (low + high) / 2
    return shape, stiffness / (shape * peak)


def _parabola_top(curve: np.ndarray, top: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Refine the highest grid point by the parabola through it and its neighbours.

    At an end of the range it is the one through the last three points; a peak beyond them is none.
    """
    last = curve.shape[-1] - 1
    middle = top.clip(1, last - 1)
    before, here, after = (
        np.take_along_axis(curve, (middle + shift)[..., None], axis=-1)[..., 0] for shift in (-1, 0, 1)
    )
    bend = before - 2 * here + after
    shift = np.where(bend < 0, 0.5 * (before - after) / np.where(bend < 0, bend, 1.0), np.inf)
    inside = np.abs(shift) < 1.0
    shift = np.where(inside, shift, 0.0)
    height = np.where(inside, here - 0.25 * (before - after) * shift, curve.max(axis=-1))
    width = PEAK_SLIP_ANGLES[1] - PEAK_SLIP_ANGLES[0]
    return height, PEAK_SLIP_ANGLES[np.where(inside, middle, top)] + shift * width
