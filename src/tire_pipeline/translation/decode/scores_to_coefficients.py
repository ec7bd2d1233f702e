"""From predicted scores to the coefficients of a tire."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
import pandas as pd

from tire_pipeline.representations.coefficients import DATASETS
from tire_pipeline.translation.curves.features import LOADS, encode
from tire_pipeline.translation.curves.space import UNIT
from tire_pipeline.translation.decode.least_change import DecodeTarget, decode
from tire_pipeline.translation.decode.physics import SYMMETRY, symmetric
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.predict.shrinkage import failed_fits

COEFFICIENTS = DATASETS["full"]
"""The p and q coefficients: what a translation may change."""


@dataclass(frozen=True)
class Decoder:
    """Gives tires the predicted scores by the least change of coefficients.

    Attributes
    ----------
    limits : ndarray, shape (k, 4)
        Of each of ``COEFFICIENTS`` over the training files: low, middle, high, and standard deviation.
    """

    limits: np.ndarray

    @classmethod
    def fit(cls, training: pd.DataFrame) -> Self:
        """Learn between which values the training files' coefficients lie."""
        values = training.reindex(columns=list(COEFFICIENTS)).fillna(0.0)
        low, middle, high = (values.quantile(q).to_numpy() for q in (0.002, 0.5, 0.998))
        return cls(np.stack([low, middle, high, np.maximum(values.std().to_numpy(), 1e-6)], axis=1))

    def decode(self, model: CurveMixedModel, rows: pd.DataFrame, found: Prediction) -> pd.DataFrame:
        """Give n tires the predicted scores.

        Parameters
        ----------
        model : CurveMixedModel
        rows : DataFrame
            n source tires.
        found : Prediction

        Returns
        -------
        DataFrame
            A copy of ``rows`` with other p and q coefficients.
        """
        source_features = encode(rows)
        _, rest = model.space.encode(rows)
        rest["aligning torque"][failed_fits(model, found)] = 0.0
        wanted = model.space.features(found.target, rest)
        locked = {}
        for group, names in SYMMETRY.items():
            even = symmetric(rows, group)
            locked.update({name: even for name in names})
            first = (wanted[group].shape[1] + 2 * LOADS.size) // 2  # the even features follow the odd ones
            wanted[group][even, first:] = source_features[group][even, first:]
        limits = dict(zip(COEFFICIENTS, self.limits, strict=True))
        return decode(
            rows,
            DecodeTarget(
                wanted,
                UNIT,
                {name: float(limit[3]) for name, limit in limits.items()},
                {name: float(limit[1]) for name, limit in limits.items()},
                {name: (float(limit[0]), float(limit[2])) for name, limit in limits.items()},
                locked,
            ),
        )
