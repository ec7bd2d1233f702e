"""Joint refit: Gauss-Newton on the effects' own equations, coefficients and flexible form marginalised."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import Sums, System
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.candidates import Variant, derivatives
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
_DAMPINGS = (1e-6, 0.03, 0.3, 3.0, 30.0)
"""Levenberg-Marquardt: tried in turn until the objective falls."""


@dataclass
class Fit:
    """Effects with fitted parameters.

    Parameters
    ----------
    changes : list of (name, parameters)
    free : list of tuple of str
        Parameters of each effect that float.
    objective : float
        ``r' V^-1 r``.
    covariance : ndarray
        Of the floating parameters, in the order of ``labels``, for unit white noise.
    labels : list of (index of effect, parameter)
    columns : dict of ndarray, shape (n, k)
        Derivatives at the fit.
    sums : Sums
        Of the residual at the fit and these columns.
    """

    changes: list[Change]
    free: list[tuple[str, ...]]
    objective: float = np.inf
    covariance: Array = field(default_factory=lambda: np.zeros((0, 0)))
    labels: list[tuple[int, str]] = field(default_factory=list)
    columns: dict[str, Array] = field(default_factory=dict)
    sums: Sums | None = None
    at_bound: bool = False

    @property
    def names(self) -> list[str]:
        """Names of the effects."""
        return [name for name, _ in self.changes]

    @property
    def variants(self) -> list[Variant]:
        """Its effects as forms to refit, from where they are."""
        return [Variant(n, p, f) for (n, p), f in zip(self.changes, self.free, strict=True)]

    def others(self, *which: int) -> list[Change]:
        """Return its effects as they stand, without those of some numbers."""
        return [change for i, change in enumerate(self.changes) if i not in which]

    def judged_by(self, system: System) -> Fit:
        """Return the fit with the objective that another system gives to it."""
        return replace(self, objective=objective(system, self.changes))

    @property
    def parameters(self) -> int:
        """Number of parameters that float, discrete choices of a scan included."""
        return sum(len(f) for f in self.free) + sum(catalogue()[name].choices for name in self.names)


def objective(system: System, changes: Sequence[Change]) -> float:
    """Return ``r' V^-1 r`` of a set of effects with given parameters."""
    return system.reduce(system.sums(residual(system.data, changes)))[2]


def refit(
    system: System, variants: Sequence[Variant], *, steps: int = 5, start: Sequence[Change] | None = None
) -> Fit:
    """Fit the parameters of some effects together.

    Parameters
    ----------
    system : System
    variants : sequence of Variant
        The effects, each with its start and its floating parameters.
    steps : int
        Most Gauss-Newton steps.
    start : sequence of (name, parameters), optional
        Where to start instead.
    """
    changes: list[Change] = (
        [(v.name, dict(v.start)) for v in variants] if start is None else [(n, dict(p)) for n, p in start]
    )
    free = [tuple(v.free) for v in variants]
    best = objective(system, changes)
    for step in range(steps):
        changes, best, progress = _step(system, changes, free, best)
        moved = scan(system, changes, free, best, 50.0 if step == 0 else 800.0)
        if moved is not None:
            changes, gained = moved
            progress = max(progress, best - gained)
            best = gained
        if progress < 0.05 + 1e-4 * best:
            break
    return finish(system, changes, free, best)


def finish(system: System, changes: list[Change], free: list[tuple[str, ...]], best: float) -> Fit:
    """Linearise at the parameters reached: covariance, columns, sums."""
    labels, columns = columns_of(system.data, changes, free)
    sums = system.sums(residual(system.data, changes), columns)
    info, _, _ = system.reduce(sums)
    return Fit(
        changes=changes,
        free=free,
        objective=best,
        covariance=inverse(info),
        labels=labels,
        columns=columns,
        sums=sums,
        at_bound=_at_bound(system.data, changes, free),
    )


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


def _step(
    system: System, changes: list[Change], free: list[tuple[str, ...]], best: float
) -> tuple[list[Change], float, float]:
    """Make one Gauss-Newton step, damped until it helps (Marquardt 1963).

    Without the parameters that are scanned: the derivative by the moment of a change is a spike, which leads
    nowhere and takes all others along.
    """
    smooth = [
        tuple(p for p in names if p not in catalogue()[name].scanned)
        for (name, _), names in zip(changes, free, strict=True)
    ]
    labels, columns = columns_of(system.data, changes, smooth)
    if not labels:
        return changes, best, 0.0
    info, score, _ = system.reduce(system.sums(residual(system.data, changes), columns))
    size = np.sqrt(np.maximum(np.diag(info), 1e-300))
    scaled, aim = info / size[:, None] / size[None, :], score / size
    for damping in _DAMPINGS:
        delta = np.linalg.solve(scaled + damping * np.eye(size.size), aim) / size
        trial = moved(changes, labels, delta)
        value = objective(system, trial)
        if value < best:
            return trial, value, best - value
    return changes, best, 0.0


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


def scan(
    system: System, changes: list[Change], free: list[tuple[str, ...]], best: float, part: float
) -> tuple[list[Change], float] | None:
    """Search along parameters whose effect is too far from linear: moments at which the force jumps."""
    found = None
    moments = [
        (i, name)
        for i, (effect, _) in enumerate(changes)
        for name in catalogue()[effect].stepped
        if name in free[i]
    ]
    for i, name in moments:
        values, time = changes[i][1], system.data.time
        assert time is not None  # the effect needs a time line
        width = max((time[-1] - time[0]) / part, 0.11)
        while width > 0.05:
            for sign in (1.0, -1.0):
                trial: list[Any] = [(n, dict(p)) for n, p in changes]
                trial[i][1][name] = float(np.clip(values[name] + sign * width, time[0], time[-1]))
                value = objective(system, trial)
                if value < best:
                    changes, best, values = trial, value, trial[i][1]
                    found = (changes, best)
                    break
            width *= 0.5
    return found


def inverse(info: Array, rcond: float = 1e-10) -> Array:
    """Pseudo-inverse of an information matrix, scaled; directions below ``rcond`` are left out."""
    if info.size == 0:
        return np.zeros((0, 0))
    size = np.sqrt(np.maximum(np.diag(info), 1e-300))
    scaled = info / size[:, None] / size[None, :]
    return np.linalg.pinv(scaled, rcond=rcond, hermitian=True) / size[:, None] / size[None, :]


def _at_bound(data: Data, changes: list[Change], free: list[tuple[str, ...]]) -> bool:
    for (name, values), names in zip(changes, free, strict=True):
        if catalogue()[name].outside(data, values):
            return True
        for p in catalogue()[name].parameters:
            if p.name not in names or p.open_ended:
                continue
            if p.low == p.zero:
                reached = values[p.name] >= p.high
            else:
                reached = values[p.name] <= p.low or values[p.name] >= p.high
            if values[p.name] != p.zero and reached:
                return True
    return False
