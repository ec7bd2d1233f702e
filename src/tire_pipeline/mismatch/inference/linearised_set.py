"""A set of effects with its parameters: what it is linearised to, and how it moves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.priors import prior
from tire_pipeline.mismatch.inference.tails import widening
from tire_pipeline.mismatch.model.candidates import derivatives
from tire_pipeline.mismatch.model.channels import OF_INTERVAL
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
LOCKED = frozenset({"moment", "radius"})
"""Parameters that one sweep determines: no linear step moves them."""


@dataclass(frozen=True)
class BySweep:
    """Information of each sweep and of the priors about the parameters, in the order of a fit's labels.

    Parameters
    ----------
    information : ndarray, shape (s, k, k)
    score : ndarray, shape (s, k)
    precision, pull : ndarray, shape (k,)
        Of the priors: one over their variances, and what they add to the score.
    """

    information: Array
    score: Array
    precision: Array
    pull: Array

    def step(self, kept: Array, free: Array) -> Array:
        """Return the step to the likeliest parameters by some sweeps.

        Parameters
        ----------
        kept : ndarray of bool, shape (s,)
        free : ndarray of bool, shape (k,)
            Parameters that move.
        """
        inner = self.information[kept].sum(axis=0) + np.diag(self.precision)
        aim = self.score[kept].sum(axis=0) + self.pull
        delta = np.zeros(free.size)
        if free.any():
            delta[free] = np.linalg.solve(inner[np.ix_(free, free)], aim[free])
        return delta


@dataclass(frozen=True)
class Fit:
    """Effects with fitted parameters.

    Parameters
    ----------
    changes : list of (name, parameters)
    free : list of tuple of str
        Parameters of each effect that float.
    covariance : ndarray
        Of the floating parameters, in the order of ``labels``, in their units.
    labels : list of (index of effect, parameter)
    columns : dict of ndarray, shape (n, k)
        Derivatives at the fit.
    weight : dict of float
        What a squared newton of each output counts for, by the likelihood.
    prior : float
        How many times as wide the priors are as the effects state them.
    sweeps : BySweep
    """

    changes: list[Change]
    free: list[tuple[str, ...]]
    covariance: Array = field(default_factory=lambda: np.zeros((0, 0)))
    labels: list[tuple[int, str]] = field(default_factory=list)
    columns: dict[str, Array] = field(default_factory=dict)
    weight: Mapping[str, float] = field(default_factory=dict)
    prior: float = 1.0
    sweeps: BySweep | None = None

    @property
    def names(self) -> list[str]:
        """Names of the effects."""
        return [name for name, _ in self.changes]

    def part(self, kept: Sequence[int], system: System) -> Fit:
        """Return some of its effects, by number, as they stand."""
        rows = [k for k, (i, _) in enumerate(self.labels) if i in kept]
        covariance = self.covariance[np.ix_(rows, rows)]
        changes, free = [self.changes[i] for i in kept], [self.free[i] for i in kept]
        return linearised(system, changes, free, covariance, self.weight, self.prior)

    @property
    def errors(self) -> Array:
        """Standard errors of the floating parameters, in the order of ``labels``."""
        return np.sqrt(np.maximum(np.diag(self.covariance), 0.0))

    @property
    def intervals(self) -> Array:
        """95% intervals of the floating parameters, within bounds, shape (k, 2), in the order of ``labels``.

        What moves by factors has an interval that is even in its logarithm.
        """
        out = np.zeros((len(self.labels), 2))
        for row, ((i, name), error) in enumerate(zip(self.labels, self.errors, strict=True)):
            value, p = self.changes[i][1][name], catalogue()[self.changes[i][0]].parameter(name)
            each_way = OF_INTERVAL * error * np.array([-1.0, 1.0])
            if p.ratio:
                whole = np.log(p.high / p.low)
                ends = value * np.exp(np.clip(each_way / max(value, p.low), -whole, whole))
            else:
                ends = value + each_way
            out[row] = np.clip(ends, min(p.low, value), max(p.high, value))
        return out

    @property
    def undetermined(self) -> Array:
        """Whether the priors determine a floating parameter more than the recording does, shape (k,)."""
        if self.sweeps is None:
            return np.zeros(len(self.labels), bool)
        return np.asarray(self.errors**2 * self.sweeps.precision > 0.5)


def linearised(
    system: System,
    changes: Sequence[Change],
    free: Sequence[tuple[str, ...]],
    covariance: Array,
    weight: Mapping[str, float],
    learnt_prior: float,
) -> Fit:
    """Return a set at its parameters, with columns and with each sweep's information about them."""
    data, rest = system.data, residual(system.data, changes)
    labels, columns = columns_of(data, list(changes), list(free))
    off, wide = prior(data, changes, labels)
    wide = wide * learnt_prior
    wide = wide * widening(off / wide)
    count, k = system.count, len(labels)
    information, score = np.zeros((count, k, k)), np.zeros((count, k))
    for o, x in columns.items():
        for number in range(count):
            rows = system.block == number
            information[number] += weight[o] * x[rows].T @ x[rows]
            score[number] += weight[o] * x[rows].T @ rest[o][rows]
    sweeps = BySweep(information, score, 1.0 / wide**2, -off / wide**2)
    return Fit(list(changes), list(free), covariance, labels, columns, weight, learnt_prior, sweeps)


def columns_of(
    data: Data, changes: list[Change], free: list[tuple[str, ...]]
) -> tuple[list[tuple[int, str]], dict[str, Array]]:
    """Return (index of effect, parameter) and d force / d parameter, shape (n, k), of all that float."""
    labels: list[tuple[int, str]] = []
    parts: list[dict[str, Array]] = []
    here = simulate(data, changes)
    for i in range(len(changes)):
        for name, column in derivatives(data, changes, i, free[i], here):
            labels.append((i, name))
            parts.append(column)
    if not parts:
        return [], {o: np.zeros((data.size, 0)) for o in data.outputs}
    return labels, {o: np.column_stack([p[o] for p in parts]) for o in data.outputs}


def moved(changes: Sequence[Change], labels: Sequence[tuple[int, str]], delta: Array) -> list[Change]:
    """Return effects with some parameters, named by ``labels``, moved, within bounds."""
    out: list[Any] = [(n, dict(p)) for n, p in changes]
    for (i, name), d in zip(labels, delta, strict=True):
        parameter = catalogue()[out[i][0]].parameter(name)
        values = out[i][1]
        width = parameter.high - parameter.low
        if parameter.ratio:
            there = values[name] * np.exp(np.clip(d / max(values[name], parameter.low), -1.0, 1.0))
        else:
            there = values[name] + np.clip(d, -width, width)
        values[name] = float(np.clip(there, parameter.low, parameter.high))
    return out


def inverse(info: Array, rcond: float = 1e-10) -> Array:
    """Pseudo-inverse of an information matrix, scaled; directions below ``rcond`` are left out."""
    if info.size == 0:
        return np.zeros((0, 0))
    size = np.sqrt(np.maximum(np.diag(info), 1e-300))
    scaled = info / size[:, None] / size[None, :]
    return np.linalg.pinv(scaled, rcond=rcond, hermitian=True) / size[:, None] / size[None, :]
