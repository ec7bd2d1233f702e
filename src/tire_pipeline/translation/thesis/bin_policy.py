"""stable-baselines3's MlpPolicy for states of bins, with compiled nets behind torch's autograd.

For nets of 64-64 nodes nearly all time goes into starting torch operations. The algorithms (PPO, A2C:
roll-outs, advantages, losses, clipping, optimisers) stay stable-baselines3's; only the nets' forward and
backward pass are compiled, as one autograd function on one parameter that holds all weights. Initial
values, network and gradients are those of ``MlpPolicy``; a test compares them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import torch
from stable_baselines3.common.policies import ActorCriticPolicy

from tire_pipeline.translation.thesis.compiled_policy import (
    HIDDEN_UNITS,
    net_shapes,
    nets_backward,
    nets_forward,
    pick,
    sample,
)

_PI = ("mlp_extractor.policy_net.0", "mlp_extractor.policy_net.2", "action_net")
_VF = ("mlp_extractor.value_net.0", "mlp_extractor.value_net.2", "value_net")
_NAMES = [f"{layer}.{part}" for layer in (*_PI, *_VF) for part in ("weight", "bias")]


class BinPolicy(ActorCriticPolicy):
    """``MlpPolicy`` with its default net, for states of bins and a Discrete action space."""

    weights: torch.nn.Parameter

    def _build(self, lr_schedule: Any) -> None:
        """Build ``MlpPolicy``, then move its parameters into one."""
        wanted, self.optimizer_class = self.optimizer_class, torch.optim.SGD  # replaced below
        options, self.optimizer_kwargs = self.optimizer_kwargs, {}
        super()._build(lr_schedule)
        self.optimizer_class, self.optimizer_kwargs = wanted, options
        space: Any = self.observation_space
        self.n_bins = int(space.nvec[0])
        self.n_actions = int(self.action_space.n)  # type: ignore[attr-defined]
        self._shapes = [
            *net_shapes(len(space.nvec), self.n_bins, self.n_actions),
            *net_shapes(len(space.nvec), self.n_bins, 1),
        ]
        own = dict(self.named_parameters())
        parts = [own[name].detach().t().reshape(-1) for name in _NAMES]
        del self.mlp_extractor, self.action_net, self.value_net
        self.weights = torch.nn.Parameter(torch.cat(parts))
        self.optimizer = wanted([self.weights], lr=lr_schedule(1), **options)  # type: ignore[call-arg]

    def mlp_parameters(self, values: torch.Tensor | None = None) -> dict[str, torch.Tensor]:
        """Give the weights, or anything of their size, by ``MlpPolicy``'s names and shapes."""
        flat = (self.weights if values is None else values).detach()
        parts = flat.split([int(np.prod(shape)) for shape in self._shapes])
        return {
            name: part.reshape(shape).t().clone()
            for name, part, shape in zip(_NAMES, parts, self._shapes, strict=True)
        }

    def forward(
        self, obs: torch.Tensor, deterministic: bool = False
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        """Give an action for every state, the state's value and the action's log probability."""
        logs, shares, values, _ = self._nets(obs)
        if deterministic:
            actions = logs.argmax(axis=1)
        else:
            actions = np.empty(len(logs), dtype=np.int64)
            sample(shares, torch.rand(len(logs), dtype=torch.float64).numpy(), actions)
        chosen = logs[np.arange(len(logs)), actions]
        return torch.from_numpy(actions), torch.from_numpy(values), torch.from_numpy(chosen)

    def evaluate_actions(  # type: ignore[override]
        self, obs: torch.Tensor, actions: torch.Tensor
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        """Give values, log probabilities of the actions, and the entropy of the distribution."""
        values, logs, entropy = _Evaluate.apply(self.weights, self, obs, actions)  # type: ignore[no-untyped-call]
        return values, logs, entropy

    def predict_values(self, obs: torch.Tensor) -> torch.Tensor:  # type: ignore[override]
        """Give the values, shape (m, 1)."""
        return torch.from_numpy(self._nets(obs)[2])

    def _predict(self, observation: torch.Tensor, deterministic: bool = False) -> torch.Tensor:  # type: ignore[override]
        return self.forward(observation, deterministic)[0]

    def parameters(self, recurse: bool = True) -> Any:
        """Give the one parameter, without a search through all modules."""
        return iter((self.weights,)) if "weights" in self._parameters else super().parameters()

    def _nets(self, obs: torch.Tensor) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Log probabilities, probabilities, values (m, 1) and hidden layers (4, m, 64)."""
        states = obs.numpy()
        m = len(states)
        logs = np.empty((m, self.n_actions), dtype=np.float32)
        shares = np.empty_like(logs)
        values = np.empty((m, 1), dtype=np.float32)
        hidden = np.empty((4, m, HIDDEN_UNITS), dtype=np.float32)
        flat = self.weights.detach().numpy()
        nets_forward(flat, states, self.n_bins, hidden, logs, shares, values)
        return logs, shares, values, hidden


class _Evaluate(torch.autograd.Function):
    """Values, log probabilities of given actions and entropies, with their gradient."""

    @staticmethod
    def forward(  # type: ignore[override]
        ctx: Any, weights: torch.Tensor, policy: BinPolicy, obs: torch.Tensor, actions: torch.Tensor
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        logs, shares, values, hidden = policy._nets(obs)
        numbers = actions.long().reshape(-1).numpy()
        chosen, entropy = np.empty((2, len(logs)), dtype=np.float32)
        pick(logs, shares, numbers, chosen, entropy)
        ctx.kept = (policy, obs.numpy(), logs, shares, hidden, numbers, entropy)
        return torch.from_numpy(values), torch.from_numpy(chosen), torch.from_numpy(entropy)

    @staticmethod
    def backward(ctx: Any, *gradients: torch.Tensor) -> tuple[torch.Tensor, None, None, None]:  # type: ignore[override]
        policy, states, logs, shares, hidden, numbers, entropy = ctx.kept
        d_value, d_log, d_entropy = (g.contiguous().reshape(-1).numpy() for g in gradients)
        flat = policy.weights.detach().numpy()
        gradient = np.zeros_like(flat)
        nets_backward(
            flat, states, policy.n_bins, hidden, logs, shares, numbers, entropy,
            d_value, d_log, d_entropy, gradient,
        )  # fmt: skip
        return torch.from_numpy(gradient), None, None, None
