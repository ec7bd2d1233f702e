"""A few numbers that say how a tire's curves differ from others', in units of measurement noise.

Principal components of the curve features of one part, turned so that noise and what is a tire's own are both
uncorrelated: then each component can be modelled on its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import pandas as pd

from tire_pipeline.numerics.row_products import by_row
from tire_pipeline.translation.curves.features import GROUPS, LOADS, encode

UNIT = {"lateral": 0.01, "camber": 0.01, "longitudinal": 0.01, "aligning": 0.002}
"""What counts as 1 in the features of a group: 1% of a force, 2 mm/m of torque over load and radius."""


_LOAD_SLICES = slice(0, LOADS.size), slice(LOADS.size, 2 * LOADS.size), slice(2 * LOADS.size, None)


@dataclass(frozen=True)
class CurveProperty:
    """Features that are modelled together: one property of one output.

    Attributes
    ----------
    group : str
        The output.
    columns : slice
        Its features.
    components : int
        How many scores.
    """

    group: str
    columns: slice
    components: int


PARTS: dict[str, CurveProperty] = {
    "cornering stiffness": CurveProperty("lateral", _LOAD_SLICES[0], 2),
    "lateral friction": CurveProperty("lateral", _LOAD_SLICES[1], 2),
    "lateral shape": CurveProperty("lateral", _LOAD_SLICES[2], 8),
    "camber": CurveProperty("camber", slice(None), 5),
    "slip stiffness": CurveProperty("longitudinal", _LOAD_SLICES[0], 2),
    "longitudinal friction": CurveProperty("longitudinal", _LOAD_SLICES[1], 2),
    "longitudinal shape": CurveProperty("longitudinal", _LOAD_SLICES[2], 6),
    "aligning torque": CurveProperty("aligning", slice(None), 10),
}
"""Stiffness, friction and shape apart: a mechanism acts on one of them, and so does chance."""


@dataclass(frozen=True)
class CurveSpace:
    """Turns tires into scores.

    Attributes
    ----------
    mean : dict of ndarray
        By part, (d,), in units of ``UNIT``.
    onto : dict of ndarray
        By part, (d, k): features to scores.
    back : dict of ndarray
        By part, (k, d): scores to features.
    limit : dict of ndarray
        By part, (d,): how far what the components leave out may lie from zero.
    noise : ndarray, shape (p,)
        Variance of one file's noise in each score.
    """

    mean: dict[str, np.ndarray]
    onto: dict[str, np.ndarray]
    back: dict[str, np.ndarray]
    limit: dict[str, np.ndarray]
    noise: np.ndarray

    @property
    def slices(self) -> dict[str, slice]:
        """Where each part's scores stand."""
        ends = np.cumsum([self.onto[name].shape[1] for name in PARTS])
        starts = [0, *ends[:-1]]
        return {name: slice(int(s), int(e)) for name, s, e in zip(PARTS, starts, ends, strict=True)}

    def encode(self, table: pd.DataFrame) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Return the scores (n, p), and by part what they leave out (n, d), bounded."""
        features = encode(table)
        scores, rest = [], {}
        for name, part in PARTS.items():
            apart = features[part.group][:, part.columns] / UNIT[part.group] - self.mean[name]
            own = by_row(apart, self.onto[name])
            left = apart - by_row(own, self.back[name])
            scores.append(own)
            rest[name] = np.clip(left, -self.limit[name], self.limit[name])
        return np.concatenate(scores, axis=1), rest

    def features(self, scores: np.ndarray, rest: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Return the features, by group (n, d), that belong to scores."""
        found: dict[str, list[np.ndarray]] = {group.name: [] for group in GROUPS}
        for name, place in self.slices.items():
            group = PARTS[name].group
            values = self.mean[name] + by_row(scores[:, place], self.back[name]) + rest[name]
            found[group].append(values * UNIT[group])
        return {group: np.concatenate(values, axis=1) for group, values in found.items()}

    def to_state(self) -> dict[str, Any]:
        """Return the arrays that restore it."""
        state: dict[str, Any] = {"space_noise": self.noise}
        for what in ("mean", "onto", "back", "limit"):
            state.update({f"space_{what}_{k}": v for k, v in getattr(self, what).items()})
        return state

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""

        def take(what: str) -> dict[str, np.ndarray]:
            return {name: np.asarray(state[f"space_{what}_{name}"]) for name in PARTS}

        return cls(take("mean"), take("onto"), take("back"), take("limit"), np.asarray(state["space_noise"]))
