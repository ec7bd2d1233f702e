"""Magic Formula coefficients as features: the datasets of the thesis' Table 4.1.

The thesis uses "all coefficients that do not depend on the camber angle: 11 of the 18 lateral
ones". Striking PDY3, PEY4, PKY3, PHY3, PVY3 and PVY4, which multiply the camber angle in its
Appendix A, leaves 12. The twelfth is PEY3. The MF-Tyre manual calls it "Zero order camber dependency
of curvature Efy", and so do the 15 of the 16 public files in ``shared/tir`` that explain the key. In
equation A.22, however, it multiplies only sgn(alpha). By the files' own words it goes too, and 11 are left.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.representations.base import CURVE_LOADS, CURVE_SLIP_ANGLES
from tire_pipeline.representations.lateral_curve import lateral_factors, lateral_force


def _numbered(stem: str, *numbers: int) -> tuple[str, ...]:
    return tuple(f"{stem}{number}" for number in numbers)


LONGITUDINAL: tuple[str, ...] = (
    *_numbered("PCX", 1),
    *_numbered("PDX", 1, 2, 3),
    *_numbered("PEX", 1, 2, 3, 4),
    *_numbered("PKX", 1, 2, 3),
    *_numbered("PHX", 1, 2),
    *_numbered("PVX", 1, 2),
)
"""The 15 coefficients of F_x, equations A.4 to A.14."""

LATERAL: tuple[str, ...] = (
    *_numbered("PCY", 1),
    *_numbered("PDY", 1, 2, 3),
    *_numbered("PEY", 1, 2, 3, 4),
    *_numbered("PKY", 1, 2, 3),
    *_numbered("PHY", 1, 2, 3),
    *_numbered("PVY", 1, 2, 3, 4),
)
"""The 18 coefficients of F_y, equations A.16 to A.26."""

LATERAL_CAMBER: tuple[str, ...] = ("PDY3", "PEY3", "PEY4", "PKY3", "PHY3", "PVY3", "PVY4")
"""The 7 lateral coefficients that the files call camber dependent."""

LATERAL_WITHOUT_CAMBER: tuple[str, ...] = tuple(c for c in LATERAL if c not in LATERAL_CAMBER)
"""The 11 that the thesis classifies and translates."""

ALIGNING: tuple[str, ...] = (
    *_numbered("QBZ", 1, 2, 3, 4, 5, 9, 10),
    *_numbered("QCZ", 1),
    *_numbered("QDZ", 1, 2, 3, 4, 6, 7, 8, 9),
    *_numbered("QEZ", 1, 2, 3, 4, 5),
    *_numbered("QHZ", 1, 2, 3, 4),
)
"""The 25 coefficients of M_z, equations A.28 to A.41."""

DATASETS: dict[str, tuple[str, ...]] = {
    "lateral_without_camber": LATERAL_WITHOUT_CAMBER,
    "lateral": LATERAL,
    "longitudinal": LONGITUDINAL,
    "aligning": ALIGNING,
    "full": (*LONGITUDINAL, *LATERAL, *ALIGNING),
}
"""Table 4.1: name of the dataset -> its coefficients."""


class Coefficients:
    """Features are coefficients, taken as they are and put back as they are.

    Parameters
    ----------
    dataset : str
        One of ``DATASETS``; the thesis uses ``lateral_without_camber``.
    """

    name: ClassVar[str] = "coefficients"

    def __init__(self, dataset: str = "lateral_without_camber") -> None:
        if dataset not in DATASETS:
            raise DomainError(
                f"there is no dataset of coefficients {dataset!r}",
                todo=f"choose one of {', '.join(DATASETS)}",
            )
        self.dataset = dataset

    @property
    def feature_names(self) -> tuple[str, ...]:
        """Names of the coefficients, in the order of the equations."""
        return DATASETS[self.dataset]

    def fit(self, table: pd.DataFrame, *, seed: int = 0) -> Self:
        """Check that the table has the coefficients; nothing is learnt."""
        self._check(table)
        return self

    def encode(self, table: pd.DataFrame) -> np.ndarray:
        """Return the coefficients, shape (n, d)."""
        self._check(table)
        return table.loc[:, list(self.feature_names)].to_numpy(dtype=float, copy=True)

    def decode(self, features: np.ndarray, source: pd.DataFrame) -> pd.DataFrame:
        """Return the source tires with these coefficients."""
        decoded = source.copy()
        decoded[list(self.feature_names)] = np.asarray(features, dtype=float)
        return decoded

    def decode_curves(self, features: np.ndarray, source: pd.DataFrame) -> np.ndarray:
        """Return the lateral force curves, N, shape (n, 3, 100)."""
        factors = lateral_factors(self.decode(features, source), CURVE_LOADS)
        return lateral_force(factors, CURVE_SLIP_ANGLES)

    def is_real(self, features: np.ndarray) -> np.ndarray:
        """Every set of coefficients is a tire."""
        return np.ones(len(features), dtype=bool)

    def to_state(self) -> dict[str, Any]:
        """Return the dataset's name."""
        return {"representation": self.name, "dataset": self.dataset}

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(dataset=str(state["dataset"]))

    def _check(self, table: pd.DataFrame) -> None:
        missing = [name for name in self.feature_names if name not in table.columns]
        if missing:
            raise DomainError(
                f"the tire table has no column {', '.join(missing[:6])}",
                todo="ingest files that have these coefficients, or choose another dataset",
            )
