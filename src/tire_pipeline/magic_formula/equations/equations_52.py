"""Magic Formula 5.2 (and PAC2002, 5.0, 5.1): the thesis' Appendix A, equations (A.1) to (A.72), in order.

Each function works on arrays of operating points or on one of them. Where the printed appendix slips, the
right form stands here and the docstring names the equation; docs/explanation/magic_formula.md lists them all.
"""

from __future__ import annotations

from tire_pipeline.magic_formula.equations.jit import jitable
from tire_pipeline.magic_formula.equations.ops import (
    absolute,
    arctan,
    cos,
    exp,
    maximum,
    minimum,
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


@jitable
def sine_of_twice_arctan(x):
    """Return sin(2 arctan x) = 2 x / (1 + x^2)."""
    return 2.0 * x / (1.0 + x * x)


@jitable
def pure_longitudinal(p, kappa, gamma, fz, dfz):
    """Return Fx0, mu_x, K_x, S_Hx, S_Vx (A.4 to A.14)."""
    gamma_x = gamma * p.LGAX
    kx = fz * (p.PKX1 + p.PKX2 * dfz) * exp(minimum(maximum(p.PKX3 * dfz, -700.0), 100.0)) * p.LKX
    mux = (p.PDX1 + p.PDX2 * dfz) * (1.0 - p.PDX3 * gamma_x * gamma_x) * p.LMUX
    shx = (p.PHX1 + p.PHX2 * dfz) * p.LHX
    svx = fz * (p.PVX1 + p.PVX2 * dfz) * p.LVX * p.LMUX
    kappa_x = kappa + shx
    cx = p.PCX1 * p.LCX
    dx = mux * fz
    ex = (p.PEX1 + p.PEX2 * dfz + p.PEX3 * dfz * dfz) * (1.0 - p.PEX4 * sign(kappa_x)) * p.LEX
    bx = divide(kx, cx * dx)
    fx0 = sine_curve(bx, cx, dx, minimum(ex, 1.0), kappa_x) + svx
    return fx0, mux, kx, shx, svx


@jitable
def pure_lateral(p, alpha, gamma, fz, dfz, fz0):
    """Return Fy0, mu_y, K_y, S_Hy, S_Vy, B_y C_y (A.16 to A.26)."""
    gamma_y = gamma * p.LGAY
    ky = (
        p.PKY1
        * fz0
        * sine_of_twice_arctan(divide(fz, p.PKY2 * fz0))
        * (1.0 - p.PKY3 * absolute(gamma_y))
        * p.LKY
    )
    muy = (p.PDY1 + p.PDY2 * dfz) * (1.0 - p.PDY3 * gamma_y * gamma_y) * p.LMUY
    shy = (p.PHY1 + p.PHY2 * dfz) * p.LHY + p.PHY3 * gamma_y
    svy = fz * ((p.PVY1 + p.PVY2 * dfz) * p.LVY + (p.PVY3 + p.PVY4 * dfz) * gamma_y) * p.LMUY
    alpha_y = alpha + shy
    cy = p.PCY1 * p.LCY
    dy = muy * fz
    ey = (p.PEY1 + p.PEY2 * dfz) * (1.0 - (p.PEY3 + p.PEY4 * gamma_y) * sign(alpha_y)) * p.LEY
    by = divide(ky, cy * dy)
    fy0 = sine_curve(by, cy, dy, minimum(ey, 1.0), alpha_y) + svy
    return fy0, muy, ky, shy, svy, by * cy


@jitable
def combined_longitudinal(p, fx0, alpha, kappa, dfz):
    """Return Fx under combined slip (A.43 to A.51); E_xa of A.49 is bounded by 1."""
    bxa = p.RBX1 * cos_arctan(p.RBX2 * kappa) * p.LXAL
    exa = minimum(p.REX1 + p.REX2 * dfz, 1.0)
    return fx0 * weight(bxa, p.RCX1, exa, alpha, p.RHX1)


@jitable
def combined_lateral(p, fy0, muy, alpha, kappa, gamma, fz, dfz):
    """Return Fy under combined slip and S_Vyk (A.52 to A.62); E_yk of A.58 is bounded by 1."""
    byk = p.RBY1 * cos_arctan(p.RBY2 * (alpha - p.RBY3)) * p.LYKA
    eyk = minimum(p.REY1 + p.REY2 * dfz, 1.0)
    shyk = p.RHY1 + p.RHY2 * dfz
    dvyk = muy * fz * (p.RVY1 + p.RVY2 * dfz + p.RVY3 * gamma) * cos_arctan(p.RVY4 * alpha)
    svyk = dvyk * sin(p.RVY5 * arctan(p.RVY6 * kappa)) * p.LVYKA
    return fy0 * weight(byk, p.RCY1, eyk, kappa, shyk) + svyk, svyk


@jitable
def pneumatic_trail(p, alpha, ratio, kappa, gamma, fz, dfz):
    """Return the trail t (A.29, A.30, A.34 to A.39, A.64, A.68); E_t takes alpha_t, the curve alpha_t,eq."""
    gamma_z = gamma * p.LGAZ
    alpha_t = trail_slip(p, alpha, gamma_z, dfz)
    bt = trail_stiffness_factor(p, gamma_z, dfz)
    dt = (
        fz
        * (p.QDZ1 + p.QDZ2 * dfz)
        * (1.0 + p.QDZ3 * gamma_z + p.QDZ4 * gamma_z * gamma_z)
        * (p.UNLOADED_RADIUS / p.FNOMIN)
        * p.LTR
    )
    et = trail_curvature_factor(p, bt, alpha_t, gamma_z, dfz)
    alpha_eq = equivalent_slip(alpha_t, ratio, kappa)
    return dt * cosine_curve(bt, p.QCZ1, minimum(et, 1.0), alpha_eq) * cos(alpha)


@jitable
def residual_torque(p, alpha, alpha_r, ratio, kappa, gamma, fz, dfz, by_cy):
    """Return Mzr (A.31 with Cr = 1, A.40, A.41 with lambda_muy, A.66, A.69)."""
    gamma_z = gamma * p.LGAZ
    br = p.QBZ9 * p.LKY / p.LMUY + p.QBZ10 * by_cy
    dr = (
        fz
        * ((p.QDZ6 + p.QDZ7 * dfz) * p.LRES + (p.QDZ8 + p.QDZ9 * dfz) * gamma_z)
        * p.UNLOADED_RADIUS
        * p.LMUY
    )
    return dr * cos_arctan(br * equivalent_slip(alpha_r, ratio, kappa)) * cos(alpha)


@jitable
def rolling_resistance(p, fx, fz, speed, kx, shx, svx):
    """Return My (A.71 with the sign of the W axes and lambda_My, A.72)."""
    v = speed / p.LONGVL
    v2 = v * v
    by_speed = p.QSY1 + p.QSY2 * fx / p.FNOMIN + p.QSY3 * absolute(v) + p.QSY4 * v2 * v2
    from_force = p.UNLOADED_RADIUS * (svx + kx * shx)
    from_coefficients = -p.UNLOADED_RADIUS * fz * by_speed * p.LMY
    no_coefficients = (p.QSY1 == 0.0) & (p.QSY2 == 0.0)
    return select(no_coefficients, from_force, from_coefficients) * sign(speed)


@jitable
def relaxation(p, gamma, fz, dfz, fz0):
    """Return the lateral and the longitudinal relaxation length (MF-Tyre 5.2, by PTY and PTX)."""
    lateral = (
        p.PTY1
        * sine_of_twice_arctan(divide(fz, p.PTY2 * fz0))
        * (1.0 - p.PKY3 * absolute(gamma * p.LGAY))
        * p.UNLOADED_RADIUS
        * p.LFZO
        * p.LSGAL
    )
    longitudinal = (
        (p.PTX1 + p.PTX2 * dfz)
        * exp(minimum(maximum(-p.PTX3 * dfz, -700.0), 100.0))
        * p.LSGKP
        * p.UNLOADED_RADIUS
        * fz
        / p.FNOMIN
    )
    return lateral, longitudinal


@jitable
def evaluate_52(p, alpha, kappa, gamma, fz, speed):
    """Return the twelve outputs at points with a positive load.

    Parameters
    ----------
    p : Coefficients
    alpha, kappa, gamma, fz, speed : float or ndarray
        Slip angle (rad), slip ratio, camber (rad), load (N, positive), speed (m/s); ISO W axes.

    Returns
    -------
    tuple
        fx, fy, mx, my, mz, trail, mu_x, mu_y, K_y, K_x, lateral and longitudinal relaxation length.
    """
    fz0 = p.FNOMIN * p.LFZO
    dfz = (fz - fz0) / fz0
    fx0, mux, kx, shx, svx = pure_longitudinal(p, kappa, gamma, fz, dfz)
    fy0, muy, ky, shy, svy, by_cy = pure_lateral(p, alpha, gamma, fz, dfz, fz0)
    fx = combined_longitudinal(p, fx0, alpha, kappa, dfz)
    fy, svyk = combined_lateral(p, fy0, muy, alpha, kappa, gamma, fz, dfz)

    ratio = divide(kx, ky)
    trail = pneumatic_trail(p, alpha, ratio, kappa, gamma, fz, dfz)
    alpha_r = alpha + shy + divide(svy, ky)
    mzr = residual_torque(p, alpha, alpha_r, ratio, kappa, gamma, fz, dfz, by_cy)
    arm = (p.SSZ1 + p.SSZ2 * fy / p.FNOMIN + (p.SSZ3 + p.SSZ4 * dfz) * gamma) * p.UNLOADED_RADIUS * p.LS
    mz = -trail * (fy - svyk) + mzr + arm * fx

    mx = p.UNLOADED_RADIUS * fz * (p.QSX1 * p.LVMX + (-p.QSX2 * gamma + p.QSX3 * fy / p.FNOMIN) * p.LMX)
    my = rolling_resistance(p, fx, fz, speed, kx, shx, svx)
    lateral, longitudinal = relaxation(p, gamma, fz, dfz, fz0)
    return fx, fy, mx, my, mz, trail, mux, muy, ky, kx, lateral, longitudinal
