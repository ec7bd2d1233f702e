"""The formula's misfit: a Gaussian process in the model's own inputs that keeps the tire's symmetries."""

from __future__ import annotations

import numpy as np

from tire_pipeline.channels import FORCE_OF_SLIP, SLIP_OF_FORCE
from tire_pipeline.mismatch.discrepancy.nuisance.coefficients import ASYMMETRY_SHARE
from tire_pipeline.mismatch.discrepancy.nuisance.transients import rate
from tire_pipeline.mismatch.model.channels import (
    ABSOLUTE_SPREAD,
    DOES_NOTHING,
    ENOUGH_ROWS,
    high,
    largest,
    span,
)
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.plain_forces import plain_forces

Array = np.ndarray
At = dict[str, Array]
_LENGTHS_OF_INPUTS = {"slip": 0.25, "normal_load": 0.8, "camber": 0.9}
"""Length in which the misfit may change: of slip by the angle whose tangent it is over the slip at which the
curve bends, a quarter turn being 1; of load by half its range; of camber by its largest."""
_MOST_CENTRES = 130
"""Inducing points of each kernel at most: the time of the features grows with their square."""
_UNLOADED = 0.25
"""Size of the misfit without load, over that at the largest load."""
_SYMMETRIC_LENGTH, _ASYMMETRIC_LENGTH = 0.85, 1.3
"""Times those lengths: what breaks the mirror symmetry changes more slowly."""
_USED_BY_CAMBER = 0.3
"""Part of the misfit of Fy that the largest camber brings without slip, as it brings a part of the force."""
_AT_REST = 0.1
"""Part of the misfit that is left where the force is zero."""
_BENDS_BETWEEN = (0.005, 0.3)
"""Slips between which the bend of a force over slip is looked for, rad and 1."""


def flexible_form(
    data: Data, name: str, here: dict[str, Array], grid: dict[str, Array]
) -> tuple[Array, Array, Array]:
    """Nystrom features of a squared-exponential kernel at inducing points spread over data and grid.

    The misfit is small where the force itself is zero: at zero slip (and zero camber), at small load.
    A tire is its own mirror image but for ply steer and conicity, which the fit of a file takes up:
    the misfit of Fy changes its sign in the mirror, that of Fx does not, and what breaks this is
    ``ASYMMETRY_SHARE`` of it.

    A steady formula says the same on the way up and on the way down of a sweep. A tire does not: tread and
    carcass warm within a sweep, and the force follows late. The third array holds another flexible form,
    times the direction of the sweep. Its mirror image has the opposite direction.
    """
    (x, mirror), (y, _) = _coordinates(data, here), _coordinates(data, grid)
    pick = np.random.default_rng(0).permutation(data.size)[:ENOUGH_ROWS]
    points = np.vstack([x[pick], y])
    sign = -1.0 if name == "fy" else 1.0
    kernels = [_Mirrored(points, mirror, sign, _SYMMETRIC_LENGTH, 1.0)]
    if mirror.min() < 0.0:
        kernels.append(_Mirrored(points, mirror, -sign, _ASYMMETRIC_LENGTH, ASYMMETRY_SHARE))
    top = largest(data.get("normal_load"))
    slip, half = SLIP_OF_FORCE[name], _slip_at_half(data, name)
    lean = max(largest(data.get("camber")), ABSOLUTE_SPREAD["camber"])

    def amplitude(point: dict[str, Array]) -> Array:
        size = _UNLOADED + (1.0 - _UNLOADED) * np.maximum(point["normal_load"] / top, 0.0)
        used = np.abs(point[slip]) / (np.abs(point[slip]) + 0.5 * half)
        if name == "fy":
            by_camber = _USED_BY_CAMBER * np.abs(point["camber"]) / lean * data.varies("camber")
            used = np.minimum(used + by_camber, 1.0)
        return size * np.maximum(used, _AT_REST)

    def features(at: Array, point: dict[str, Array]) -> Array:
        waves = np.hstack([k.features(at) for k in kernels])
        return waves * amplitude(point)[:, None]

    ways = np.zeros((data.size, 0))
    towards = _direction(data, slip)
    if towards is not None:
        turned = _Mirrored(points, mirror, -sign if name == "fy" else sign, _SYMMETRIC_LENGTH, 1.0)
        ways = turned.features(x) * (amplitude(here) * towards)[:, None]
    return features(x, here), features(y, grid), ways


def _direction(data: Data, slip: str) -> Array | None:
    """Direction of the sweep, -1 to 1: rate of the slip over its typical size; without time, that by rows."""
    if not data.varies(slip):
        return None
    changes = rate(data, data.smooth(slip)) / (1.0 if data.time is None else np.maximum(data.step, 1e-12))
    typical = max(high(changes), 1e-12)
    return np.tanh(2.0 * changes / typical)


