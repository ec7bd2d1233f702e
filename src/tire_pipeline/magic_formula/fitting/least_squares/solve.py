"""One bounded least squares problem: an output over some coefficients at some points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy

from tire_pipeline.magic_formula.compiled import engine
from tire_pipeline.magic_formula.derivatives.jacobian import packed_jacobian
from tire_pipeline.magic_formula.fitting.setup.typical import Pull
from tire_pipeline.magic_formula.parameters.coefficients import INDEX

Bounds = tuple[np.ndarray, np.ndarray]
_STIFFNESS = {"fy": ("PKY1", "cornering_stiffness"), "fx": ("PKX1", "slip_stiffness")}
"""Output -> the level of its slip stiffness, and the output that is this stiffness."""
_SIGN_POINTS = 100
"""Points at which the sign of a slip stiffness is looked at."""
_WITHIN = 0.999
"""How near to its bounds a coefficient may start, over half of their range: on them it would not move."""


@dataclass(frozen=True)
class Problem:
    """One output over some coefficients at some points, and the pull towards typical tires."""

    vector: np.ndarray
    family: int
    output: str
    names: Sequence[str]
    points: list[np.ndarray]
    measured: np.ndarray
    pull: Pull

    def filled(self, values: np.ndarray) -> np.ndarray:
        """Return the packed coefficients with these values."""
        vector = self.vector.copy()
        vector[[INDEX[name] for name in self.names]] = values
        return vector

    def residuals(self, values: np.ndarray) -> np.ndarray:
        """Return model minus measurement."""
        vector = self.filled(values)[None, :]
        rows = [x[None, :] for x in self.points]
        return (
            engine.run(vector, self.family, rows, engine.NO_SIGNS, (self.output,), 0.0)[0, 0] - self.measured
        )

    def jacobian(self, values: np.ndarray) -> np.ndarray:
        """Return the residuals' derivatives, one column a coefficient."""
        found = packed_jacobian(self.filled(values), self.family, self.names, self.points, [self.output])
        return found[self.output].T

    def misfit(self, values: np.ndarray) -> float:
        """Return the RMS of the residuals."""
        return float(np.sqrt(np.mean(self.residuals(values) ** 2)))

    def left(self, values: np.ndarray) -> float:
        """Return the misfit, or infinity if the slip stiffness changes its sign over the points."""
        return np.inf if self._turns(values) else self.misfit(values)

    def _turns(self, values: np.ndarray) -> bool:
        """Whether the slip stiffness has another sign than its level at some of the points."""
        level, stiffness = _STIFFNESS.get(self.output, ("", ""))
        if level not in self.names:
            return False
        step = -(-self.measured.size // _SIGN_POINTS)
        rows = [x[None, ::step] for x in self.points]
        found = engine.run(
            self.filled(values)[None, :], self.family, rows, engine.NO_SIGNS, (stiffness,), 0.0
        )
        return bool((found * values[list(self.names).index(level)] <= 0.0).any())

    def drawn(self, strength: float | np.ndarray) -> Problem:
        """Return the same problem with another strength of the pull."""
        return replace(self, pull=self.pull.times(strength))

    def thinned(self, most: int) -> Problem:
        """Return the problem at a limited number of its points, spread over all of them."""
        step = -(-self.measured.size // most)
        if step <= 1:
            return self
        points = [np.ascontiguousarray(x[::step]) for x in self.points]
        return replace(self, points=points, measured=self.measured[::step])


def minimum(
    problem: Problem,
    bounds: Bounds,
    start: np.ndarray,
    *,
    loss: str = "linear",
    width: float = 1.0,
    steps: int = 60,
    tolerance: float = 1e-7,
) -> np.ndarray:
    """Return the values with the least sum over residuals and pull, from one start.

    Parameters
    ----------
    problem : Problem
    bounds : pair of ndarray
    start : ndarray
    loss : str
        A loss of :func:`scipy.optimize.least_squares` for the residuals; the pull is never robust.
    width : float
        Residual from which a robust loss counts less.
    steps : int
    tolerance : float

    Returns
    -------
    ndarray
    """
    low, high = bounds
    margin = 1e-6 * (high - low)
    rows = problem.measured.size

    def both(values: np.ndarray) -> np.ndarray:
        return np.append(problem.residuals(values), problem.pull.residuals(values))

    def slopes(values: np.ndarray) -> np.ndarray:
        return np.vstack([problem.jacobian(values), problem.pull.jacobian()])

    found = scipy.optimize.least_squares(
        both,
        np.clip(start, low + margin, high - margin),
        slopes,
        bounds=bounds,
        x_scale=np.maximum(np.abs(start), 0.05 * (high - low)),
        loss=_loss(loss, rows),
        f_scale=width,
        max_nfev=steps,
        ftol=tolerance,
        xtol=tolerance,
        gtol=1e-12,
    )
    return np.asarray(found.x)


def quick(
    problem: Problem, bounds: Bounds, start: np.ndarray, *, steps: int = 60, tolerance: float = 1e-7
) -> np.ndarray:
    """Return the values with the least squares of residuals and pull, from one start.

    Coefficients follow a sine between their bounds, so that a search without bounds serves (Levenberg and
    Marquardt's in MINPACK): a step costs a fifth of that of a search that knows bounds.

    Parameters
    ----------
    problem : Problem
    bounds : pair of ndarray
    start : ndarray
    steps : int
        Evaluations.
    tolerance : float

    Returns
    -------
    ndarray
    """
    low, high = bounds
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    most = 1e3 * float(np.abs(problem.measured).max())
    pulled = problem.pull.jacobian()

    def both(angles: np.ndarray) -> np.ndarray:
        values = middle + half * np.sin(angles)
        return _finite(np.append(problem.residuals(values), problem.pull.residuals(values)), most)

    def slopes(angles: np.ndarray) -> np.ndarray:
        found = np.vstack([problem.jacobian(middle + half * np.sin(angles)), pulled])
        found *= half * np.cos(angles)
        return _finite(found, 0.0)

    begin = np.arcsin(np.clip((start - middle) / half, -_WITHIN, _WITHIN))
    angles, *_ = scipy.optimize.leastsq(
        both,
        begin,
        Dfun=slopes,
        full_output=True,
        maxfev=steps,
        ftol=tolerance,
        xtol=tolerance,
        gtol=1e-8,
    )
    return np.asarray(middle + half * np.sin(angles))


def _finite(x: np.ndarray, instead: float) -> np.ndarray:
    """Replace NaN and infinite values of an array in place, and return it."""
    if not np.isfinite(x).all():
        np.nan_to_num(x, copy=False, nan=instead, posinf=instead, neginf=-instead)
    return x


def _loss(name: str, rows: int) -> Any:
    """Return SciPy's loss, for the first rows only."""
    if name == "linear":
        return name
    rule = _ROBUST[name]

    def loss(z: np.ndarray) -> np.ndarray:
        rho = np.vstack([z, np.ones_like(z), np.zeros_like(z)])
        rho[:, :rows] = rule(z[:rows])
        return rho

    return loss


def _soft_l1(z: np.ndarray) -> np.ndarray:
    t = 1.0 + z
    return np.stack([2.0 * (np.sqrt(t) - 1.0), t**-0.5, -0.5 * t**-1.5])


def _huber(z: np.ndarray) -> np.ndarray:
    far = z > 1.0
    safe = np.where(far, z, 1.0)
    return np.stack(
        [
            np.where(far, 2.0 * safe**0.5 - 1.0, z),
            np.where(far, safe**-0.5, 1.0),
            np.where(far, -0.5 * safe**-1.5, 0.0),
        ]
    )


def _cauchy(z: np.ndarray) -> np.ndarray:
    t = 1.0 + z
    return np.stack([np.log1p(z), 1.0 / t, -1.0 / t**2])


def _arctan(z: np.ndarray) -> np.ndarray:
    t = 1.0 + z**2
    return np.stack([np.arctan(z), 1.0 / t, -2.0 * z / t**2])


_ROBUST = {"soft_l1": _soft_l1, "huber": _huber, "cauchy": _cauchy, "arctan": _arctan}
