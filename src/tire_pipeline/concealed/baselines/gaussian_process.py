"""Baseline: a Gaussian process on the residual. It improves the fit and names nothing."""

from __future__ import annotations

import warnings

import numpy as np
import pandas as pd
from scipy.optimize import minimize

from tire_pipeline.channels import INPUT_CHANNELS
from tire_pipeline.concealed.baselines.report import BaselineReport, fit_entry
from tire_pipeline.concealed.cases.clean_run import residual
from tire_pipeline.magic_formula import TireModel


def _search(objective, start, bounds):
    """Maximise the likelihood in at most 20 steps: enough here, and cheap."""
    found = minimize(objective, start, method="L-BFGS-B", jac=True, bounds=bounds, options={"maxiter": 20})
    return found.x, found.fun


def explain_gaussian_process(
    tire: TireModel, recording: pd.DataFrame, *, n_points: int = 200, seed: int = 0
) -> BaselineReport:
    """Regress the residual of both forces on all channels (Rasmussen and Williams, 2006).

    Parameters
    ----------
    tire : TireModel
    recording : pandas.DataFrame
    n_points : int
        Samples that the process is given, drawn at random.
    seed : int

    Returns
    -------
    BaselineReport
        Without effects; verdict "unexplained" where the residual could be reduced by a tenth.
    """
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    rng = np.random.default_rng(seed)
    left = residual(tire, recording)
    channels = [c for c in INPUT_CHANNELS if c in recording]
    x = recording[channels].to_numpy()
    middle, extent = x.mean(axis=0), x.std(axis=0) + 1e-9
    pick = rng.choice(len(x), size=min(n_points, len(x)), replace=False)
    z = (x[pick] - middle) / extent
    models, sizes = [], []
    for i in range(2):
        size = float(np.std(left[:, i])) or 1.0
        kernel = ConstantKernel(0.5, (1e-3, 1e2)) * RBF(
            np.full(len(channels), 2.0), (0.2, 1e3)
        ) + WhiteKernel(0.5, (1e-3, 10.0))
        process = GaussianProcessRegressor(kernel, optimizer=_search)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            models.append(process.fit(z, left[pick, i] / size))
        sizes.append(size)

    def correction(frame: pd.DataFrame) -> np.ndarray:
        at = (frame[channels].to_numpy() - middle) / extent
        return np.column_stack([m.predict(at) * s for m, s in zip(models, sizes, strict=True)])

    after = left - correction(recording)
    better = np.mean(after**2) < 0.9 * np.mean(left**2)
    verdict = "unexplained" if better else "agrees"
    return BaselineReport(tire, verdict, [], fit_entry(left, after), correction)
