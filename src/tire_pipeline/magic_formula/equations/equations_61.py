"""Magic Formula 6.1 and 6.2: Pacejka, Tire and Vehicle Dynamics, 3rd edition, section 4.3.2, (4.E1) to
(4.E78).

Angles enter as they are (alpha* = alpha, gamma* = gamma), as MF-Tyre does. Where MF-Tyre and the book
differ, the equations follow MF-Tyre; docs/explanation/magic_formula.md lists every such place.
"""

from __future__ import annotations

from collections import namedtuple

from tire_pipeline.magic_formula.equations.jit import jitable
from tire_pipeline.magic_formula.equations.ops import (
    absolute,
    arctan,
    cos,
    exp,
    maximum,
    minimum,
    power,
    select,
    sin,
)
from tire_pipeline.magic_formula.equations.shapes import (
    cos_arctan,
    cosine_curve,
    divide,
    equivalent_slip,
    sign,
    sine_curve,
    trail_curvature_factor,
    trail_slip,
    trail_stiffness_factor,
    weight,
)

Zetas = namedtuple("Zetas", ["z0", "z1", "z2", "z3", "z4", "z5", "z6", "z7", "z8"])
Zetas.__doc__ = "The nine reduction factors of turn slip (4.76 to 4.105)."

NO_TURN_SLIP = Zetas(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0)


@jitable
def pure_longitudinal(p, kappa, gamma, fz, dfz, dpi, z):
    """Return Fx0, mu_x, K_xk (4.E9 to 4.E18)."""
    kx = (
        fz
        * (p.PKX1 + p.PKX2 * dfz)
        * exp(minimum(maximum(p.PKX3 * dfz, -700.0), 100.0))
        * (1.0 + p.PPX1 * dpi + p.PPX2 * dpi * dpi)
        * p.LKX
    )
    mux = (
        (p.PDX1 + p.PDX2 * dfz)
        * (1.0 + p.PPX3 * dpi + p.PPX4 * dpi * dpi)
        * (1.0 - p.PDX3 * gamma * gamma)
        * p.LMUX
    )
    kappa_x = kappa + (p.PHX1 + p.PHX2 * dfz) * p.LHX
    svx = fz * (p.PVX1 + p.PVX2 * dfz) * p.LVX * p.LMUX * z.z1
    cx = p.PCX1 * p.LCX
    dx = mux * fz * z.z1
    ex = (p.PEX1 + p.PEX2 * dfz + p.PEX3 * dfz * dfz) * (1.0 - p.PEX4 * sign(kappa_x)) * p.LEX
    bx = divide(kx, cx * dx)
    return sine_curve(bx, cx, dx, minimum(ex, 1.0), kappa_x) + svx, mux, kx


@jitable
def cornering_stiffness(p, gamma, fz, dpi, fz0, z3):
    """Return K_ya (4.E25)."""
    shape = divide(fz / fz0, (p.PKY2 + p.PKY5 * gamma * gamma) * (1.0 + p.PPY2 * dpi))
    return (
        p.PKY1
        * fz0
        * (1.0 + p.PPY1 * dpi)
        * (1.0 - p.PKY3 * absolute(gamma))
        * sin(p.PKY4 * arctan(shape))
        * z3
        * p.LKY
    )


@jitable
def camber_stiffness(p, fz, dfz, dpi):
    """Return K_yg0 (4.E30)."""
    return fz * (p.PKY6 + p.PKY7 * dfz) * (1.0 + p.PPY5 * dpi) * p.LKYC


@jitable
def camber_shift(p, gamma, fz, dfz, z2):
    """Return S_Vyg (4.E28)."""
    return fz * (p.PVY3 + p.PVY4 * dfz) * gamma * p.LKYC * p.LMUY * z2


@jitable
def lateral_friction(p, gamma, dfz, dpi):
    """Return mu_y (4.E23)."""
    return (
        (p.PDY1 + p.PDY2 * dfz)
        * (1.0 + p.PPY3 * dpi + p.PPY4 * dpi * dpi)
        * (1.0 - p.PDY3 * gamma * gamma)
        * p.LMUY
    )


@jitable
def pure_lateral(p, alpha, gamma, fz, dfz, dpi, fz0, z):
    """Return Fy0, mu_y, K_ya, S_Hy, S_Vy, B_y C_y (4.E19 to 4.E30).

    ``PHY3``, the camber shift of 5.2 (A.25), is an extension: no 6.1 file has it but a converted one.
    """
    ky = cornering_stiffness(p, gamma, fz, dpi, fz0, z.z3)
    svyg = camber_shift(p, gamma, fz, dfz, z.z2)
    muy = lateral_friction(p, gamma, dfz, dpi)
    by_camber = divide(camber_stiffness(p, fz, dfz, dpi) * gamma - svyg, ky)
    shy = (p.PHY1 + p.PHY2 * dfz) * p.LHY + p.PHY3 * gamma + by_camber * z.z0 + z.z4 - 1.0
    svy = fz * (p.PVY1 + p.PVY2 * dfz) * p.LVY * p.LMUY * z.z2 + svyg
    alpha_y = alpha + shy
    cy = p.PCY1 * p.LCY
    dy = muy * fz * z.z2
    ey = (
        (p.PEY1 + p.PEY2 * dfz)
        * (1.0 + p.PEY5 * gamma * gamma - (p.PEY3 + p.PEY4 * gamma) * sign(alpha_y))
        * p.LEY
    )
    by = divide(ky, cy * dy)
    fy0 = sine_curve(by, cy, dy, minimum(ey, 1.0), alpha_y) + svy
    return fy0, muy, ky, shy, svy, by * cy


