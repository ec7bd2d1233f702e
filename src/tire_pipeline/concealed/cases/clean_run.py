"""The clean run that the ``.tir`` of a case is fitted to, and the residual against it."""

from __future__ import annotations

import warnings

import numpy as np
import pandas as pd

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.concealed.brush_rig.recorded_run import RIG_FORCES, BrushRig
from tire_pipeline.concealed.brush_rig.schedule import CHANNELS, CasePlan
from tire_pipeline.magic_formula import DegreesWarning, PoorFitWarning, TireModel
from tire_pipeline.magic_formula.fitting import fit_magic_formula


def clean_schedule(rig: BrushRig, plan: CasePlan) -> pd.DataFrame:
    """Points of a clean run: pure slip, camber and combined slip at nominal speed and pressure.

    The loads and angles span those of the recording.

    Returns
    -------
    pandas.DataFrame
        ``time`` and the tire's inputs, one row a steady point.
    """
    alpha = plan.amplitude * np.linspace(-1.05, 1.05, 41)
    kappa = np.linspace(-0.21, 0.21, 31)
    loads = plan.nominal_load * np.linspace(0.3, 1.65, 5)
    camber = max(plan.cambers) * np.array([-1.0, -0.5, 0.5, 1.0])
    points = []
    for load in loads:
        points += [(a, 0.0, 0.0, load) for a in alpha]
        points += [(0.0, k, 0.0, load) for k in kappa if k != 0.0]
        points += [(a, 0.0, g, load) for g in camber for a in alpha[::2]]
        sides = (-0.1, -0.05, 0.03, 0.06)
        points += [(a, k, 0.0, load) for a in sides for k in kappa[::2] if k != 0.0]
    frame = pd.DataFrame(points, columns=list(SLIP_AND_LOAD))
    frame["speed"], frame["pressure"], frame["turn_slip"] = plan.speed, plan.pressure, 0.0
    frame.insert(0, "time", np.arange(len(frame)) * 0.02)
    return frame[["time", *CHANNELS]]


def fit_clean(
    rig: BrushRig, plan: CasePlan, *, noise: float, rng: np.random.Generator
) -> tuple[TireModel, float]:
    """Fit MF 5.2 to a clean run: no effect, steady, new tire at its reference temperature.

    Parameters
    ----------
    rig : BrushRig
    plan : CasePlan
    noise : float
        Standard deviation of the noise on the clean run's forces, N.
    rng : numpy.random.Generator

    Returns
    -------
    tire : TireModel
    misfit : float
        RMS of what the fit leaves of the clean run, N.
    """
    frame = rig.run(clean_schedule(rig, plan), {})
    frame = frame[[*SLIP_AND_LOAD, *RIG_FORCES]].copy()
    for force in RIG_FORCES:
        frame[force] += noise * rng.standard_normal(len(frame))
    with warnings.catch_warnings():
        # the rig turns the sign of its slip angle, not that of its camber: a mirrored tire
        warnings.filterwarnings("ignore", ".*to which the wheel leans", PoorFitWarning)
        fitted = fit_magic_formula(
            frame,
            "5.2",
            nominal_load=plan.nominal_load,
            unloaded_radius=round(rig.constants.radius, 4),
            starts=2,
            loss="linear",
            together=False,  # a seed keeps its case
        )
    tire = fitted.model.replace(LONGVL=plan.speed)
    return tire, rms(residual(tire, frame))


def model_forces(tire: TireModel, frame: pd.DataFrame) -> np.ndarray:
    """Forces that the model gives at the frame's inputs, shape (n, 2): fx, fy in N.

    Slip ratio and camber are 0 where they were not recorded; pressure matters to MF 6.x only.
    """
    channels = list(SLIP_AND_LOAD)
    if tire.version.startswith("6"):
        channels.append("pressure")
    inputs = {channel: frame[channel].to_numpy() for channel in channels if channel in frame}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DegreesWarning)
        got = tire.forces(**inputs, limits="ignore", outputs=RIG_FORCES)
    return np.column_stack([got.fx, got.fy])


def residual(tire: TireModel, frame: pd.DataFrame) -> np.ndarray:
    """Recorded less modelled force, shape (n, 2), N."""
    return frame[list(RIG_FORCES)].to_numpy() - model_forces(tire, frame)


def rms(values: np.ndarray) -> float:
    """Root of the mean over samples of the squared force, all components of a sample together.

    Parameters
    ----------
    values : ndarray, shape (n,) or (n, components)
    """
    squared = np.asarray(values, dtype=float) ** 2
    return float(np.sqrt(np.mean(squared if squared.ndim == 1 else squared.sum(axis=-1))))
