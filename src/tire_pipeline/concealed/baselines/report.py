"""The form in which a baseline answers: that of ``explain_mismatch``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import TANGENTIAL_FORCES
from tire_pipeline.concealed.cases.clean_run import model_forces, rms
from tire_pipeline.concealed.cases.windows_and_regimes import regimes, windows
from tire_pipeline.concealed.effect_names import PHYSICS
from tire_pipeline.magic_formula import TireModel


@dataclass(frozen=True)
class BaselineReport:
    """Names, confidence and a corrected model.

    Attributes
    ----------
    verdict : str
    effects : list of dict
        As in ``explain_mismatch``'s report.
    correction : callable
        Recording -> what to add to the model's fx and fy, shape (n, 2), N.
    """

    tire: TireModel
    verdict: str
    effects: list[dict[str, Any]]
    fit: Mapping[str, Mapping[str, float]]
    correction: Callable[[pd.DataFrame], np.ndarray] = field(repr=False)

    def predict(self, recording: pd.DataFrame) -> pd.DataFrame:
        """Return fx and fy, N, of the corrected model."""
        forces = model_forces(self.tire, recording) + self.correction(recording)
        return pd.DataFrame(forces, columns=list(TANGENTIAL_FORCES), index=recording.index)

    def to_dict(self) -> dict[str, Any]:
        """Return the report as plain JSON types."""
        return {
            "verdict": self.verdict,
            "effects": self.effects,
            "fit": {k: dict(v) for k, v in self.fit.items()},
            "next_experiment": None,
        }


def with_all_inputs(tire: TireModel, frame: pd.DataFrame) -> pd.DataFrame:
    """Return a run with the channels that the regressions go by, where real recordings lack them.

    Slip ratio and camber are 0 then, speed the tire's own, and Fx is what the model gives.
    """
    speed = tire.value("LONGVL") or 1.0
    plain = {"slip_ratio": 0.0, "camber": 0.0, "speed": speed}
    out = frame.assign(**{name: value for name, value in plain.items() if name not in frame})
    if "fy" in out and "fx" not in out:
        out["fx"] = model_forces(tire, out)[:, 0]
    return out


def effect_entry(
    name: str, contribution: np.ndarray, recording: pd.DataFrame, noise: float, confidence: float
) -> dict[str, Any]:
    """Return one effect of a report from what it adds to fx and fy, shape (n, 2), N."""
    output = int(np.argmax(np.mean(contribution**2, axis=0)))
    part = contribution[:, output]
    when = windows(part, recording["time"].to_numpy(), noise) if "time" in recording else ()
    return {
        "name": name,
        "kind": "physics" if name in PHYSICS else "artefact",
        "alternatives": [],
        "confidence": float(confidence),
        "output": TANGENTIAL_FORCES[output],
        "where": {k: list(v) for k, v in regimes(part, recording).items()},
        "when": [list(pair) for pair in when],
        "share": None,
        "equation": "",
        "parameters": {},
    }


def noise_floor(residual: np.ndarray) -> np.ndarray:
    """Noise of each force from second differences, shape (2,), N (white noise assumed)."""
    return np.sqrt(np.mean(np.diff(residual, n=2, axis=0) ** 2, axis=0) / 6.0)


def fit_entry(before: np.ndarray, after: np.ndarray) -> dict[str, dict[str, float]]:
    """Return the report's ``fit`` from residuals of shape (n, 2), N."""
    floor = noise_floor(before)
    out = {}
    for i, force in enumerate(TANGENTIAL_FORCES):
        first, last = rms(before[:, i]), rms(after[:, i])
        room = first**2 - floor[i] ** 2
        share = (first**2 - last**2) / room if room > 0 else 0.0
        out[force] = {
            "noise_floor": float(floor[i]),
            "rms_before": first,
            "rms_after": last,
            "share_recoverable": float(share),
        }
    return out
