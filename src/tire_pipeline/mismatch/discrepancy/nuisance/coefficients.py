"""Small errors of the coefficients: directions of the force's Jacobian, and shifts that a fit makes."""

from __future__ import annotations

import numpy as np

from tire_pipeline.channels import SLIP_OF_FORCE
from tire_pipeline.mismatch.model.channels import ABSOLUTE_SPREAD, DOES_NOTHING
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.nominal import OF_CAMBER
from tire_pipeline.mismatch.model.plain_forces import plain_forces

Array = np.ndarray
At = dict[str, Array]
_COEFFICIENTS_OF_FORCE = {
    "fy": (
        "PCY1 PDY1 PDY2 PDY3 PEY1 PEY2 PEY3 PEY4 PEY5 PKY1 PKY2 PKY3 PKY4 PKY5 PKY6 PKY7 PHY1 PHY2 PHY3 "
        "PVY1 PVY2 PVY3 PVY4 RBY1 RBY2 RBY3 RBY4 RCY1 REY1 REY2 RHY1 RHY2 RVY1 RVY2 RVY3 RVY4 RVY5 RVY6"
    ).split(),
    "fx": (
        "PCX1 PDX1 PDX2 PDX3 PEX1 PEX2 PEX3 PEX4 PKX1 PKX2 PKX3 PHX1 PHX2 PVX1 PVX2 RBX1 RBX2 RBX3 RCX1 "
        "REX1 REX2 RHX1"
    ).split(),
    "mz": (
        "QBZ1 QBZ2 QBZ3 QBZ4 QBZ5 QBZ9 QBZ10 QCZ1 QDZ1 QDZ2 QDZ3 QDZ4 QDZ6 QDZ7 QDZ8 QDZ9 QDZ10 QDZ11 QEZ1 "
        "QEZ2 QEZ3 QEZ4 QEZ5 QHZ1 QHZ2 QHZ3 QHZ4 SSZ1 SSZ2 SSZ3 SSZ4"
    ).split(),
}
_SHIFT_OF_FX = 2.5
"""Braking and driving are no mirror images: a fit makes up for their difference by a shift at zero slip."""
_LEAST_PART = 0.01
"""Part of a coefficient's slope below which its symmetric, or its asymmetric, half is what differences leave
by rounding."""
ONE_LOAD = 6.0
"""Factor on what coefficients may be off by in a recording at one load, for what keeps the mirror symmetry: a
fit to many loads may be off at any one of them."""
ASYMMETRY_SHARE = 0.12
"""What part of the misfit may break the tire's mirror symmetry (slip angle and camber turned over): a clean
tire breaks it by 0.1 to 0.2 of the misfit in the clean tuning cases."""


def directions(data: Data, name: str, at: At) -> Array:
    """Return directions in which the coefficients may move an output's force, of unit size, shape (n, k)."""
    basis = _halves(data, name, at, jacobian(data, name, at))
    if name != "fx":
        return basis
    return np.hstack([basis, _SHIFT_OF_FX * _orthonormal(shifts(data, name, at))])


def jacobian(data: Data, name: str, at: At) -> Array:
    """What the force changes by if a coefficient changes by all of itself, to first order, shape (n, k).

    For the coefficients that the file has and that matter here: where camber stands still its own would be a
    constant force of any size.
    """
    c = data.tire.coefficients
    missing = getattr(data.tire, "defaulted", {})
    keys = [
        key
        for key in _COEFFICIENTS_OF_FORCE[name]
        if c.get(key, 0.0) and key not in missing and (key not in OF_CAMBER[name] or data.varies("camber"))
    ]
    slopes = data.tire.jacobian(
        keys,
        outputs=(name,),
        slip_angle=at["slip_angle"],
        slip_ratio=at["slip_ratio"],
        camber=at["camber"],
        normal_load=at["normal_load"],
    )[name]
    return np.asarray(slopes * np.array([c[key] for key in keys]))


def shifts(data: Data, name: str, at: At) -> Array:
    """Constant, load and slope: a fit would have found a shift of the curve even if the file has none."""
    slip = SLIP_OF_FORCE[name]
    h = ABSOLUTE_SPREAD[slip]
    up, down = (plain_forces(data.tire, **{**at, slip: at[slip] + s * h})[name] for s in (1.0, -1.0))
    load = at["normal_load"]
    return np.column_stack([np.full(load.size, data.nominal.load), load, up - down])


def _halves(data: Data, name: str, here: At, slopes: Array) -> Array:
    """Directions of the coefficients that keep the mirror symmetry, and those that break it, made smaller."""
    mirrored = {n: -a if n in ("slip_angle", "camber") else a for n, a in here.items()}
    image = jacobian(data, name, mirrored) * (1.0 if name == "fx" else -1.0)
    kept, broken = 0.5 * (slopes + image), 0.5 * (slopes - image)
    least = _LEAST_PART * np.sqrt(np.mean(slopes**2, axis=0))
    broken = broken[:, np.sqrt(np.mean(broken**2, axis=0)) > least]
    kept = kept[:, np.sqrt(np.mean(kept**2, axis=0)) > least]
    size = 1.0 if data.varies("normal_load") else ONE_LOAD
    return np.hstack([size * _orthonormal(kept), ASYMMETRY_SHARE * _orthonormal(broken)])


def _orthonormal(columns: Array) -> Array:
    """Return columns of RMS 1 that span what is well determined of the given ones.

    Those that do nothing here are not made larger: the coefficients of camber in a recording without camber
    would become a constant force.
    """
    n = columns.shape[0]
    size = np.sqrt(np.mean(columns**2, axis=0)) if columns.size else np.zeros(0)
    keep = size > DOES_NOTHING * max(float(size.max(initial=0.0)), 1e-30)
    if not keep.any():
        return np.zeros((n, 0))
    gram = (columns[:, keep] / size[keep]).T @ (columns[:, keep] / size[keep]) / n
    values, vectors = np.linalg.eigh(gram)
    good = values > 1e-6 * values.max()
    return (columns[:, keep] / size[keep]) @ (vectors[:, good] / np.sqrt(values[good]))
