"""Policies: the one that stable-baselines3 trains, and its greedy form in NumPy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tire_pipeline.files.state_files import layers_from_state, layers_to_state

_POLICY_LAYERS = ("mlp_extractor.policy_net.0", "mlp_extractor.policy_net.2", "action_net")


class GreedyPolicy:
    """The most probable action of a trained MlpPolicy, for many states at once, without torch.

    Parameters
    ----------
    layers : list of (weight, bias)
        64-64-actions, weights of shape (out, in).
    n_bins : int
        States are one-hot coded with so many bins a feature, as stable-baselines3 does.
    """

    def __init__(self, layers: list[tuple[np.ndarray, np.ndarray]], n_bins: int) -> None:
        self.layers = layers
        self.n_bins = n_bins

    def actions(self, states: np.ndarray) -> np.ndarray:
        """Return the most probable action of every state.

        Parameters
        ----------
        states : ndarray of int, shape (m, d)

        Returns
        -------
        ndarray of int, shape (m,)
        """
        return self.scores(states).argmax(axis=1)

    def scores(self, states: np.ndarray) -> np.ndarray:
        """Return the logits of all actions, shape (m, actions)."""
        d = states.shape[1]
        columns = states + np.arange(d) * self.n_bins
        weight, bias = self.layers[0]
        # a one-hot row times a matrix picks columns of the matrix
        values = np.tanh(weight.T[columns].sum(axis=1) + bias)
        for weight, bias in self.layers[1:-1]:
            values = np.tanh(values @ weight.T + bias)
        weight, bias = self.layers[-1]
        scores: np.ndarray = values @ weight.T + bias
        return scores

    @classmethod
    def from_model(cls, model: Any, n_bins: int) -> GreedyPolicy:
        """Take the actor's weights from a trained PPO or A2C."""
        weights = {name: value.numpy() for name, value in model.policy.state_dict().items()}
        layers = [
            (weights[f"{name}.weight"].astype(float), weights[f"{name}.bias"].astype(float))
            for name in _POLICY_LAYERS
        ]
        return cls(layers, n_bins)

    def to_state(self) -> dict[str, Any]:
        """Return the weights."""
        return {"n_bins": self.n_bins} | layers_to_state(self.layers)

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> GreedyPolicy:
        """Restore what :meth:`to_state` returned."""
        return cls(layers_from_state(state), int(state["n_bins"]))
