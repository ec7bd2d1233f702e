"""How sure a name is: a logistic map of its evidence, fitted on tuning cases."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources
from typing import Any

import numpy as np


@cache
def calibration() -> dict[str, Any]:
    """Return the constants of the map and how they were got (``calibration.json``)."""
    text = (
        resources.files("tire_pipeline.mismatch.proof")
        .joinpath("calibration.json")
        .read_text(encoding="utf-8")
    )
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
        "log_doubt": float(np.log(np.clip(search.doubts[index].part, 1e-3, 10.0))),
        "others": float(len(search.fit.names) - 1),
    }


def calibrate(rows: Sequence[Mapping[str, float]], correct: Sequence[bool], how: str) -> dict[str, Any]:
    """Fit the map to named effects of tuning cases: a logistic regression (C = 0.2).

    Parameters
    ----------
    rows : sequence of mapping
        :func:`features` of each named effect.
    correct : sequence of bool
        Whether the name was right, or of the set that the case makes indistinguishable from it.
    how : str
        Which cases.
    """
    from sklearn.linear_model import LogisticRegression  # slow to import

    names = list(rows[0])
    x = np.array([[row[n] for n in names] for row in rows])
    model = LogisticRegression(C=0.2, max_iter=2000).fit(x, np.asarray(correct, bool))
    weights = {n: round(float(w), 4) for n, w in zip(names, model.coef_[0], strict=True)}
    said = f"logistic regression (scikit-learn, C = 0.2) on {len(rows)} named effects of {how}"
    return {
        "how": f"{said}, {np.mean(correct):.3f} of them right",
        "intercept": round(float(model.intercept_[0]), 4),
        "weights": weights,
        "least": 0.3,
        "most": 0.98,
    }


def confidence(search: Any, index: int, near: list[Any], left: Any) -> float:
    """Return the probability that the cause is the name or one of its alternatives, by the fitted map."""
    table = calibration()
    x = features(search, index, near, left)
    z = table["intercept"] + sum(w * x[k] for k, w in table["weights"].items())
    return float(np.clip(1.0 / (1.0 + np.exp(-z)), table["least"], table["most"]))
