"""Baseline: forward selection of effects by plain BIC on linearised residuals.

No guards: samples count as independent, the model's misfit counts as something to be explained.
"""

from __future__ import annotations

from dataclasses import dataclass

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


@dataclass(frozen=True)
class EffectColumns:
    """What each effect adds by one unit, in scaled columns next to each other, and their products.

    Attributes
    ----------
    of_effect : dict of str to list of int
        The columns of each effect.
    scale : ndarray, shape (p,)
        What the columns were divided by.
    gram : ndarray, shape (p, p)
    moment : ndarray, shape (p,)
        With what is to be explained.
    total : float
        Sum of squares of what is to be explained.
    count : int
        Its samples.
    """

    of_effect: dict[str, list[int]]
    scale: np.ndarray
    gram: np.ndarray
    moment: np.ndarray
    total: float
    count: int

    @classmethod
    def of(cls, groups: dict[str, np.ndarray], left: np.ndarray) -> EffectColumns:
        """Put the columns of all effects next to each other."""
        names = list(groups)
        wide = np.concatenate([groups[n] for n in names], axis=2).reshape(left.size, -1)
        scale = np.linalg.norm(wide, axis=0) + 1e-300
        design = wide / scale
        ends = np.cumsum([groups[n].shape[2] for n in names])
        columns = {n: list(range(e - groups[n].shape[2], e)) for n, e in zip(names, ends, strict=True)}
        gram, moment = design.T @ design, design.T @ left.ravel()
        return cls(columns, scale, gram, moment, float(left.ravel() @ left.ravel()), left.size)

    def fit(self, chosen: list[str]) -> tuple[float, np.ndarray, list[int]]:
        """Return the BIC of a set of effects, its coefficients and their columns."""
        at = [c for name in chosen for c in self.of_effect[name]]
        if not at:
            return self.count * np.log(self.total / self.count), np.zeros(0), at
        beta = np.linalg.lstsq(self.gram[np.ix_(at, at)], self.moment[at], rcond=1e-10)[0]
        rss = max(self.total - float(self.moment[at] @ beta), 1e-12 * self.total)
        return self.count * np.log(rss / self.count) + len(at) * np.log(self.count), beta, at

    def forward(self, max_effects: int) -> tuple[list[str], list[float]]:
        """Add the effect that lowers BIC most until none does: names, and by how much each lowered it."""
        chosen: list[str] = []
        gains: list[float] = []
        best = self.fit(chosen)[0]
        while len(chosen) < max_effects:
            trials = {name: self.fit([*chosen, name])[0] for name in self.of_effect if name not in chosen}
            name = min(trials, key=lambda k: trials[k])
            if trials[name] >= best:
                break
            gains.append(best - trials[name])
            chosen.append(name)
            best = trials[name]
        return chosen, gains


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
    columns = EffectColumns.of(groups, left)
    chosen, gains = columns.forward(max_effects)
    _, beta, at = columns.fit(chosen)
    weights = dict(zip(at, beta / columns.scale[at], strict=True))

    span = None
    if "time" in recording:
        span = (float(recording["time"].iloc[0]), float(recording["time"].iloc[-1]))

    def part(name: str, table: dict[str, np.ndarray]) -> np.ndarray:
        return table[name] @ np.array([weights[c] for c in columns.of_effect[name]])

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
