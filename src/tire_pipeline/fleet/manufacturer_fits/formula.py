"""Pure-slip Magic Formula 5.2, on purpose not the engine's: what judges does not rest on what is judged.

With its derivatives, for many tires at once, as the fit needs it. A test compares it with the engine.
Equations A.4 to A.14 (Fx), A.16 to A.26 (Fy) and A.28 to A.41 (Mz) of the thesis, all scale factors 1.
Parameters come as (n, p), points as (n, m); values go as (n, m) and derivatives as (n, p, m).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

FITTED_LATERAL = [
    "PCY1",
    "PDY1",
    "PDY2",
    "PDY3",
    "PEY1",
    "PEY2",
    "PEY3",
    "PEY4",
    "PKY1",
    "PKY2",
    "PKY3",
    "PHY1",
    "PHY2",
    "PHY3",
    "PVY1",
    "PVY2",
    "PVY3",
    "PVY4",
]
FITTED_LONGITUDINAL = [
    "PCX1",
    "PDX1",
    "PDX2",
    "PDX3",
    "PEX1",
    "PEX2",
    "PEX3",
    "PEX4",
    "PKX1",
    "PKX2",
    "PKX3",
    "PHX1",
    "PHX2",
    "PVX1",
    "PVX2",
]
FITTED_ALIGNING = [
    "QBZ1",
    "QBZ2",
    "QBZ3",
    "QBZ4",
    "QBZ5",
    "QBZ9",
    "QBZ10",
    "QCZ1",
    "QDZ1",
    "QDZ2",
    "QDZ3",
    "QDZ4",
    "QDZ6",
    "QDZ7",
    "QDZ8",
    "QDZ9",
    "QEZ1",
    "QEZ2",
    "QEZ3",
    "QEZ4",
    "QEZ5",
    "QHZ1",
    "QHZ2",
    "QHZ3",
    "QHZ4",
]


@dataclass(frozen=True)
class FitPoints:
    """Operating points of a batch, arrays of shape (n, m).

    Attributes
    ----------
    slip, camber, normal_load : ndarray
        rad or slip ratio, rad, N.
    nominal_load : ndarray, shape (n, 1)
        F_z0, N.
    radius : ndarray, shape (n, 1)
        Unloaded radius, m.
    """

    slip: np.ndarray
    camber: np.ndarray
    normal_load: np.ndarray
    nominal_load: np.ndarray
    radius: np.ndarray

    def take(self, rows: np.ndarray) -> FitPoints:
        """Return some of the tires."""
        return FitPoints(
            self.slip[rows],
            self.camber[rows],
            self.normal_load[rows],
            self.nominal_load[rows],
            self.radius[rows],
        )


def _columns(parameters: np.ndarray) -> list[np.ndarray]:
    return [parameters[:, k, None] for k in range(parameters.shape[1])]


@dataclass
class _Sine:
    """D sin(C arctan(Bx - E(Bx - arctan Bx))) with B = K/(C D), and its partial derivatives."""

    def __init__(self, x: np.ndarray, c: np.ndarray, d: np.ndarray, e: np.ndarray, k: np.ndarray) -> None:
        b = k / (c * d)
        u = b * x
        bend = u - np.arctan(u)
        phi = u - e * bend
        theta = np.arctan(phi)
        sine, cosine = np.sin(c * theta), np.cos(c * theta)
        self.value = d * sine
        by_phi = d * cosine * c / (1.0 + phi * phi)
        by_u = by_phi * (1.0 - e * (u * u / (1.0 + u * u)))
        self.by_x = by_u * b
        self.by_k = by_u * x / (c * d)
        self.by_c = d * cosine * theta - by_u * u / c
        self.by_d = sine - by_u * u / d
        self.by_e = -by_phi * bend
        self.stiffness_factor = b


def lateral(parameters: np.ndarray, points: FitPoints) -> tuple[np.ndarray, np.ndarray]:
    """Lateral force, A.16 to A.26.

    Parameters
    ----------
    parameters : ndarray, shape (n, 18)
        In the order of :data:`FITTED_LATERAL`.
    points : FitPoints

    Returns
    -------
    fy : ndarray, shape (n, m)
    jacobian : ndarray, shape (n, 18, m)
    """
    c1, d1, d2, d3, e1, e2, e3, e4, k1, k2, k3, h1, h2, h3, v1, v2, v3, v4 = _columns(parameters)
    fz, fz0, g = points.normal_load, points.nominal_load, points.camber
    df = (fz - fz0) / fz0
    x = points.slip + h1 + h2 * df + h3 * g
    sign = np.sign(x)
    g2 = g * g
    tilt = 1.0 - d3 * g2
    d = fz * (d1 + d2 * df) * tilt
    d = np.maximum(d, 1.0)
    side = 1.0 - (e3 + e4 * g) * sign
    level = e1 + e2 * df
    e_raw = level * side
    e = np.minimum(e_raw, 1.0)
    free = e_raw < 1.0
    ratio = fz / (k2 * fz0)
    wave = np.sin(2.0 * np.arctan(ratio))
    lean = 1.0 - k3 * np.abs(g)
    k = k1 * fz0 * wave * lean
    s = _Sine(x, c1, d, e, k)
    fy = s.value + fz * (v1 + v2 * df + (v3 + v4 * df) * g)
    jac = np.empty((len(parameters), 18, fz.shape[1]))
    jac[:, 0] = s.by_c
    jac[:, 1] = s.by_d * fz * tilt
    jac[:, 2] = jac[:, 1] * df
    jac[:, 3] = -s.by_d * fz * (d1 + d2 * df) * g2
    by_e = s.by_e * free
    jac[:, 4] = by_e * side
    jac[:, 5] = jac[:, 4] * df
    jac[:, 6] = -by_e * level * sign
    jac[:, 7] = jac[:, 6] * g
    jac[:, 8] = s.by_k * fz0 * wave * lean
    by_ratio = k1 * fz0 * lean * 2.0 * np.cos(2.0 * np.arctan(ratio)) / (1.0 + ratio * ratio)
    jac[:, 9] = s.by_k * by_ratio * (-ratio / k2)
    jac[:, 10] = -s.by_k * k1 * fz0 * wave * np.abs(g)
    jac[:, 11] = s.by_x
    jac[:, 12] = s.by_x * df
    jac[:, 13] = s.by_x * g
    jac[:, 14] = fz
    jac[:, 15] = fz * df
    jac[:, 16] = fz * g
    jac[:, 17] = jac[:, 16] * df
    return fy, jac


def longitudinal(parameters: np.ndarray, points: FitPoints) -> tuple[np.ndarray, np.ndarray]:
    """Longitudinal force, A.4 to A.14.

    Parameters
    ----------
    parameters : ndarray, shape (n, 15)
        In the order of :data:`FITTED_LONGITUDINAL`.
    points : FitPoints

    Returns
    -------
    fx : ndarray, shape (n, m)
    jacobian : ndarray, shape (n, 15, m)
    """
    c1, d1, d2, d3, e1, e2, e3, e4, k1, k2, k3, h1, h2, v1, v2 = _columns(parameters)
    fz, fz0, g = points.normal_load, points.nominal_load, points.camber
    df = (fz - fz0) / fz0
    x = points.slip + h1 + h2 * df
    sign = np.sign(x)
    tilt = 1.0 - d3 * g * g
    d = np.maximum(fz * (d1 + d2 * df) * tilt, 1.0)
    side = 1.0 - e4 * sign
    level = e1 + e2 * df + e3 * df * df
    e_raw = level * side
    e = np.minimum(e_raw, 1.0)
    power = fz * np.exp(k3 * df)
    k = (k1 + k2 * df) * power
    s = _Sine(x, c1, d, e, k)
    fx = s.value + fz * (v1 + v2 * df)
    jac = np.empty((len(parameters), 15, fz.shape[1]))
    jac[:, 0] = s.by_c
    jac[:, 1] = s.by_d * fz * tilt
    jac[:, 2] = jac[:, 1] * df
    jac[:, 3] = -s.by_d * fz * (d1 + d2 * df) * g * g
    by_e = s.by_e * (e_raw < 1.0)
    jac[:, 4] = by_e * side
    jac[:, 5] = jac[:, 4] * df
    jac[:, 6] = jac[:, 5] * df
    jac[:, 7] = -by_e * level * sign
    jac[:, 8] = s.by_k * power
    jac[:, 9] = jac[:, 8] * df
    jac[:, 10] = s.by_k * k * df
    jac[:, 11] = s.by_x
    jac[:, 12] = s.by_x * df
    jac[:, 13] = fz
    jac[:, 14] = fz * df
    return fx, jac


def _bell(
    x: np.ndarray, b: np.ndarray, c: np.ndarray, e: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """cos(C arctan(Bx - E(Bx - arctan Bx))) and its derivatives by u = Bx, C and E."""
    u = b * x
    bend = u - np.arctan(u)
    phi = u - e * bend
    theta = np.arctan(phi)
    by_phi = -np.sin(c * theta) * c / (1.0 + phi * phi)
    by_u = by_phi * (1.0 - e * (u * u / (1.0 + u * u)))
    return np.cos(c * theta), by_u, -np.sin(c * theta) * theta, -by_phi * bend


def aligning(
    parameters: np.ndarray, points: FitPoints, lateral_parameters: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Aligning torque, A.28 to A.41 (C_r = 1), on top of a lateral force that is already fitted.

    Parameters
    ----------
    parameters : ndarray, shape (n, 25)
        In the order of :data:`FITTED_ALIGNING`.
    points : FitPoints
    lateral_parameters : ndarray, shape (n, 18)

    Returns
    -------
    mz : ndarray, shape (n, m)
    jacobian : ndarray, shape (n, 25, m)
    """
    fixed = LateralPart(lateral_parameters, points)
    return fixed.aligning(parameters, points)