def _coordinates(data: Data, at: dict[str, Array]) -> tuple[Array, Array]:
    """Own inputs, each over the length in which the misfit may change, and their signs in a mirror.

    In a mirror that stands along the wheel plane, slip angle and camber change their sign.
    """
    parts, mirror = [], []
    for slip, force in FORCE_OF_SLIP.items():
        if data.varies(slip):
            half = _slip_at_half(data, force)
            parts.append(2.0 / np.pi * np.arctan(at[slip] / half) / _LENGTHS_OF_INPUTS["slip"])
            mirror.append(-1.0 if slip == "slip_angle" else 1.0)
    if data.varies("normal_load"):
        low, high = span(data.get("normal_load"))
        load = (at["normal_load"] - 0.5 * (low + high)) / (0.5 * (high - low))
        parts.append(load / _LENGTHS_OF_INPUTS["normal_load"])
        mirror.append(1.0)
    if data.varies("camber") and data.nominal.knows_camber:
        parts.append(at["camber"] / largest(data.get("camber")) / _LENGTHS_OF_INPUTS["camber"])
        mirror.append(-1.0)
    if not parts:
        return np.zeros((at["normal_load"].size, 1)), np.ones(1)
    return np.column_stack(parts), np.array(mirror)


def _slip_at_half(data: Data, force: str) -> float:
    """Slip at which the linear force would be the largest force: where the curve bends.

    Of the part of the force that changes its sign with slip: ply steer, conicity and other shifts at zero
    slip are no slope.
    """
    least, most = _BENDS_BETWEEN
    slip = np.linspace(0.0, most, ENOUGH_ROWS)[1:]
    zero = np.zeros_like(slip)
    none = {**dict.fromkeys(FORCE_OF_SLIP, zero), "camber": zero, "normal_load": zero + data.nominal.load}
    ahead, back = (plain_forces(data.tire, **{**none, SLIP_OF_FORCE[force]: s})[force] for s in (slip, -slip))
    f = 0.5 * np.abs(ahead - back)
    k = max(f[0] / slip[0], 1e-9)
    return float(np.clip(f.max() / k, least, most))


class _Mirrored:
    """Features of a Gaussian process that is even (sign 1) or odd (sign -1) under a mirror.

    Parameters
    ----------
    points : ndarray, shape (n, d)
        Where inducing points may lie.
    mirror : ndarray, shape (d,)
        Signs of the coordinates in the mirror.
    sign : float
    apart : float
        Distance of the inducing points.
    size : float
        Standard deviation.
    """

    def __init__(self, points: Array, mirror: Array, sign: float, apart: float, size: float) -> None:
        self.mirror, self.sign, self.plain = mirror, sign, bool(mirror.min() > 0.0)
        turned = np.flatnonzero(mirror < 0.0)
        if turned.size:  # one half of the space stands for both
            points = np.where((points[:, turned[0]] < 0.0)[:, None], points * mirror, points)
        self.centres = _spread(points, apart, _MOST_CENTRES)
        kernel = self._kernel(self.centres) + 1e-6 * np.eye(len(self.centres))
        values, vectors = np.linalg.eigh(kernel)
        good = values > DOES_NOTHING * values.max()
        self.to_features = size * vectors[:, good] / np.sqrt(values[good])

    def _kernel(self, x: Array) -> Array:
        plain = _kernel(x, self.centres)
        if self.plain:
            return plain
        both = plain + self.sign * _kernel(x, self.centres * self.mirror)
        if self.sign < 0.0:
            return both
        return both / np.sqrt(np.outer(self._twice(x), self._twice(self.centres)))

    def _twice(self, x: Array) -> Array:
        """How much of a point its mirror image is, plus one."""
        return 1.0 + np.exp(-0.5 * ((x - x * self.mirror) ** 2).sum(axis=1))

    def features(self, x: Array) -> Array:
        """Return the features at points, shape (n, m)."""
        return self._kernel(x) @ self.to_features


def _kernel(a: Array, b: Array) -> Array:
    d = (a**2).sum(1)[:, None] + (b**2).sum(1)[None, :] - 2.0 * a @ b.T
    return np.exp(-0.5 * np.maximum(d, 0.0))


def _spread(x: Array, least: float, most: int) -> Array:
    """Farthest-point sampling until the points are ``least`` apart or there are ``most``."""
    chosen = [int(np.argmin(((x - np.median(x, axis=0)) ** 2).sum(1)))]
    distance = ((x - x[chosen[0]]) ** 2).sum(1)
    while len(chosen) < most and distance.max() > least**2:
        k = int(np.argmax(distance))
        chosen.append(k)
        distance = np.minimum(distance, ((x - x[k]) ** 2).sum(1))
    return x[chosen]
