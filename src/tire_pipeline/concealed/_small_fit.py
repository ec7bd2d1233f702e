"""A small MF 5.2 fitter for fx and fy, until ``tire_pipeline.magic_formula`` has one."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from scipy.optimize import least_squares

_START = {
    "PCY1": 1.4, "PDY1": 1.0, "PDY2": -0.1, "PEY1": -0.5, "PEY2": 0.0, "PKY1": 20.0, "PKY2": 2.0,
    "PCX1": 1.5, "PDX1": 1.0, "PDX2": -0.1, "PEX1": 0.0, "PEX2": 0.0, "PEX3": 0.0,
    "PKX1": 25.0, "PKX2": 0.0, "PKX3": 0.0,
    "RBX1": 10.0, "RBX2": 8.0, "RCX1": 1.0, "REX1": 0.0,
    "RBY1": 10.0, "RBY2": 8.0, "RCY1": 1.0, "REY1": 0.0,
    "PDY3": 0.0, "PHY3": 0.0, "PVY3": 0.0, "PVY4": 0.0, "PKY3": 0.0, "PEY4": 0.0,
}  # fmt: skip
_LATERAL = ("PCY1", "PDY1", "PDY2", "PEY1", "PEY2", "PKY1", "PKY2")
_LONGITUDINAL = ("PCX1", "PDX1", "PDX2", "PEX1", "PEX2", "PEX3", "PKX1", "PKX2", "PKX3")
_CAMBER = ("PDY3", "PHY3", "PVY3", "PVY4", "PKY3", "PEY4")
_COMBINED = ("RBX1", "RBX2", "RCX1", "REX1", "RBY1", "RBY2", "RCY1", "REY1")


def small_forces(
    p: Mapping[str, float], alpha: np.ndarray, kappa: np.ndarray, gamma: np.ndarray, fz: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return fx and fy, N, of MF 5.2 (thesis, Appendix A) with all other coefficients zero."""
    q = {**_START, **p}
    d = (fz - q["FNOMIN"]) / q["FNOMIN"]

    def curve(b, c, e, x):  # type: ignore[no-untyped-def]
        bx = b * x
        return np.sin(c * np.arctan(bx - np.minimum(e, 1.0) * (bx - np.arctan(bx))))

    dx = (q["PDX1"] + q["PDX2"] * d) * fz
    kx = fz * (q["PKX1"] + q["PKX2"] * d) * np.exp(np.clip(q["PKX3"] * d, -50, 50))
    ex = q["PEX1"] + q["PEX2"] * d + q["PEX3"] * d * d
    fx = dx * curve(kx / (q["PCX1"] * dx), q["PCX1"], ex, kappa)
    dy = (q["PDY1"] + q["PDY2"] * d) * (1 - q["PDY3"] * gamma**2) * fz
    ky = q["PKY1"] * q["FNOMIN"] * np.sin(2 * np.arctan(fz / (q["PKY2"] * q["FNOMIN"])))
    ky = ky * (1 - q["PKY3"] * np.abs(gamma))
    ay = alpha + q["PHY3"] * gamma
    ey = (q["PEY1"] + q["PEY2"] * d) * (1 - q["PEY4"] * gamma * np.sign(ay))
    fy = dy * curve(ky / (q["PCY1"] * dy), q["PCY1"], ey, ay)
    fy = fy + fz * (q["PVY3"] + q["PVY4"] * d) * gamma

    def weight(b, c, e, x):  # type: ignore[no-untyped-def]
        bx = b * x
        return np.cos(c * np.arctan(bx - np.minimum(e, 1.0) * (bx - np.arctan(bx))))

    bxa = q["RBX1"] * np.cos(np.arctan(q["RBX2"] * kappa))
    byk = q["RBY1"] * np.cos(np.arctan(q["RBY2"] * alpha))
    gx = weight(bxa, q["RCX1"], q["REX1"], alpha)
    gy = weight(byk, q["RCY1"], q["REY1"], kappa)
    return fx * gx, fy * gy


def small_fit(
    nominal_load: float, inputs: Mapping[str, np.ndarray], fx: np.ndarray, fy: np.ndarray
) -> dict[str, float]:
    """Fit pure slip, then camber, then combined slip, each by least squares."""
    p: dict[str, float] = {"FNOMIN": nominal_load}
    alpha, kappa, gamma, fz = (inputs[k] for k in ("slip_angle", "slip_ratio", "camber", "normal_load"))
    pure_y = (kappa == 0) & (gamma == 0)
    pure_x = (alpha == 0) & (gamma == 0)
    stages: tuple[tuple[tuple[str, ...], np.ndarray, int | None], ...] = (
        (_LATERAL, pure_y, 1),
        (_LONGITUDINAL, pure_x, 0),
        (_CAMBER, (gamma != 0), 1),
        (_COMBINED, (alpha != 0) & (kappa != 0), None),
    )
    p.update(PKY1=math.copysign(20.0, float(np.sum(alpha * fy))))
    for names, mask, output in stages:
        if not mask.any():
            continue
        at = [a[mask] for a in (alpha, kappa, gamma, fz)]
        goal = (fx[mask], fy[mask])

        def residual(x, names=names, at=at, goal=goal, output=output):  # type: ignore[no-untyped-def]
            got = small_forces({**p, **dict(zip(names, x, strict=True))}, *at)
            pair = [(got[i] - goal[i]) / nominal_load for i in (0, 1) if output in (None, i)]
            return np.concatenate(pair)

        start = [p.get(n, _START[n]) for n in names]
        result = least_squares(residual, start, x_scale=np.maximum(np.abs(start), 0.3), max_nfev=30)
        p.update(dict(zip(names, map(float, result.x), strict=True)))
    return {**_START, **p}
