"""Baseline: the whole formula refitted to the recording. It names nothing."""

from __future__ import annotations

import warnings

import numpy as np
import pandas as pd

from tire_pipeline.channels import FORCE_OF_SLIP
from tire_pipeline.concealed.baselines.report import BaselineReport, fit_entry
from tire_pipeline.concealed.cases.clean_run import model_forces, residual
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.fitting import PoorFitWarning, fit_magic_formula

MOST_FITTED_ROWS = 2000
_LEAST_RANGES = {"camber": 0.01, "slip_ratio": 0.02, "pressure": 5e3}


def explain_by_refit(tire: TireModel, recording: pd.DataFrame) -> BaselineReport:
    """Fit all coefficients to what was recorded, artefacts and all.

    Parameters
    ----------
    tire : TireModel
    recording : pandas.DataFrame

    Returns
    -------
    BaselineReport
        Without effects; verdict "unexplained" where the fit leaves less than the model.
    """
    rows = recording.iloc[:: max(len(recording) // MOST_FITTED_ROWS, 1)]
    moving = [c for c, least in _LEAST_RANGES.items() if c in rows and np.ptp(rows[c]) > least]
    forces = [force for slip, force in FORCE_OF_SLIP.items() if slip == "slip_angle" or slip in moving]
    version = "6.1" if "pressure" in moving else "5.2"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PoorFitWarning)  # how poor it is, is what the baseline is there for
        fitted = fit_magic_formula(rows[["slip_angle", "normal_load", *moving, *forces]], version).model

    def correction(frame: pd.DataFrame) -> np.ndarray:
        return model_forces(fitted, frame) - model_forces(tire, frame)

    left = residual(tire, recording)
    after = left - correction(recording)
    better = np.mean(after**2) < 0.9 * np.mean(left**2)
    return BaselineReport(tire, "unexplained" if better else "agrees", [], fit_entry(left, after), correction)
