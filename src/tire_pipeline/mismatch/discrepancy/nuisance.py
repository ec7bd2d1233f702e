"""What may be wrong without anything being left out: the coefficients a little, the formula's shape a little.

A Magic Formula fitted to a real tire leaves a structured misfit of 0.4 to 1% of the largest force.
It is a function of the model's own inputs, and what the fit left is at right angles to everything
that the fit could change. Both are used here: the flexible form is a Gaussian process in the own
inputs, made orthogonal to the coefficients' Jacobian and to the effects that act on own inputs;
the coefficients themselves may move by a small share of the largest force.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tire_pipeline.mismatch.effects.shared import first_order
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import plain_forces

Array = np.ndarray
_COEFFICIENTS = {
    "fy": (
        "PCY1 PDY1 PDY2 PDY3 PEY1 PEY2 PEY3 PEY4 PEY5 PKY1 PKY2 PKY3 PKY4 PKY5 PKY6 PKY7 PHY1 PHY2 PHY3 "
        "PVY1 PVY2 PVY3 PVY4 RBY1 RBY2 RBY3 RBY4 RCY1 REY1 REY2 RHY1 RHY2 RVY1 RVY2 RVY3 RVY4 RVY5 RVY6"
    ).split(),
    "fx": (
        "PCX1 PDX1 PDX2 PDX3 PEX1 PEX2 PEX3 PEX4 PKX1 PKX2 PKX3 PHX1 PHX2 PVX1 PVX2 RBX1 RBX2 RBX3 RCX1 "
        "REX1 REX2 RHX1"
    ).split(),
}
_OF_CAMBER = frozenset("PDX3 PDY3 PEY4 PEY5 PKY3 PKY6 PKY7 PHY3 PVY3 PVY4 RBX3 RBY4 RVY3".split())
_POINTS = ("slip_angle", "slip_ratio", "camber", "normal_load")
_LENGTHS = {"slip": 0.25, "normal_load": 0.8, "camber": 0.9}
_MOST_POINTS = 130
_NEAR, _FAR = 0.85, 1.3
_LEAST_ON_GRID = 1e-3
"""Columns smaller on the grid than so much of what they are on the recording are not known there: a slip that
does not vary but for noise has no range to spread a grid over."""
_LEAST_OF_ALL = 1e-4
"""Columns smaller than so much of the largest one do nothing here, and are not made larger: the coefficients
of camber in a recording without camber would become a constant force."""
_SLIP_STEP = 2e-3
_BANDS = (0.0, 0.1, 0.2)
"""Seconds over which the load is averaged before its rate is taken: the answer differs from band to band."""
_MEMORIES = (1.0, 4.0)
"""Seconds over which a tread remembers."""
_SHIFT_OF_FX = 2.5
"""Braking and driving are no mirror images: a fit makes up for their difference by a shift at zero slip."""


ONE_LOAD = 6.0
"""Factor on what coefficients may be off by in a recording at one load, for what keeps the mirror symmetry: a
fit to many loads may be off at any one of them."""
ASYMMETRY_SHARE = 0.12
"""What part of the misfit may break the tire's mirror symmetry (slip angle and camber turned over): a clean
tire breaks it by 0.1 to 0.2 of the misfit in the clean tuning cases."""


class Sizes(NamedTuple):
    """Numbers of columns of one output: coefficients, flexible form, and its dependence on the way."""

    coefficients: int
    flexible: int
    path: int
    memory: int
    fast: int


@dataclass(frozen=True)
class Nuisance:
    """Columns in N for each output: prior standard deviation 1 for each coefficient of a column.

    Parameters
    ----------
    coefficients : dict of ndarray, shape (n, k)
        Directions of the Jacobian, orthonormal in the root-mean-square sense, times the largest
        force: a column times 0.001 has an RMS of 0.1% of the largest force (less if it breaks the mirror
        symmetry, more at one load and for the shift of fx).
    flexible : dict of ndarray, shape (n, m)
        The flexible form, times the largest force: with coefficient standard deviation 0.005 its size is
        about 0.5% of the largest force before what the Jacobian spans is taken off.
    path : dict of ndarray, shape (n, h)
        What depends on the way to a point: another flexible form for a rising slip than for a falling one.
    memory : dict of ndarray, shape (n, l)
        Friction and stiffness that follow the friction power of the last seconds.
    fast : dict of ndarray, shape (n, f)
        The answer to load that changes faster than ``SLOW``, and a quarter of a period late. With coefficient
        standard deviation 0.3 it is known to 30%.
    """

    coefficients: dict[str, Array]
    flexible: dict[str, Array]
    path: dict[str, Array]
    memory: dict[str, Array]
    fast: dict[str, Array]

    @property
    def columns(self) -> dict[str, Array]:
        """All side by side, shape (n, k + m + h + l + f)."""
        return {o: np.hstack([part[o] for part in self._parts]) for o in self.coefficients}

    @property
    def _parts(self) -> tuple[dict[str, Array], ...]:
        return self.coefficients, self.flexible, self.path, self.memory, self.fast

    @property
    def sizes(self) -> dict[str, Sizes]:
        """Numbers of columns, k, m, h, l and f."""
        return {o: Sizes(*(part[o].shape[1] for part in self._parts)) for o in self.coefficients}


def make_nuisance(data: Data) -> Nuisance:
    """Build the columns.

    The flexible form is made orthogonal to the coefficients' Jacobian over an even grid of the
    recorded ranges, such as a fitter would have used, and not over the recording itself: what a fit
    left there may still look like a change of coefficients here.

    Parameters
    ----------
    data : Data
    """
    grid = _grid(data)
    parts: tuple[dict[str, Array], ...] = ({}, {}, {}, {}, {})
    coefficients, flexible, path, memory, fast = parts
    for name in data.outputs:
        largest = largest_force(data, name)
        here = {n: data.get(n) for n in _POINTS}
        jacobian = _jacobian(data, name, here)
        basis = _halves(data, name, here, jacobian)
        b, b_grid, ways = _gaussian_process(data, name, here, grid)
        c = np.hstack([jacobian, _shifts(data, name, here)])
        c_grid = np.hstack([_jacobian(data, name, grid), _shifts(data, name, grid)])
        known = _size(c_grid) > _LEAST_ON_GRID * _size(c)
        b = b - c[:, known] @ _solve(c_grid[:, known], b_grid)
        if name == "fx":
            basis = np.hstack([basis, _SHIFT_OF_FX * _orthonormal(_shifts(data, name, here))])
        coefficients[name] = basis * largest
        flexible[name] = b * largest
        path[name] = ways * largest
        memory[name] = _memory(data, name)
        fast[name] = _fast_load(data, name)
    return Nuisance(*parts)


def _fast_load(data: Data, name: str) -> Array:
    """Force of what the load changes faster than ``SLOW``, as it is and by its rate, of equal size.

    A formula is of steady states. To load that changes within a wheel turn a tire answers with another size
    and late (Pacejka, 3rd ed., 7.3.2), and what a rig measures then holds inertia.
    """
    if data.time is None:
        return np.zeros((data.size, 0))
    load = data.get("normal_load")
    change = (load - data.smooth("normal_load")) / np.maximum(load, 0.02 * data.load_nominal)
    if not np.any(change):
        return np.zeros((data.size, 0))
    rates = [_rate(data, data.running_mean(change, seconds)) for seconds in _BANDS]
    drivers = [change, *(rate * (_rms(change) / max(_rms(rate), 1e-12)) for rate in rates)]
    slip = "slip_angle" if name == "fy" else "slip_ratio"
    steeper = data.slope(slip, _SLIP_STEP)[name] * data.get(slip)
    return np.column_stack([way * driver for way in (data.base[name], steeper) for driver in drivers])


def _rate(data: Data, x: Array) -> Array:
    """Change over two samples, nothing at the ends of pieces."""
    out = np.zeros(data.size)
    out[1:-1] = x[2:] - x[:-2]
    out[data.start] = 0.0
    out[np.flatnonzero(data.start)[1:] - 1] = 0.0
    return out


def _memory(data: Data, name: str) -> Array:
    """Friction and stiffness that follow the friction power of the last seconds.

    Tread and belt warm and cool within a sweep. Where the power has been the same for long, this is nothing.
    """
    slip = "slip_angle" if name == "fy" else "slip_ratio"
    if data.time is None or not data.varies(slip):
        return np.zeros((data.size, 0))
    speed = np.abs(data.get("speed")) if data.has("speed") else np.ones(data.size)
    power = np.abs(data.base[name] * data.get(slip)) * speed
    power = power / max(float(np.quantile(power, 0.9)), 1e-12)
    lags = [first_order(power, 1.0 - np.exp(-data.step / lag), data.start) - power for lag in _MEMORIES]
    ways = (data.base[name], data.slope(slip, _SLIP_STEP)[name] * data.get(slip))
    return np.column_stack([way * lag for way in ways for lag in lags])


def _rms(x: Array) -> float:
    return float(np.sqrt(np.mean(x**2)))


def _size(columns: Array) -> Array:
    """Root mean square of each column."""
    return np.sqrt(np.mean(columns**2, axis=0)) if columns.size else np.zeros(columns.shape[1])


def _solve(a: Array, b: Array) -> Array:
    """Least squares, columns of ``a`` scaled, small directions left out."""
    size = np.sqrt((a**2).sum(axis=0))
    size[size <= 0.0] = 1.0
    return np.linalg.lstsq(a / size, b, rcond=1e-3)[0] / size[:, None]


def _grid(data: Data) -> dict[str, Array]:
    """Even points over the recorded ranges: pure slip, slip with camber, combined slip, at five loads."""
    low, high = np.quantile(data.get("normal_load"), [0.005, 0.995])
    loads = np.linspace(low, high, 5) if data.varies("normal_load") else np.array([0.5 * (low + high)])
    a = _range(data, "slip_angle", 31)
    k = _range(data, "slip_ratio", 21)
    rows = [(x, 0.0, 0.0, f) for f in loads for x in a]
    rows += [(0.0, x, 0.0, f) for f in loads for x in k]
    if data.varies("camber") and data.knows_camber:
        g = float(np.quantile(np.abs(data.get("camber")), 0.99))
        rows += [(x, 0.0, c * g, f) for f in loads for c in (-1.0, -0.5, 0.5, 1.0) for x in a[::2]]
    if data.has_combined:
        rows += [(s, x, 0.0, f) for f in loads for s in (-0.08, -0.04, 0.04, 0.08) for x in k[::2]]
    points = np.array(rows)
    return dict(zip(_POINTS, points.T, strict=True))


def _range(data: Data, name: str, count: int) -> Array:
    if not data.varies(name):
        return np.zeros(1)
    top = float(np.quantile(np.abs(data.get(name)), 0.999))
    return np.linspace(-top, top, count)


def _shifts(data: Data, name: str, at: dict[str, Array]) -> Array:
    """Constant, load and slope: a fit would have found a shift of the curve even if the file has none."""
    slip, h = ("slip_angle", 2e-3) if name == "fy" else ("slip_ratio", 2e-3)
    up, down = (plain_forces(data.tire, **{**at, slip: at[slip] + s * h})[name] for s in (1.0, -1.0))
    load = at["normal_load"]
    return np.column_stack([np.full(load.size, data.load_nominal), load, up - down])


def largest_force(data: Data, name: str) -> float:
    """Return the largest simulated force (99.5% quantile), N.

    If this force is near zero, a fraction of the other one.
    """
    sizes = {n: float(np.quantile(np.abs(data.base[n]), 0.995)) for n in data.outputs}
    top = max(*sizes.values(), 1e-09)
    return sizes[name] if sizes[name] > 0.3 * top else 0.3 * top


def _jacobian(data: Data, name: str, at: dict[str, Array]) -> Array:
    """d force / d coefficient for the coefficients that the file has and that matter here."""
    c = data.tire.coefficients
    missing = getattr(data.tire, "defaulted", {})
    columns = []
    for key in _COEFFICIENTS[name]:
        value = float(c.get(key, 0.0))
        if value == 0.0 or key in missing or (key in _OF_CAMBER and not data.varies("camber")):
            continue  # where camber stands still its coefficients would be a constant force of any size
        h = 1e-4 * max(abs(value), 0.05)
        up, down = (plain_forces(data.tire.replace(**{key: value + s * h}), **at)[name] for s in (1.0, -1.0))
        columns.append((up - down) / (2.0 * h) * max(abs(value), 0.05))
    return np.column_stack(columns) if columns else np.zeros((at["normal_load"].size, 0))


def _halves(data: Data, name: str, here: dict[str, Array], jacobian: Array) -> Array:
    """Directions of the coefficients that keep the mirror symmetry, and those that break it, made smaller."""
    mirrored = {n: -a if n in ("slip_angle", "camber") else a for n, a in here.items()}
    image = _jacobian(data, name, mirrored) * (-1.0 if name == "fy" else 1.0)
    kept, broken = 0.5 * (jacobian + image), 0.5 * (jacobian - image)
    least = 1e-2 * np.sqrt(np.mean(jacobian**2, axis=0))
    broken = broken[:, np.sqrt(np.mean(broken**2, axis=0)) > least]
    kept = kept[:, np.sqrt(np.mean(kept**2, axis=0)) > least]
    size = 1.0 if data.varies("normal_load") else ONE_LOAD
    return np.hstack([size * _orthonormal(kept), ASYMMETRY_SHARE * _orthonormal(broken)])


def _orthonormal(columns: Array) -> Array:
    """Return columns of RMS 1 that span what is well determined of the given ones."""
    n = columns.shape[0]
    size = np.sqrt(np.mean(columns**2, axis=0)) if columns.size else np.zeros(0)
    keep = size > _LEAST_OF_ALL * max(float(size.max(initial=0.0)), 1e-30)
    if not keep.any():
        return np.zeros((n, 0))
    gram = (columns[:, keep] / size[keep]).T @ (columns[:, keep] / size[keep]) / n
    values, vectors = np.linalg.eigh(gram)
    good = values > 1e-6 * values.max()
    return (columns[:, keep] / size[keep]) @ (vectors[:, good] / np.sqrt(values[good]))


def _coordinates(data: Data, at: dict[str, Array]) -> tuple[Array, Array]:
    """Own inputs, each over the length in which the misfit may change, and their signs in a mirror.

    In a mirror that stands along the wheel plane, slip angle and camber change their sign.
    """
    parts, mirror = [], []
    for slip, force in (("slip_angle", "fy"), ("slip_ratio", "fx")):
        if data.varies(slip):
            half = _slip_at_half(data, force)
            parts.append(2.0 / np.pi * np.arctan(at[slip] / half) / _LENGTHS["slip"])
            mirror.append(-1.0 if slip == "slip_angle" else 1.0)
    if data.varies("normal_load"):
        low, high = np.quantile(data.get("normal_load"), [0.005, 0.995])
        load = (at["normal_load"] - 0.5 * (low + high)) / (0.5 * (high - low))
        parts.append(load / _LENGTHS["normal_load"])
        mirror.append(1.0)
    if data.varies("camber") and data.knows_camber:
        parts.append(at["camber"] / np.quantile(np.abs(data.get("camber")), 0.99) / _LENGTHS["camber"])
        mirror.append(-1.0)
    if not parts:
        return np.zeros((at["normal_load"].size, 1)), np.ones(1)
    return np.column_stack(parts), np.array(mirror)


def _slip_at_half(data: Data, force: str) -> float:
    """Slip at which the linear force would be the largest force: where the curve bends."""
    slip = np.linspace(1e-3, 0.35, 200)
    zero = np.zeros(200)
    args = (
        {"slip_angle": slip, "slip_ratio": zero}
        if force == "fy"
        else {"slip_angle": zero, "slip_ratio": slip}
    )
    f = np.abs(
        plain_forces(data.tire, camber=zero, normal_load=np.full(200, data.load_nominal), **args)[force]
    )
    k = max(f[0] / slip[0], 1e-9)
    return float(np.clip(f.max() / k, 0.005, 0.3))


def _gaussian_process(
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
    pick = np.random.default_rng(0).permutation(data.size)[:3000]
    points = np.vstack([x[pick], y])
    sign = -1.0 if name == "fy" else 1.0
    kernels = [_Mirrored(points, mirror, sign, _NEAR, 1.0)]
    if mirror.min() < 0.0:
        kernels.append(_Mirrored(points, mirror, -sign, _FAR, ASYMMETRY_SHARE))
    top = np.quantile(data.get("normal_load"), 0.99)
    slip, half = ("slip_angle" if name == "fy" else "slip_ratio"), _slip_at_half(data, name)
    lean = max(float(np.quantile(np.abs(data.get("camber")), 0.99)), 0.01)

    def amplitude(point: dict[str, Array]) -> Array:
        size = 0.25 + 0.75 * np.clip(point["normal_load"] / top, 0.0, 1.2)
        used = np.abs(point[slip]) / (np.abs(point[slip]) + 0.5 * half)
        if name == "fy":
            used = np.minimum(used + 0.3 * np.abs(point["camber"]) / lean * data.varies("camber"), 1.0)
        return size * np.maximum(used, 0.1)

    def features(at: Array, point: dict[str, Array]) -> Array:
        waves = np.hstack([k.features(at) for k in kernels])
        return waves * amplitude(point)[:, None]

    ways = np.zeros((data.size, 0))
    towards = _direction(data, slip)
    if towards is not None:
        turned = _Mirrored(points, mirror, -sign if name == "fy" else sign, _NEAR, 1.0)
        ways = turned.features(x) * (amplitude(here) * towards)[:, None]
    return features(x, here), features(y, grid), ways


def _direction(data: Data, slip: str) -> Array | None:
    """Direction of the sweep, -1 to 1: rate of the slip over its typical size; None without a time line."""
    if data.time is None or not data.varies(slip):
        return None
    rate = _rate(data, data.smooth(slip)) / np.maximum(data.step, 1e-12)
    typical = max(float(np.quantile(np.abs(rate), 0.75)), 1e-12)
    return np.tanh(2.0 * rate / typical)


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
        self.centres = _spread(points, apart, _MOST_POINTS)
        kernel = self._kernel(self.centres) + 1e-6 * np.eye(len(self.centres))
        values, vectors = np.linalg.eigh(kernel)
        good = values > 1e-3 * values.max()
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
