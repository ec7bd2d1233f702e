"""What may be wrong without anything being left out: the coefficients a little, the formula's shape a little.

A Magic Formula fitted to a real tire leaves a structured misfit of 0.4 to 1% of the largest force.
It is a function of the model's own inputs, and what the fit left is at right angles to everything
that the fit could change. Both are used here: the flexible form is a Gaussian process in the own
inputs, made orthogonal to the coefficients' Jacobian and to the effects that act on own inputs;
the coefficients themselves may move by a small share of the largest force.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch.data import Data
from tire_pipeline.mismatch.simulate import plain_forces

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
_LENGTHS = {"slip": 0.22, "normal_load": 0.9, "camber": 0.8}
_MOST_POINTS = 90


@dataclass(frozen=True)
class Nuisance:
    """Columns in N for each output: prior standard deviation 1 for each coefficient of a column.

    Parameters
    ----------
    coefficients : dict of ndarray, shape (n, k)
        Directions of the Jacobian, orthonormal in the root-mean-square sense, times the largest
        force: a column times 0.001 has an RMS of 0.1% of the largest force.
    flexible : dict of ndarray, shape (n, m)
        The flexible form, times the largest force: with coefficient standard deviation 0.005 its
        size is about 0.5% of the largest force.
    """

    coefficients: dict[str, Array]
    flexible: dict[str, Array]


def make_nuisance(data: Data, tangents: dict[str, Array]) -> Nuisance:
    """Build the columns.

    Parameters
    ----------
    data : Data
    tangents : dict of ndarray, shape (n, k)
        Columns of the effects in own inputs, to which the flexible form is made orthogonal.
    """
    coefficients, flexible = {}, {}
    for name in data.outputs:
        largest = largest_force(data, name)
        c = _orthonormal(_jacobian(data, name))
        b = _gaussian_process(data, name)
        spanned = _orthonormal(np.hstack([c, tangents[name]]))
        b = b - spanned @ (spanned.T @ b) / data.size
        coefficients[name] = c * largest
        flexible[name] = b * largest
    return Nuisance(coefficients, flexible)


def largest_force(data: Data, name: str) -> float:
    """Return the largest force of the recording, N: 99.5% quantile, of either output if one is at rest."""
    sizes = {n: float(np.quantile(np.abs(data.base[n]), 0.995)) for n in data.outputs}
    recorded = {n: float(np.quantile(np.abs(data.recorded[n]), 0.995)) for n in data.outputs}
    own = min(max(sizes[name], 1e-9), max(recorded[name], 1e-9))
    return max(own, 0.05 * max(max(sizes.values()), 1e-9))


def _jacobian(data: Data, name: str) -> Array:
    """d force / d coefficient for the coefficients that the file has and that matter here."""
    c = data.tire.coefficients
    missing = getattr(data.tire, "defaulted", {})
    columns = []
    args = {n: data.get(n) for n in ("slip_angle", "slip_ratio", "camber", "normal_load")}
    for key in _COEFFICIENTS[name]:
        value = float(c.get(key, 0.0))
        if value == 0.0 or key in missing:
            continue
        h = 1e-4 * max(abs(value), 0.05)
        up, down = (
            plain_forces(
                data.tire.replace(**{key: value + s * h}),
                speed=data.model_speed,
                pressure=data.model_pressure,
                **args,
            )[name]
            for s in (1.0, -1.0)
        )
        columns.append((up - down) / (2.0 * h) * max(abs(value), 0.05))
    return np.column_stack(columns) if columns else np.zeros((data.size, 0))


def _orthonormal(columns: Array) -> Array:
    """Return columns of RMS 1 that span what is well determined of the given ones."""
    n = columns.shape[0]
    size = np.sqrt(np.mean(columns**2, axis=0)) if columns.size else np.zeros(0)
    keep = size > 1e-9 * max(float(size.max(initial=0.0)), 1e-30)
    if not keep.any():
        return np.zeros((n, 0))
    gram = (columns[:, keep] / size[keep]).T @ (columns[:, keep] / size[keep]) / n
    values, vectors = np.linalg.eigh(gram)
    good = values > 1e-6 * values.max()
    return (columns[:, keep] / size[keep]) @ (vectors[:, good] / np.sqrt(values[good]))


def _coordinates(data: Data, name: str) -> Array:
    """Own inputs, each divided by the length over which the misfit may change."""
    parts = []
    for slip, force in (("slip_angle", "fy"), ("slip_ratio", "fx")):
        x = data.get(slip)
        if not data.varies(slip):
            continue
        half = _slip_at_half(data, force)
        parts.append(2.0 / np.pi * np.arctan(x / half) / _LENGTHS["slip"])
    load = data.get("normal_load")
    if data.varies("normal_load"):
        low, high = np.quantile(load, [0.005, 0.995])
        parts.append((load - 0.5 * (low + high)) / (0.5 * (high - low)) / _LENGTHS["normal_load"])
    if data.varies("camber") and data.knows_camber:
        parts.append(data.get("camber") / np.quantile(np.abs(data.get("camber")), 0.99) / _LENGTHS["camber"])
    return np.column_stack(parts) if parts else np.zeros((data.size, 1))


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


def _gaussian_process(data: Data, name: str) -> Array:
    """Nystrom features of a squared-exponential kernel at inducing points spread over the data."""
    x = _coordinates(data, name)
    pick = np.random.default_rng(0).permutation(data.size)[:3000]
    centres = _spread(x[pick], 0.8, _MOST_POINTS)
    kernel = _kernel(centres, centres) + 1e-6 * np.eye(len(centres))
    values, vectors = np.linalg.eigh(kernel)
    good = values > 1e-4 * values.max()
    features = _kernel(x, centres) @ (vectors[:, good] / np.sqrt(values[good]))
    load = data.get("normal_load")
    size = 0.25 + 0.75 * np.clip(load / np.quantile(load, 0.99), 0.0, 1.2)
    return features * size[:, None]


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
