"""Baseline: forward selection of effects by plain BIC on linearised residuals.

No guards: samples count as independent, the model's misfit counts as something to be explained.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.concealed.baselines.regressors import make_groups
from tire_pipeline.concealed.baselines.report import (
    BaselineReport,
    effect_entry,
    fit_entry,
    noise_floor,
)
from tire_pipeline.concealed.cases.clean_run import residual
from tire_pipeline.magic_formula import TireModel


def explain_bic_stepwise(tire: TireModel, recording: pd.DataFrame, *, max_effects: int = 6) -> BaselineReport:
    """Add the effect that lowers BIC most until none lowers it (Schwarz, 1978).

    Parameters
    ----------
    tire : TireModel
    recording : pandas.DataFrame
        Canonical channels.
    max_effects : int

    Returns
    -------
    BaselineReport
    """
    left = residual(tire, recording)
    groups = make_groups(tire, recording)
    names = list(groups)
    wide = np.concatenate([groups[n] for n in names], axis=2).reshape(left.size, -1)
    size = np.linalg.norm(wide, axis=0) + 1e-300
    design = wide / size
    ends = np.cumsum([groups[n].shape[2] for n in names])
    columns = {n: list(range(e - groups[n].shape[2], e)) for n, e in zip(names, ends, strict=True)}
    gram, moment = design.T @ design, design.T @ left.ravel()
    total, n = float(left.ravel() @ left.ravel()), left.size

    def bic(chosen: list[str]) -> tuple[float, np.ndarray, list[int]]:
        at = [c for name in chosen for c in columns[name]]
        if not at:
            return n * np.log(total / n), np.zeros(0), at
        beta = np.linalg.lstsq(gram[np.ix_(at, at)], moment[at], rcond=1e-10)[0]
        rss = max(total - float(moment[at] @ beta), 1e-12 * total)
        return n * np.log(rss / n) + len(at) * np.log(n), beta, at

    chosen: list[str] = []
    gains: list[float] = []
    best = bic(chosen)[0]
    while len(chosen) < max_effects:
        trials = {name: bic([*chosen, name])[0] for name in names if name not in chosen}
        name = min(trials, key=lambda k: trials[k])
        if trials[name] >= best:
            break
        gains.append(best - trials[name])
        chosen.append(name)
        best = trials[name]
    _, beta, at = bic(chosen)
    weights = dict(zip(at, beta / size[at], strict=True))

    span = None
    if "time" in recording:
        span = (float(recording["time"].iloc[0]), float(recording["time"].iloc[-1]))

    def part(name: str, table: dict[str, np.ndarray]) -> np.ndarray:
        return table[name] @ np.array([weights[c] for c in columns[name]])

    def correction(frame: pd.DataFrame) -> np.ndarray:
        table = make_groups(tire, frame, span)
        return sum((part(c, table) for c in chosen if c in table), np.zeros((len(frame), 2)))

    noise = float(noise_floor(left).max())
    effects = [
        effect_entry(c, part(c, groups), recording, noise, 1.0 / (1.0 + np.exp(-0.5 * min(g, 700))))
        for c, g in zip(chosen, gains, strict=True)
    ]
    fit = fit_entry(left, left - correction(recording))
    return BaselineReport(tire, "explained" if chosen else "agrees", effects, fit, correction)
