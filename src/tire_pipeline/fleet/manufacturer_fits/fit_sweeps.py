"""From sweeps to Magic Formula 5.2 coefficients, by a manufacturer's own fit."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.fleet.manufacturer_fits.formula import (
    FITTED_ALIGNING,
    FITTED_LATERAL,
    FITTED_LONGITUDINAL,
    FitPoints,
    LateralPart,
    lateral,
    longitudinal,
)
from tire_pipeline.fleet.manufacturer_fits.habits import Habit, fit_setup, nominal_loads
from tire_pipeline.fleet.rig.sweeps import Sweeps
from tire_pipeline.numerics.levenberg_marquardt import LeastSquares, solve
from tire_pipeline.progress import track

CHUNK = 48  # tires fitted together: keeps the derivatives in the processor's cache
FORCE_SCALE = 0.01  # residuals are counted in hundredths of the rated load
MOMENT_SCALE = 0.0006  # m: moments in these times the rated load


@dataclass(frozen=True)
class FitTask:
    """One batch of measurements of one manufacturer.

    Attributes
    ----------
    lateral, longitudinal : Sweeps
        n measurements each.
    rated_load, radius : ndarray, shape (n,)
        N, m.
    habit : Habit
    freeze_draw : ndarray, shape (n,)
        See :func:`.habits.fit_setup`.
    weight_twist : ndarray, shape (n,)
        Added to the habit's load power: another engineer's fit of the same data.
    """

    lateral: Sweeps
    longitudinal: Sweeps
    rated_load: np.ndarray
    radius: np.ndarray
    habit: Habit
    freeze_draw: np.ndarray
    weight_twist: np.ndarray

    def chunk(self, rows: slice) -> FitTask:
        """Return some of the measurements."""
        return FitTask(
            self.lateral.of_tires(rows),
            self.longitudinal.of_tires(rows),
            self.rated_load[rows],
            self.radius[rows],
            self.habit,
            self.freeze_draw[rows],
            self.weight_twist[rows],
        )


def fit_all(tasks: list[FitTask], threads: int) -> list[pd.DataFrame]:
    """Fit every task; the number of threads does not change the result.

    Parameters
    ----------
    tasks : list of FitTask
    threads : int

    Returns
    -------
    list of pandas.DataFrame
        For each task one row a measurement: the 58 coefficients and ``FNOMIN``.
    """
    chunks, owner = [], []
    for number, task in enumerate(tasks):
        for first in range(0, task.rated_load.size, CHUNK):
            chunks.append(task.chunk(slice(first, first + CHUNK)))
            owner.append(number)
    with ThreadPoolExecutor(threads) as pool:
        done = list(track(pool.map(fit_chunk, chunks), "fitting the fleet", total=len(chunks)))
    columns = [*FITTED_LATERAL, *FITTED_LONGITUDINAL, *FITTED_ALIGNING, "FNOMIN"]
    tables = []
    for number in range(len(tasks)):
        parts = [part for part, own in zip(done, owner, strict=True) if own == number]
        tables.append(pd.DataFrame(np.concatenate(parts), columns=columns))
    return tables


def fit_chunk(task: FitTask) -> np.ndarray:
    """Fit Fy, Fx, then Mz of a few measurements.

    Parameters
    ----------
    task : FitTask

    Returns
    -------
    ndarray, shape (n, 59)
        Coefficients in the order of ``FITTED_LATERAL + FITTED_LONGITUDINAL + FITTED_ALIGNING``, then F_z0.
    """
    nominal = nominal_loads(task.habit, task.rated_load)
    points_y = _points(task.lateral, nominal, task.radius)
    points_x = _points(task.longitudinal, nominal, task.radius)
    fy = _fit(
        task,
        FITTED_LATERAL,
        lambda p, rows: lateral(p, points_y.take(rows)),
        task.lateral,
        task.lateral.force,
        FORCE_SCALE,
    )
    fx = _fit(
        task,
        FITTED_LONGITUDINAL,
        lambda p, rows: longitudinal(p, points_x.take(rows)),
        task.longitudinal,
        task.longitudinal.force,
        FORCE_SCALE,
    )
    part = LateralPart(fy, points_y)
    assert task.lateral.moment is not None
    mz = _fit(
        task,
        FITTED_ALIGNING,
        lambda p, rows: part.take(rows).aligning(p, points_y.take(rows)),
        task.lateral,
        task.lateral.moment,
        MOMENT_SCALE,
    )
    return np.concatenate([fy, fx, mz, nominal[:, None]], axis=1)


def _points(sweeps: Sweeps, nominal: np.ndarray, radius: np.ndarray) -> FitPoints:
    return FitPoints(sweeps.slip, sweeps.camber, sweeps.normal_load, nominal[:, None], radius[:, None])


def _fit(
    task: FitTask, names: list[str], model, sweeps: Sweeps, target: np.ndarray, scale: float
) -> np.ndarray:
    setup = fit_setup(names, task.habit, task.freeze_draw)
    rated = task.rated_load[:, None]
    power = (task.habit.load_power + task.weight_twist)[:, None]
    weight = (sweeps.normal_load / rated) ** power
    weight = weight * (1.0 + task.habit.centre_weight * np.exp(-((sweeps.slip / 0.05) ** 2)))
    weight = weight / (scale * rated)

    def residuals(p: np.ndarray, rows: np.ndarray, slopes: bool) -> tuple[np.ndarray, np.ndarray]:
        value, jacobian = model(p, rows)
        jacobian *= weight[rows][:, None, :]
        return (value - target[rows]) * weight[rows], jacobian

    problem = LeastSquares(residuals, setup.start, setup.lower, setup.upper, setup.start, setup.stiffness)
    return solve(problem)[0]
