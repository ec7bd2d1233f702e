"""What every representation offers, and how to get one by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Protocol, Self

import numpy as np
import pandas as pd

from tire_pipeline.on_demand import class_by_name

CURVE_LOADS = np.array([4000.0, 6000.0, 8000.0])
"""Normal loads of the thesis' force curves, N (section 4.2.2)."""

CURVE_SLIP_ANGLES = np.linspace(-0.25, 0.25, 100)
"""Slip angles of the thesis' force curves, rad (section 4.2.3)."""

REPRESENTATIONS: dict[str, tuple[str, str]] = {
    "coefficients": ("tire_pipeline.representations.coefficients", "Coefficients"),
    "key_attributes": ("tire_pipeline.representations.key_attributes", "KeyAttributes"),
    "latent": ("tire_pipeline.representations.latent", "Latent"),
    "power_series": ("tire_pipeline.representations.power_series", "PowerSeries"),
}
"""Name of a representation -> module and class; imported only when asked for."""

State = dict[str, Any]
"""Arrays, strings and numbers that bring a fitted object back: never a pickle."""


class Representation(Protocol):
    """Turns tires into features and features into tires."""

    name: ClassVar[str]

    @property
    def feature_names(self) -> tuple[str, ...]:
        """Names of the d features, in order."""
        ...

    def fit(self, table: pd.DataFrame, *, seed: int = 0) -> Self:
        """Learn what the representation needs from the training table (most learn nothing).

        Parameters
        ----------
        table : DataFrame
            Tire table, one row a tire, coefficients by their .tir names, all at one nominal load.
        seed : int
            Seed of whatever is drawn.
        """
        ...

    def encode(self, table: pd.DataFrame) -> np.ndarray:
        """Return the features of every tire, shape (n, d)."""
        ...

    def decode(self, features: np.ndarray, source: pd.DataFrame) -> pd.DataFrame:
        """Return the tires that have these features.

        Parameters
        ----------
        features : ndarray, shape (n, d)
        source : DataFrame
            The n tires that the features were encoded from: everything that the features do not
            determine (camber, other directions, metadata) is theirs.

        Returns
        -------
        DataFrame
            A copy of ``source`` with other coefficients.
        """
        ...

    def decode_curves(self, features: np.ndarray, source: pd.DataFrame) -> np.ndarray:
        """Return the lateral force curves as the thesis decodes them.

        Returns
        -------
        ndarray, shape (n, 3, 100)
            Lateral force, N, at ``CURVE_LOADS`` x ``CURVE_SLIP_ANGLES``.
        """
        ...

    def is_real(self, features: np.ndarray) -> np.ndarray:
        """Tell for every row whether a tire with these features exists, shape (n,), bool."""
        ...

    def to_state(self) -> State:
        """Return the arrays, strings and numbers that restore the fitted object."""
        ...

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        ...


def make_representation(name: str, **options: Any) -> Representation:
    """Make a representation that is not fitted yet.

    Parameters
    ----------
    name : str
        One of ``REPRESENTATIONS``.
    **options
        Passed to its constructor.

    Raises
    ------
    DomainError
        If there is none of that name.

    Examples
    --------
    >>> len(make_representation("coefficients").feature_names)
    11
    """
    representation: Representation = class_by_name(REPRESENTATIONS, name, "representation")(**options)
    return representation


def representation_from_state(state: Mapping[str, Any]) -> Representation:
    """Restore any representation from its ``to_state()``."""
    representation: Representation = class_by_name(
        REPRESENTATIONS, str(state["representation"]), "representation"
    ).from_state(state)
    return representation
