"""The bias of a file's supplier against the target, for this file's tire, with its band."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from tire_pipeline.numerics.row_products import by_row
from tire_pipeline.translation.curves.space import PARTS, UNIT
from tire_pipeline.translation.judge.effects import EFFECT_QUANTILE, KEY_PARTS
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction

CERTAINTY = 0.90
"""With which a band contains the bias: that of ``EFFECT_QUANTILE``."""

NEGLIGIBLE = 0.05
"""Largest bias in stiffness or friction that may be left in a file that is called unbiased. By hand: a tire
model is not known any better. On a fleet of six organisations the bands reach 1 to 2% either way."""


@dataclass(frozen=True)
class BiasBand:
    """What the supplier measures more than the target, of ``KEY_PARTS``; means over the loads.

    Attributes
    ----------
    low, high : ndarray, shape (n, parts)
        Ends of the 90% band, as shares: 0.05 is 5% more.
    """

    low: np.ndarray
    high: np.ndarray

    @property
    def contains_zero(self) -> np.ndarray:
        """Whether the bands of all parts contain zero, (n,)."""
        return np.all((self.low <= 0.0) & (self.high >= 0.0), axis=1)

    @property
    def excludes_zero(self) -> np.ndarray:
        """Whether the band of each part tells the sign of its bias, (n, parts)."""
        return (self.low > 0.0) | (self.high < 0.0)

    @property
    def negligible(self) -> np.ndarray:
        """Whether all bands contain zero, and nothing that is not negligible, (n,)."""
        widest = np.maximum(-self.low, self.high).max(axis=1)
        return self.contains_zero & (widest <= NEGLIGIBLE)

    def in_words(self, row: int) -> str:
        """Return the bands of one file, such as ``"cornering stiffness +1.0% to +3.2%, ..."``."""
        return ", ".join(
            f"{part} {low:+.1%} to {high:+.1%}"
            for part, low, high in zip(KEY_PARTS, self.low[row], self.high[row], strict=True)
        )


def bias_band(model: CurveMixedModel, found: Prediction) -> BiasBand:
    """Return the bands from the difference of the two effects, which a shift undoes, and its variance.

    Parameters
    ----------
    model : CurveMixedModel
    found : Prediction
        Of n files.

    Returns
    -------
    BiasBand
    """
    middle, half = (np.zeros((len(found.shift), len(KEY_PARTS))) for _ in range(2))
    for k, part in enumerate(KEY_PARTS):
        place = model.space.slices[part]
        along = model.space.back[part].mean(axis=1) * UNIT[PARTS[part].group]
        middle[:, k] = by_row(found.shift[:, place], along[:, None])[:, 0]
        variance = by_row(found.shift_variance[:, place], along[:, None] ** 2)[:, 0]
        half[:, k] = EFFECT_QUANTILE * np.sqrt(variance)
    return BiasBand(np.expm1(-middle - half), np.expm1(-middle + half))


def measured_by_both(
    model: CurveMixedModel, rows: pd.DataFrame, found: Prediction
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Return the curve features of n tires as their source and as the target measures them.

    They differ by the bias alone: that of :data:`.effects.KEY_PARTS`, which have bands, and of others as far
    as the source probably has one. What a translation changes besides, since a file's own noise is drawn
    towards what is usual of such a tire, says nothing of what the target measures.

    Parameters
    ----------
    model : CurveMixedModel
    rows : DataFrame
        The source files.
    found : Prediction

    Returns
    -------
    source, target : dict of ndarray
        By group, each (n, features).
    """
    _, rest = model.space.encode(rows)
    weight = found.differs.copy()
    for part in KEY_PARTS:
        weight[:, model.space.slices[part]] = 1.0
    there = found.source + weight * found.shift
    return model.space.features(found.source, rest), model.space.features(there, rest)
