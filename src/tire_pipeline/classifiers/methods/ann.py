"""The thesis' network: 128-128-64, ReLU, softmax (section 4.4; tuned values of Table 5.4)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Self

import numpy as np

from tire_pipeline.classifiers.methods.gradient_boosting import softmax
from tire_pipeline.classifiers.methods.oversampling import oversample
from tire_pipeline.errors import DomainError
from tire_pipeline.files.state_files import layers_from_state, layers_to_state


class Ann:
    """A small network, trained with torch, evaluated with NumPy.

    Parameters
    ----------
    epochs, batch_size : int
    learning_rate, weight_decay : float
    optimizer : {"AdamW", "SGD", "RMSprop"}
    loss : {"CrossEntropyLoss", "NLLLoss", "MSELoss"}
    smote : bool
        Balance the training rows with SMOTE first.

    Notes
    -----
    Features are shifted and scaled to mean 0 and deviation 1 of the training rows.
    """

    name: ClassVar[str] = "ann"

    def __init__(
        self,
        epochs: int = 300,
        batch_size: int = 32,
        learning_rate: float = 1e-3,
        weight_decay: float = 0.01,
        optimizer: str = "AdamW",
        loss: str = "CrossEntropyLoss",
        *,
        smote: bool = True,
    ) -> None:
        self.epochs = epochs
        self.batch_size = batch_size
        self.learning_rate = learning_rate
        self.weight_decay = weight_decay
        self.optimizer = optimizer
        self.loss = loss
        self.smote = smote
        self.classes_ = np.zeros(0, dtype=str)
        self.mean = np.zeros(0)
        self.scale = np.ones(0)
        self.layers: list[tuple[np.ndarray, np.ndarray]] = []

    def fit(self, features: np.ndarray, labels: np.ndarray, *, seed: int) -> Self:
        """Train."""
        trained = self.fit_many(features, labels, [seed])[0]
        self.__dict__.update(trained.__dict__)
        return self

    def fit_many(self, features: np.ndarray, labels: np.ndarray, seeds: Sequence[int]) -> list[Self]:
        """Train one network for each seed, all side by side."""
        from tire_pipeline.classifiers.methods.network_batch import TrainingSet, train_networks

        made, sets = [], []
        for seed in seeds:
            network = type(self)(
                epochs=self.epochs,
                batch_size=self.batch_size,
                learning_rate=self.learning_rate,
                weight_decay=self.weight_decay,
                optimizer=self.optimizer,
                loss=self.loss,
                smote=self.smote,
            )
            rows, names = oversample(
                np.asarray(features, dtype=float), np.asarray(labels), smote=self.smote, seed=seed
            )
            network.classes_, numbers = np.unique(names.astype(str), return_inverse=True)
            network.mean, network.scale = standard_scale(rows)
            sets.append(TrainingSet((rows - network.mean) / network.scale, numbers))
            made.append(network)
        trained = train_networks(
            sets,
            n_classes=len(made[0].classes_),
            learning_rates=[self.learning_rate] * len(made),
            weight_decays=[self.weight_decay] * len(made),
            seeds=list(seeds),
            optimizer=self.optimizer,
            loss=self.loss,
            batch_size=self.batch_size,
            epochs=(self.epochs,),
        )
        for network, layers in zip(made, trained[self.epochs], strict=True):
            network.layers = layers
        return made

    def predict_proba(self, features: np.ndarray) -> np.ndarray:
        """Return the probabilities, shape (n, classes)."""
        if not self.layers:
            raise DomainError("the network is not trained", todo="call fit(...) first")
        return network_probabilities((features - self.mean) / self.scale, self.layers)

    def to_state(self) -> dict[str, Any]:
        """Return weights and scaling."""
        state: dict[str, Any] = {
            "classifier": self.name,
            "classes": self.classes_,
            "mean": self.mean,
            "scale": self.scale,
            "n_layers": len(self.layers),
        }
        return state | layers_to_state(self.layers)

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        back = cls()
        back.classes_ = np.asarray(state["classes"]).astype(str)
        back.mean = np.asarray(state["mean"], dtype=float)
        back.scale = np.asarray(state["scale"], dtype=float)
        back.layers = layers_from_state(state)
        return back


def standard_scale(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return mean and standard deviation of every column; 1 where a column does not vary."""
    deviation = rows.std(axis=0)
    return rows.mean(axis=0), np.where(deviation > 0, deviation, 1.0)


def network_probabilities(rows: np.ndarray, layers: Sequence[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Evaluate a network: ReLU between the layers, softmax after the last.

    Parameters
    ----------
    rows : ndarray, shape (n, d)
    layers : sequence of (weight, bias)
        Weights of shape (in, out).
    """
    for index, (weight, bias) in enumerate(layers):
        rows = rows @ weight + bias
        if index < len(layers) - 1:
            rows = np.maximum(rows, 0.0)
    return softmax(rows)