@jitable
def longitudinal_weight(p, alpha, kappa, gamma, dfz):
    """Return G_xa (4.E51 to 4.E57)."""
    bxa = (p.RBX1 + p.RBX3 * gamma * gamma) * cos_arctan(p.RBX2 * kappa) * p.LXAL
    return weight(bxa, p.RCX1, minimum(p.REX1 + p.REX2 * dfz, 1.0), alpha, p.RHX1)


@jitable
def lateral_weight(p, alpha, kappa, gamma, dfz):
    """Return G_yk (4.E59 to 4.E65)."""
    byk = (p.RBY1 + p.RBY4 * gamma * gamma) * cos_arctan(p.RBY2 * (alpha - p.RBY3)) * p.LYKA
    eyk = minimum(p.REY1 + p.REY2 * dfz, 1.0)
    return weight(byk, p.RCY1, eyk, kappa, p.RHY1 + p.RHY2 * dfz)


@jitable
def slip_ratio_side_force(p, muy, alpha, kappa, gamma, fz, dfz, z2):
    """Return S_Vyk (4.E66, 4.E67)."""
    dvyk = muy * fz * (p.RVY1 + p.RVY2 * dfz + p.RVY3 * gamma) * cos_arctan(p.RVY4 * alpha) * z2
    return dvyk * sin(p.RVY5 * arctan(p.RVY6 * kappa)) * p.LVYKA


@jitable
def pneumatic_trail(p, alpha, ratio, kappa, gamma, fz, dfz, dpi, direction, z):
    """Return the trail t (4.E34, 4.E35, 4.E40 to 4.E44, 4.E73, 4.E77), camber terms as in MF-Tyre."""
    alpha_t = trail_slip(p, alpha, gamma, dfz)
    bt = trail_stiffness_factor(p, gamma, dfz)
    dt = (
        fz
        * (p.UNLOADED_RADIUS / p.FNOMIN)
        * (p.QDZ1 + p.QDZ2 * dfz)
        * (1.0 - p.PPZ1 * dpi)
        * (1.0 + p.QDZ3 * gamma + p.QDZ4 * gamma * gamma)
        * p.LTR
        * direction
        * z.z5
    )
    et = trail_curvature_factor(p, bt, alpha_t, gamma, dfz)
    alpha_eq = equivalent_slip(alpha_t, ratio, kappa)
    return dt * cosine_curve(bt, p.QCZ1, minimum(et, 1.0), alpha_eq) * cos(alpha)


@jitable
def residual_torque(p, alpha, alpha_r, ratio, kappa, gamma, fz, dfz, dpi, by_cy, direction, z):
    """Return Mzr (4.E45 to 4.E47, 4.E75, 4.E78)."""
    br = (p.QBZ9 * p.LKY / p.LMUY + p.QBZ10 * by_cy) * z.z6
    by_camber = (p.QDZ8 + p.QDZ9 * dfz) * (1.0 + p.PPZ2 * dpi) + (p.QDZ10 + p.QDZ11 * dfz) * absolute(gamma)
    dr = (
        fz
        * p.UNLOADED_RADIUS
        * ((p.QDZ6 + p.QDZ7 * dfz) * p.LRES * z.z2 + by_camber * gamma * p.LKZC * z.z0)
        * p.LMUY
        * direction
        + z.z8
        - 1.0
    )
    return dr * cos(z.z7 * arctan(br * equivalent_slip(alpha_r, ratio, kappa))) * cos(alpha)


@jitable
def overturning(p, fy, gamma, fz, dpi):
    """Return Mx (Besselink, Schmeitz and Pacejka, draft of the MF 6.1 paper, equation 49)."""
    load = fz / p.FNOMIN
    force = fy / p.FNOMIN
    bulge = p.QSX6 * load
    inner = (
        p.QSX1 * p.LVMX
        - p.QSX2 * gamma * (1.0 + p.PPMX1 * dpi)
        - p.QSX12 * gamma * absolute(gamma)
        + p.QSX3 * force
        + p.QSX4 * cos(p.QSX5 * arctan(bulge * bulge)) * sin(p.QSX7 * gamma + p.QSX8 * arctan(p.QSX9 * force))
        + p.QSX10 * arctan(p.QSX11 * load) * gamma
    )
    return p.UNLOADED_RADIUS * p.LMX * (fz * inner + fy * (p.QSX13 + p.QSX14 * absolute(gamma)))


@jitable
def rolling_load_factor(p, fz, dpi):
    """Return (Fz / Fz0)^QSY7 (p / p0)^QSY8, the last factor of the rolling resistance."""
    pressure = maximum(1.0 + dpi, 1e-6)
    return power(fz / p.FNOMIN, p.QSY7) * power(pressure, p.QSY8)


