"""How sure a name is: a logistic map of its evidence, fitted on tuning cases."""

from __future__ import annotations

import json
from functools import cache
from importlib import resources
from typing import Any

import numpy as np


@cache
def calibration() -> dict[str, Any]:
    """Return the constants of the map and how they were got (``calibration.json``)."""
    text = resources.files("tire_pipeline.mismatch").joinpath("calibration.json").read_text(encoding="utf-8")
    return json.loads(text)


def features(search: Any, index: int, near: list[Any], left: Any) -> dict[str, float]:
    """Return the evidence for one accepted effect as numbers.

    Parameters
    ----------
    search : Search
    index : int
        Of the effect in the accepted set.
    near : list of Rival
    left : Remainder
    """
    gate = search.gates[index]
    lost = min([r.lost for r in near], default=200.0)
    return {
        "log_gain": float(np.log(max(gate.gain, 1.0))),
        "log_lost": float(np.log(np.clip(lost, 1.0, 1e4))),
        "log_left": float(np.log(max(left.statistic, 1.0))),
        "log_share": float(np.log(np.clip(gate.share, 1e-3, 1.0))),
        "others": float(len(search.fit.names) - 1),
    }


def confidence(search: Any, index: int, near: list[Any], left: Any) -> float:
    """Return the probability that the name is right."""
    table = calibration()
    x = features(search, index, near, left)
    z = table["intercept"] + sum(table["weights"][k] * v for k, v in x.items())
    return float(np.clip(1.0 / (1.0 + np.exp(-z)), table["least"], table["most"]))
