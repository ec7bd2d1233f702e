"""The reduction factors of turn slip: Pacejka, 3rd edition, (4.76) to (4.105).

Turn slip is the curvature of the wheel's path (1/m), positive for a turn to the left in ISO W axes. The
spin slip is phi = turn_slip - (1 - epsilon_gamma) sin(camber) / Re, with the unloaded radius for the
effective rolling radius Re.
"""

from __future__ import annotations

import numpy as np

from tire_pipeline.magic_formula.equations.equations_61 import (
    Zetas,
    camber_shift,
    camber_stiffness,
    cornering_stiffness,
    lateral_friction,
    lateral_weight,
)
from tire_pipeline.magic_formula.equations.shapes import cos_arctan, divide, sine_curve


def zetas_of(p, alpha, kappa, gamma, fz, speed, dpi, turn_slip):
    """Return the nine factors at points with a positive load.

    Parameters
    ----------
    p : Coefficients
    alpha, kappa, gamma, fz, speed, dpi, turn_slip : ndarray
        ISO W axes; rad, N, m/s, relative pressure change, 1/m.

    Returns
    -------
    Zetas
    """
    r0 = p.UNLOADED_RADIUS
    fz0 = p.FNOMIN * p.LFZO
    dfz = (fz - fz0) / fz0
    direction = np.where(speed < 0.0, -1.0, 1.0)
    epsilon = p.PECP1 * (1.0 + p.PECP2 * dfz)  # (4.90)
    spin = r0 * turn_slip * np.cos(alpha) - (1.0 - epsilon) * np.sin(gamma)  # R0 phi, (4.76)
    turned = np.abs(spin)

    z1 = cos_arctan(p.PDXP1 * (1.0 + p.PDXP2 * dfz) * cos_arctan(p.PDXP3 * kappa) * spin)
    byp = p.PDYP1 * (1.0 + p.PDYP2 * dfz) * cos_arctan(p.PDYP3 * np.tan(alpha))
    z2 = cos_arctan(byp * (turned + p.PDYP4 * np.sqrt(turned)))
    z3 = cos_arctan(p.PKYP1 * spin * spin)
    z5 = cos_arctan(p.QDTP1 * spin)
    z6 = cos_arctan(p.QBRP1 * spin)

    ky = cornering_stiffness(p, gamma, fz, dpi, fz0, z3)
    ky0 = cornering_stiffness(p, 0.0 * gamma, fz, dpi, fz0, z3)
    z4 = (
        1.0
        + _side_shift(p, spin, fz, dfz, dpi, epsilon, ky0, direction)
        - divide(camber_shift(p, gamma, fz, dfz, z2), ky)
    )
    z7, z8 = _torque_factors(p, alpha, kappa, gamma, fz, dfz, dpi, fz0, spin, epsilon)
    return Zetas(0.0, z1, z2, z3, z4, z5, z6, z7, z8)


def _side_shift(p, spin, fz, dfz, dpi, epsilon, ky0, direction):
    """Return S_Hyphi (4.80 to 4.89)."""
    c = p.PHYP1
    d = (p.PHYP2 + p.PHYP3 * dfz) * direction
    e = min(p.PHYP4, 1.0)
    # S_Hyphi replaces the camber term of S_Hy: by (4.76) a spin of -(1 - epsilon) sin(camber) must shift as
    # camber does, hence the sign that the ISO W axes give
    per_spin = -divide(camber_stiffness(p, fz, dfz, dpi), 1.0 - epsilon)
    b = divide(per_spin, c * d * ky0)
    return sine_curve(b, c, d, e, spin) * direction


def _torque_factors(p, alpha, kappa, gamma, fz, dfz, dpi, fz0, spin, epsilon):
    """Return zeta_7 and zeta_8 (4.92 to 4.104)."""
    muy = lateral_friction(p, gamma, dfz, dpi)
    standing = p.QCRP1 * np.abs(muy) * p.UNLOADED_RADIUS * fz * np.sqrt(fz / fz0) * p.LMP  # (4.95)
    standing = np.maximum(standing, 1e-6)
    c = p.QDRP1
    d = divide(standing, np.sin(0.5 * np.pi * c) + 0.0 * standing)  # (4.94)
    by_camber = p.QDZ8 + p.QDZ9 * dfz + (p.QDZ10 + p.QDZ11 * dfz) * np.abs(gamma)
    stiffness = -fz * p.UNLOADED_RADIUS * by_camber * p.LKZC  # (4.99), against spin in ISO W axes
    b = divide(stiffness, c * d * (1.0 - epsilon))
    dr = d * np.sin(c * np.arctan(b * spin))
    gyk = lateral_weight(p, alpha, kappa, gamma, dfz)
    at_90 = standing * (2.0 / np.pi) * np.arctan(p.QCRP2 * np.abs(spin)) * gyk  # (4.103)
    ratio = np.clip(divide(at_90, np.abs(dr)), -1.0, 1.0)
    z7 = (2.0 / np.pi) * np.arccos(ratio)  # (4.104)
    return np.where(dr == 0.0, 1.0, z7), 1.0 + dr
