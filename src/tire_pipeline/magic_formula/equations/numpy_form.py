"""The equations over arrays with NumPy alone: what runs without numba, and what numba is compared with."""

from __future__ import annotations

import numpy as np

from tire_pipeline.channels import FORCE_CHANNELS
from tire_pipeline.magic_formula.equations.equations_52 import evaluate_52
from tire_pipeline.magic_formula.equations.equations_61 import NO_TURN_SLIP, evaluate_61, rolling_load_factor
from tire_pipeline.magic_formula.equations.shapes import clamp
from tire_pipeline.magic_formula.equations.turn_slip import zetas_of
from tire_pipeline.magic_formula.parameters.coefficients import Coefficients

OUTPUTS = (
    *FORCE_CHANNELS,
    "trail",
    "friction_x",
    "friction_y",
    "cornering_stiffness",
    "slip_stiffness",
    "relaxation_lateral",
    "relaxation_longitudinal",
)
"""What the equations return, in order."""

SATURATION = 1e12
"""Inputs beyond this magnitude (rad, N, m/s) are limited to it, so that every intermediate value stays
finite."""


def evaluate(vector, family, alpha, kappa, gamma, fz, speed, pressure, turn_slip=None):
    """Return the outputs, in the order of ``OUTPUTS``, at points of ISO W axes.

    Parameters
    ----------
    vector : ndarray
        Packed coefficients.
    family : {5, 6}
    alpha, kappa, gamma, fz, speed, pressure : ndarray
        Broadcast against each other; rad, rad, N, m/s, Pa.
    turn_slip : ndarray, optional
        Path curvature (1/m), for family 6.

    Returns
    -------
    tuple of ndarray
    """
    with np.errstate(all="ignore"):
        return _evaluate(vector, family, alpha, kappa, gamma, fz, speed, pressure, turn_slip)


def _evaluate(vector, family, alpha, kappa, gamma, fz, speed, pressure, turn_slip):
    p = Coefficients(*vector.tolist())
    alpha, kappa, gamma, speed = (clamp(x, SATURATION) for x in (alpha, kappa, gamma, speed))
    loaded = ~(fz <= 0.0)
    load = np.where(loaded, np.minimum(fz, SATURATION), p.FNOMIN)
    if family == 5:
        raw = evaluate_52(p, alpha, kappa, gamma, load, speed)
    else:
        dpi = relative_pressure(p, pressure)
        zetas = NO_TURN_SLIP
        if turn_slip is not None:
            zetas = zetas_of(p, alpha, kappa, gamma, load, speed, dpi, turn_slip)
        by_load = rolling_load_factor(p, load, dpi)
        raw = evaluate_61(p, alpha, kappa, gamma, load, speed, dpi, by_load, zetas)
    return tuple(np.where(loaded, value, 0.0) for value in raw)


def relative_pressure(p, pressure):
    """Return (pressure - NOMPRES) / NOMPRES (4.E2b), and 0 where there is no nominal pressure."""
    if p.NOMPRES <= 0.0:
        return 0.0 * pressure
    return (clamp(pressure, SATURATION) - p.NOMPRES) / p.NOMPRES
