"""stable-baselines3's MlpPolicy, computed with fewer and larger torch operations.

For nets of 64-64 nodes nearly all time goes into starting operations. ``MlpPolicy`` codes each
feature of a MultiDiscrete observation by itself, builds a distribution object and checks it, and calls
a tree of modules. Here the same numbers come from a dozen operations; parameters, their names and
their initial values are those of ``MlpPolicy``.
"""

from __future__ import annotations

from typing import Any

import torch
from stable_baselines3.common.policies import ActorCriticPolicy
from torch.nn.functional import linear, one_hot

_PI = ("mlp_extractor.policy_net.0", "mlp_extractor.policy_net.2", "action_net")
_VF = ("mlp_extractor.value_net.0", "mlp_extractor.value_net.2", "value_net")


class BinPolicy(ActorCriticPolicy):
    """``MlpPolicy`` for states of bins and a Discrete action space, with its default net."""

    def extract_features(  # type: ignore[override]
        self, obs: torch.Tensor, features_extractor: Any = None
    ) -> torch.Tensor:
        """Code bins as zeros and ones, shape (batch, d * n_bins)."""
        n_bins = int(self.observation_space.nvec[0])  # type: ignore[attr-defined]
        return one_hot(obs.long(), n_bins).flatten(start_dim=1).float()

    def forward(
        self, obs: torch.Tensor, deterministic: bool = False
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        """Give an action for every state, the state's value and the action's log probability."""
        logs, values = self._logs_and_values(obs)
        if deterministic:
            actions = logs.argmax(dim=1)
        else:
            actions = torch.multinomial(logs.exp(), 1, replacement=True).squeeze(1)
        return actions, values, logs.gather(1, actions[:, None]).squeeze(1)

    def evaluate_actions(  # type: ignore[override]
        self, obs: torch.Tensor, actions: torch.Tensor
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        """Give values, log probabilities of the actions, and the entropy of the distribution."""
        logs, values = self._logs_and_values(obs)
        chosen = logs.gather(1, actions.long().reshape(-1, 1)).squeeze(1)
        return values, chosen, -(logs.exp() * logs).sum(dim=1)

    def _logs_and_values(self, obs: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        pi, vf = self._layers()
        coded = self.extract_features(obs)
        return torch.log_softmax(_net(coded, pi), dim=1), _net(coded, vf)

    def _layers(self) -> tuple[list[tuple[Any, Any]], list[tuple[Any, Any]]]:
        """The net's parameters, looked up once: the optimiser changes them in place."""
        if "_looked_up" not in self.__dict__:
            parameters = dict(self.named_parameters())
            self.__dict__["_looked_up"] = tuple(
                [(parameters[f"{name}.weight"], parameters[f"{name}.bias"]) for name in names]
                for names in (_PI, _VF)
            )
        layers: tuple[list[tuple[Any, Any]], list[tuple[Any, Any]]] = self.__dict__["_looked_up"]
        return layers


def _net(values: torch.Tensor, layers: list[tuple[Any, Any]]) -> torch.Tensor:
    for weight, bias in layers[:-1]:
        values = torch.tanh(linear(values, weight, bias))
    return linear(values, *layers[-1])