@jitable
def rolling_resistance(p, fx, gamma, fz, speed, by_load):
    """Return My (Besselink, Schmeitz and Pacejka, equation A48: (4.E70) with the sign of the W axes)."""
    v = speed / p.LONGVL
    v2 = v * v
    load = fz / p.FNOMIN
    by_state = (
        p.QSY1
        + p.QSY2 * fx / p.FNOMIN
        + p.QSY3 * absolute(v)
        + p.QSY4 * v2 * v2
        + (p.QSY5 + p.QSY6 * load) * gamma * gamma
    )
    return -p.UNLOADED_RADIUS * p.FNOMIN * by_state * by_load * p.LMY * sign(speed)


@jitable
def relaxation(p, kx, ky, gamma, fz, dfz, dpi, fz0):
    """Return the relaxation lengths K / C (paper, equations 17 to 19), or by PTX, PTY where C is missing."""
    cx = p.LONGITUDINAL_STIFFNESS * (1.0 + p.PCFX1 * dfz + p.PCFX2 * dfz * dfz) * (1.0 + p.PCFX3 * dpi)
    cy = p.LATERAL_STIFFNESS * (1.0 + p.PCFY1 * dfz + p.PCFY2 * dfz * dfz) * (1.0 + p.PCFY3 * dpi)
    x = divide(fz, p.PTY2 * fz0)
    by_pty = p.PTY1 * 2.0 * x / (1.0 + x * x) * (1.0 - p.PKY3 * absolute(gamma)) * p.LFZO * p.LSGAL
    by_ptx = (
        (p.PTX1 + p.PTX2 * dfz)
        * exp(minimum(maximum(-p.PTX3 * dfz, -700.0), 100.0))
        * p.LSGKP
        * fz
        / p.FNOMIN
    )
    lateral = select(cy == 0.0, by_pty * p.UNLOADED_RADIUS, absolute(divide(ky, cy)))
    longitudinal = select(cx == 0.0, by_ptx * p.UNLOADED_RADIUS, absolute(divide(kx, cx)))
    return lateral, longitudinal


@jitable
def evaluate_61(p, alpha, kappa, gamma, fz, speed, dpi, by_load, z):
    """Return the twelve outputs at points with a positive load.

    Parameters
    ----------
    p : Coefficients
    alpha, kappa, gamma, fz, speed : float or ndarray
        Slip angle (rad), slip ratio, camber (rad), load (N, positive), speed (m/s); ISO W axes.
    dpi : float or ndarray
        Relative change of pressure (4.E2b).
    by_load : float or ndarray
        What :func:`rolling_load_factor` returns.
    z : Zetas
        Turn slip factors; ``NO_TURN_SLIP`` without it.

    Returns
    -------
    tuple
        fx, fy, mx, my, mz, trail, mu_x, mu_y, K_y, K_x, lateral and longitudinal relaxation length.
    """
    fz0 = p.FNOMIN * p.LFZO
    dfz = (fz - fz0) / fz0
    direction = select(speed < 0.0, -1.0, 1.0)
    fx0, mux, kx = pure_longitudinal(p, kappa, gamma, fz, dfz, dpi, z)
    fy0, muy, ky, shy, svy, by_cy = pure_lateral(p, alpha, gamma, fz, dfz, dpi, fz0, z)
    fx = fx0 * longitudinal_weight(p, alpha, kappa, gamma, dfz)
    gyk = lateral_weight(p, alpha, kappa, gamma, dfz)
    fy = fy0 * gyk + slip_ratio_side_force(p, muy, alpha, kappa, gamma, fz, dfz, z.z2)

    ratio = divide(kx, ky)
    trail = pneumatic_trail(p, alpha, ratio, kappa, gamma, fz, dfz, dpi, direction, z)
    alpha_r = alpha + shy + divide(svy, ky)
    mzr = residual_torque(p, alpha, alpha_r, ratio, kappa, gamma, fz, dfz, dpi, by_cy, direction, z)
    fy0_upright = pure_lateral(p, alpha, 0.0 * gamma, fz, dfz, dpi, fz0, NO_TURN_SLIP)[0]
    arm = (p.SSZ1 + p.SSZ2 * fy / p.FNOMIN + (p.SSZ3 + p.SSZ4 * dfz) * gamma) * p.UNLOADED_RADIUS * p.LS
    # QYZ1 is an extension: 1 in a model converted from 5.2, whose F'y keeps its camber (A.65)
    fy_prime = gyk * (fy0_upright + p.QYZ1 * (fy0 - fy0_upright))
    mz = -trail * fy_prime + mzr + arm * fx

    mx = overturning(p, fy, gamma, fz, dpi)
    my = rolling_resistance(p, fx, gamma, fz, speed, by_load)
    lateral, longitudinal = relaxation(p, kx, ky, gamma, fz, dfz, dpi, fz0)
    return fx, fy, mx, my, mz, trail, mux, muy, ky, kx, lateral, longitudinal
