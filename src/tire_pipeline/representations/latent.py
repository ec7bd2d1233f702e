"""Latent space of the force curve: an autoencoder 300-128-128-n-128-128-300 (thesis, 4.2.3)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.files.state_files import layers_from_state, layers_to_state
from tire_pipeline.representations.base import CURVE_LOADS, CURVE_SLIP_ANGLES
from tire_pipeline.representations.curve_fit import fit_lateral
from tire_pipeline.representations.lateral_curve import lateral_factors, lateral_force

_NETWORK_LAYERS = 6  # linear layers of encoder and decoder together


class Latent:
    """The n latent features of 300 lateral forces: 3 loads x 100 slip angles.

    Parameters
    ----------
    n_features : int
        Latent features; the thesis chose 8.
    epochs, batch_size : int
        Training; the thesis does not give its own.
    learning_rate : float
        Of Adam.

    Notes
    -----
    The network sees forces with the training set's mean taken off and divided by its one standard
    deviation. Trained with torch, evaluated with NumPy, so that a stored one needs no torch.
    """

    name: ClassVar[str] = "latent"

    def __init__(
        self,
        n_features: int = 8,
        epochs: int = 200,
        batch_size: int = 64,
        learning_rate: float = 1e-3,
    ) -> None:
        self.n_features = int(n_features)
        self.epochs = int(epochs)
        self.batch_size = int(batch_size)
        self.learning_rate = float(learning_rate)
        self.layers: list[tuple[np.ndarray, np.ndarray]] = []
        self.mean = np.zeros(0)
        self.scale = 1.0

    @property
    def feature_names(self) -> tuple[str, ...]:
        """latent_1 ... latent_n."""
        return tuple(f"latent_{index}" for index in range(1, self.n_features + 1))

    def fit(self, table: pd.DataFrame, *, seed: int = 0) -> Self:
        """Train the autoencoder on the table's force curves."""
        from tire_pipeline.representations.autoencoder import train_autoencoder

        curves = _curves(table)
        self.mean = curves.mean(axis=0)
        self.scale = float((curves - self.mean).std()) or 1.0
        self.layers = train_autoencoder(
            (curves - self.mean) / self.scale,
            n_features=self.n_features,
            epochs=self.epochs,
            batch_size=self.batch_size,
            learning_rate=self.learning_rate,
            seed=seed,
        )
        return self

    def encode(self, table: pd.DataFrame) -> np.ndarray:
        """Return the latent features, shape (n, n_features)."""
        self._check_fitted()
        return _forward((_curves(table) - self.mean) / self.scale, self.layers[: _NETWORK_LAYERS // 2])

    def decode_curves(self, features: np.ndarray, source: pd.DataFrame) -> np.ndarray:
        """Return the decoder's own curves, N, shape (n, 3, 100): the thesis' jagged ones."""
        self._check_fitted()
        flat = _forward(np.asarray(features, dtype=float), self.layers[_NETWORK_LAYERS // 2 :])
        shape = (-1, len(CURVE_LOADS), len(CURVE_SLIP_ANGLES))
        return (flat * self.scale + self.mean).reshape(shape)

    def decode(self, features: np.ndarray, source: pd.DataFrame) -> pd.DataFrame:
        """Return the source tires, fitted to the decoder's curves: smooth by construction."""
        curves = self.decode_curves(features, source)
        return fit_lateral(curves, source, CURVE_LOADS, CURVE_SLIP_ANGLES)

    def is_real(self, features: np.ndarray) -> np.ndarray:
        """Every latent vector has a curve."""
        return np.ones(len(features), dtype=bool)

    def to_state(self) -> dict[str, Any]:
        """Return the weights and the scaling."""
        self._check_fitted()
        state: dict[str, Any] = {
            "representation": self.name,
            "n_features": self.n_features,
            "epochs": self.epochs,
            "batch_size": self.batch_size,
            "learning_rate": self.learning_rate,
            "mean": self.mean,
            "scale": self.scale,
        }
        return state | layers_to_state(self.layers)

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        back = cls(
            n_features=int(state["n_features"]),
            epochs=int(state["epochs"]),
            batch_size=int(state["batch_size"]),
            learning_rate=float(state["learning_rate"]),
        )
        back.mean = np.asarray(state["mean"], dtype=float)
        back.scale = float(state["scale"])
        back.layers = layers_from_state(state)
        return back

    def _check_fitted(self) -> None:
        if not self.layers:
            raise DomainError("the autoencoder is not trained", todo="call fit(table) first")


def _curves(table: pd.DataFrame) -> np.ndarray:
    """Force curves side by side, N, shape (n, 300)."""
    force = lateral_force(lateral_factors(table, CURVE_LOADS), CURVE_SLIP_ANGLES)
    return force.reshape(len(force), -1)


def _forward(values: np.ndarray, layers: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Linear layers with ReLU between them, none after the last."""
    for index, (weight, bias) in enumerate(layers):
        values = values @ weight.T + bias
        if index < len(layers) - 1:
            values = np.maximum(values, 0.0)
    return values
