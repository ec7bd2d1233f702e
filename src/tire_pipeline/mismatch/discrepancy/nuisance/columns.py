"""Errors that remain when no effect is missing: of the coefficients, and of the formula's shape.

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

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.mismatch.discrepancy.nuisance.coefficients import directions, jacobian, shifts
from tire_pipeline.mismatch.discrepancy.nuisance.flexible import flexible_form
from tire_pipeline.mismatch.discrepancy.nuisance.transients import fast_load, memory
from tire_pipeline.mismatch.model.channels import CLASSES, DOES_NOTHING, OUTLIERS, largest, least_spread, span
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray
_OF_OTHER_FORCE = 0.3
"""A force near zero is measured by this part of the other one."""
_ACROSS = 5
"""Loads, slip angles and cambers at which another input is swept."""


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
    left there may still look like a change of coefficients here. An input that does not vary stands still on
    both: two coefficients that act alike at one load would cancel there and not here.

    Parameters
    ----------
    data : Data
    """
    grid = _grid(data)
    parts: tuple[dict[str, Array], ...] = ({}, {}, {}, {}, {})
    for name in data.outputs:
        size = largest_force(data, name)
        here = {n: data.get(n) for n in SLIP_AND_LOAD}
        flexible, path = _misfit(data, name, grid)
        own = (directions(data, name, here) * size, flexible * size, path * size)
        for part, columns in zip(parts, (*own, memory(data, name), fast_load(data, name)), strict=True):
            part[name] = columns
    return Nuisance(*parts)


def _misfit(data: Data, name: str, grid: dict[str, Array]) -> tuple[Array, Array]:
    """Return the flexible form without what the coefficients can do on the grid, and its part for the way.

    A direction in which coefficients change by as much as they are, and do next to nothing, is none that a
    fit would use.
    """
    here = {n: data.get(n) if data.varies(n) else _still(data, n) for n in SLIP_AND_LOAD}
    b, b_grid, ways = flexible_form(data, name, here, grid)
    c = np.hstack([jacobian(data, name, here), shifts(data, name, here)])
    c_grid = np.hstack([jacobian(data, name, grid), shifts(data, name, grid)])
    return b - c @ np.linalg.lstsq(c_grid, b_grid, rcond=DOES_NOTHING)[0], ways


def largest_force(data: Data, name: str) -> float:
    """Return the largest simulated force (99.5% quantile), N.

    If this force is near zero, a fraction of the other one.
    """
    sizes = {n: float(np.quantile(np.abs(data.simulation.base[n]), 1.0 - OUTLIERS)) for n in data.outputs}
    return max(sizes[name], _OF_OTHER_FORCE * max(*sizes.values(), 1e-09))


def _grid(data: Data) -> dict[str, Array]:
    """Even points over the recorded ranges: pure slip, slip with camber, combined slip, at several loads."""
    low, high = span(data.get("normal_load"))
    loads = np.linspace(low, high, _ACROSS) if data.varies("normal_load") else [_at_rest(data, "normal_load")]
    a, k = (_range(data, n, 2 * CLASSES + 1) for n in ("slip_angle", "slip_ratio"))
    turned, rolled, lean = (_at_rest(data, n) for n in ("slip_angle", "slip_ratio", "camber"))
    rows = [(x, rolled, lean, f) for f in loads for x in a]
    rows += [(turned, x, lean, f) for f in loads for x in k]
    if data.varies("camber") and data.nominal.knows_camber:
        leans = _sides(data, "camber")
        rows += [(x, rolled, g, f) for f in loads for g in leans for x in a[::2]]
        rows += [(turned, x, g, f) for f in loads for g in leans for x in k[::2]]
    if data.has_combined:
        rows += [(s, x, lean, f) for f in loads for s in _sides(data, "slip_angle") for x in k[::2]]
    points = np.array(rows)
    return dict(zip(SLIP_AND_LOAD, points.T, strict=True))


def _range(data: Data, name: str, count: int) -> Array:
    if not data.varies(name):
        return np.array([_at_rest(data, name)])
    top = largest(data.get(name))
    return np.linspace(-top, top, count)


def _sides(data: Data, name: str) -> Array:
    """Return values of an input to both sides of zero; the one at which it stands if it does not vary."""
    values = _range(data, name, _ACROSS)
    return values[values != 0.0] if values.size > 1 else values


def _still(data: Data, name: str) -> Array:
    return np.full(data.size, _at_rest(data, name))


def _at_rest(data: Data, name: str) -> float:
    """Return where an input is while another one is swept: at zero, or where it stands still.

    One that is no farther from zero than it has to move to count as moving is at zero: noise, or a wheel that
    rolls freely.
    """
    if data.varies(name):
        return 0.0
    there = float(np.median(data.get(name)))
    return there if abs(there) > least_spread(name, data.get(name)) else 0.0