class LateralPart:
    """What the aligning torque takes from the lateral force: Fy0, its shift S_Hf and B_y C_y."""

    def __init__(self, lateral_parameters: np.ndarray, points: FitPoints) -> None:
        _, d1, d2, d3, _, _, _, _, k1, k2, k3, h1, h2, h3, v1, v2, v3, v4 = _columns(lateral_parameters)
        fz, fz0, g = points.normal_load, points.nominal_load, points.camber
        df = (fz - fz0) / fz0
        self.force = lateral(lateral_parameters, points)[0]
        d = np.maximum(fz * (d1 + d2 * df) * (1.0 - d3 * g * g), 1.0)
        k = k1 * fz0 * np.sin(2.0 * np.arctan(fz / (k2 * fz0))) * (1.0 - k3 * np.abs(g))
        vertical = fz * (v1 + v2 * df + (v3 + v4 * df) * g)
        self.shift = h1 + h2 * df + h3 * g + vertical / k
        self.by_cy = k / d

    def take(self, rows: np.ndarray) -> LateralPart:
        """Return some of the tires."""
        part = object.__new__(LateralPart)
        part.force, part.shift = self.force[rows], self.shift[rows]
        part.by_cy = self.by_cy[rows]
        return part

    def aligning(self, parameters: np.ndarray, points: FitPoints) -> tuple[np.ndarray, np.ndarray]:
        """See :func:`aligning`."""
        p = dict(zip(FITTED_ALIGNING, _columns(parameters), strict=True))
        jac = np.empty((len(parameters), 25, points.normal_load.shape[1]))
        by_trail = self._by_trail(p, points, jac)
        return by_trail + self._residual(p, points, jac), jac

    def _by_trail(self, p: dict[str, np.ndarray], points: FitPoints, jac: np.ndarray) -> np.ndarray:
        """Torque by the trail, A.29 and A.34 to A.39; writes its derivatives."""
        fz, fz0, g, r0 = points.normal_load, points.nominal_load, points.camber, points.radius
        df = (fz - fz0) / fz0
        df2, ag, turn = df * df, np.abs(g), np.cos(points.slip)
        x = points.slip + p["QHZ1"] + p["QHZ2"] * df + (p["QHZ3"] + p["QHZ4"] * df) * g
        b_level = p["QBZ1"] + p["QBZ2"] * df + p["QBZ3"] * df2
        b_tilt = 1.0 + p["QBZ4"] * g + p["QBZ5"] * ag
        b, c = b_level * b_tilt, p["QCZ1"]
        d_tilt = 1.0 + p["QDZ3"] * g + p["QDZ4"] * g * g
        d_scale = fz * r0 / fz0
        d = d_scale * (p["QDZ1"] + p["QDZ2"] * df) * d_tilt
        v = b * c * x
        bow = (2.0 / np.pi) * np.arctan(v)
        e_level = p["QEZ1"] + p["QEZ2"] * df + p["QEZ3"] * df2
        e_side = 1.0 + (p["QEZ4"] + p["QEZ5"] * g) * bow
        e_raw = e_level * e_side
        e = np.minimum(e_raw, 1.0)
        cosine, by_u, by_c, by_e = _bell(x, b, c, e)
        arm = -self.force * turn
        lever = arm * d
        by_e = lever * by_e * (e_raw < 1.0)
        by_bow = by_e * e_level * (p["QEZ4"] + p["QEZ5"] * g) * (2.0 / np.pi) / (1.0 + v * v)
        by_b = lever * by_u * x + by_bow * c * x
        by_x = lever * by_u * b + by_bow * b * c
        d_base = arm * cosine * d_scale
        jac[:, 0] = by_b * b_tilt
        jac[:, 1] = jac[:, 0] * df
        jac[:, 2] = jac[:, 0] * df2
        jac[:, 3] = by_b * b_level * g
        jac[:, 4] = by_b * b_level * ag
        jac[:, 7] = lever * by_c + by_bow * b * x
        jac[:, 8] = d_base * d_tilt
        jac[:, 9] = jac[:, 8] * df
        jac[:, 10] = d_base * (p["QDZ1"] + p["QDZ2"] * df) * g
        jac[:, 11] = jac[:, 10] * g
        jac[:, 16] = by_e * e_side
        jac[:, 17] = jac[:, 16] * df
        jac[:, 18] = jac[:, 16] * df2
        jac[:, 19] = by_e * e_level * bow
        jac[:, 20] = jac[:, 19] * g
        jac[:, 21] = by_x
        jac[:, 22] = by_x * df
        jac[:, 23] = by_x * g
        jac[:, 24] = jac[:, 23] * df
        return lever * cosine

    def _residual(self, p: dict[str, np.ndarray], points: FitPoints, jac: np.ndarray) -> np.ndarray:
        """Residual torque, A.31, A.40 and A.41; writes its derivatives."""
        fz, fz0, g, r0 = points.normal_load, points.nominal_load, points.camber, points.radius
        df = (fz - fz0) / fz0
        xr = points.slip + self.shift
        br = p["QBZ9"] + p["QBZ10"] * self.by_cy
        root = 1.0 / np.sqrt(1.0 + (br * xr) ** 2)
        r_scale = fz * r0 * root * np.cos(points.slip)
        level = p["QDZ6"] + p["QDZ7"] * df + (p["QDZ8"] + p["QDZ9"] * df) * g
        by_br = -r_scale * level * root * root * br * xr * xr
        jac[:, 5] = by_br
        jac[:, 6] = by_br * self.by_cy
        jac[:, 12] = r_scale
        jac[:, 13] = r_scale * df
        jac[:, 14] = r_scale * g
        jac[:, 15] = jac[:, 14] * df
        return r_scale * level
