"""The model that is retrained: all it takes from a tire table to the category that measured each tire."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, Self

import numpy as np
import pandas as pd

from tire_pipeline.classifiers.methods.random_forest import RandomForest
from tire_pipeline.errors import DomainError
from tire_pipeline.representations import Representation, representation_from_state
from tire_pipeline.tire_table import Binning, normalize_table

UNKNOWN_CATEGORY = ""


@dataclass(frozen=True)
class CategoryModel:
    """Nominal load, representation, bins and forest that belong together.

    Attributes
    ----------
    nominal_load : float
        N; tires are brought to it first.
    representation : Representation
    bins : Binning
    forest : RandomForest
    """

    nominal_load: float
    representation: Representation
    bins: Binning
    forest: RandomForest

    @property
    def categories(self) -> list[str]:
        """What it can answer."""
        return [str(name) for name in self.forest.classes_]

    def encode(self, tires: pd.DataFrame) -> np.ndarray:
        """Features of tires at any nominal load, shape (rows, features); NaN where a file lacks one."""
        needed = tires.reindex(columns=list(dict.fromkeys([*tires.columns, *self._columns()])))
        return np.asarray(self.representation.encode(normalize_table(needed, self.nominal_load)), dtype=float)

    def predict(self, tires: pd.DataFrame) -> np.ndarray:
        """The most probable category of each row; empty text where a feature has no value.

        Parameters
        ----------
        tires : DataFrame
            A tire table.

        Returns
        -------
        ndarray of str, shape (rows,)
        """
        answer = np.full(len(tires), UNKNOWN_CATEGORY, dtype=object)
        values = self.encode(tires)
        whole = np.isfinite(values).all(axis=1)
        if whole.any():
            chances = self.forest.predict_proba(self.bins.transform(values[whole]).astype(float))
            answer[whole] = self.forest.classes_[chances.argmax(axis=1)]
        return answer.astype(str)

    def _columns(self) -> list[str]:
        return list(self.representation.feature_names) if self.representation.name == "coefficients" else []

    def to_state(self) -> dict[str, Any]:
        """Arrays, numbers and texts that restore it."""
        return {
            "nominal_load": self.nominal_load,
            "representation": self.representation.to_state(),
            "bins": self.bins.to_state(),
            "forest": self.forest.to_state(),
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(
            nominal_load=float(state["nominal_load"]),
            representation=representation_from_state(state["representation"]),
            bins=Binning.from_state(state["bins"]),
            forest=RandomForest.from_state(state["forest"]),
        )


def train_model(
    tires: pd.DataFrame,
    representation: Representation,
    forest: RandomForest,
    *,
    nominal_load: float,
    bins: int = 20,
    method: Literal["equal_width", "equal_frequency"] = "equal_width",
    seed: int,
) -> CategoryModel:
    """Fit representation, bins and forest on the tires that are not held out.

    Parameters
    ----------
    tires : DataFrame
        Tire table of the training tires, at ``nominal_load`` already.
    representation, forest
        Not fitted yet.
    nominal_load : float
        N.
    bins, method
        As for :class:`tire_pipeline.tire_table.Binning`.
    seed : int

    Raises
    ------
    DomainError
        Fewer than two categories among the training tires.
    """
    if tires["category"].nunique() < 2:
        raise DomainError(
            "the tires that are not held out are of fewer than two categories",
            todo="add files, or lower retrain.held_out_share",
        )
    fitted = representation.fit(tires, seed=seed)
    values = np.asarray(fitted.encode(tires), dtype=float)
    binning = Binning.fit(values, bins, method, names=list(fitted.feature_names))
    labels = tires["category"].to_numpy(dtype=str)
    trained = forest.fit(binning.transform(values).astype(float), labels, seed=seed)
    return CategoryModel(nominal_load, fitted, binning, trained)
