"""PPO's update of the policy as one compiled call an epoch, for :class:`BinPolicy` and FlatAdam.

stable-baselines3 starts some sixty torch operations for each of the 200 minibatches of an update, on
64 rows each. The arithmetic here is that of ``PPO.train``: normalised advantages, clipped surrogate
loss, value loss, entropy, clipped gradient norm, Adam. A test runs both from the same start.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from stable_baselines3 import PPO

from tire_pipeline.translation.thesis.bin_policy import BinPolicy
from tire_pipeline.translation.thesis.compiled_policy import (
    HIDDEN_UNITS,
    adam,
    nets_backward,
    nets_forward,
    pick,
)
from tire_pipeline.translation.thesis.flat_adam import FlatAdam


class CompiledPPO(PPO):
    """stable-baselines3's PPO; only the minibatch loop of ``train`` is compiled.

    What the loop logs besides is left out. With a limit on the values' change or on the KL
    divergence (neither is a default), or another policy or optimiser, it is PPO's own loop.
    """

    def train(self) -> None:
        """Update the policy from the roll-out buffer."""
        policy, optimizer = self.policy, self.policy.optimizer
        if (
            self.clip_range_vf is not None
            or self.target_kl is not None
            or not isinstance(policy, BinPolicy)
            or not isinstance(optimizer, FlatAdam)
        ):
            super().train()
            return
        policy.set_training_mode(True)
        self._update_learning_rate(optimizer)
        clip_range = float(self.clip_range(self._current_progress_remaining))  # type: ignore[operator]
        group = optimizer.param_groups[0]
        for _ in range(self.n_epochs):
            # all rows in the random order in which PPO.train would take them batch by batch
            rows = next(self.rollout_buffer.get(None))
            optimizer.taken = _epoch(  # type: ignore[call-arg]
                optimizer.values,
                optimizer.first,
                optimizer.second,
                optimizer.taken,
                float(group["lr"]),
                *group["betas"],
                group["eps"],
                rows.observations.numpy(),
                policy.n_bins,
                policy.n_actions,
                rows.actions.long().reshape(-1).numpy(),
                rows.old_log_prob.numpy(),
                rows.advantages.numpy(),
                rows.returns.numpy(),
                self.batch_size,
                clip_range,
                float(self.ent_coef),
                float(self.vf_coef),
                float(self.max_grad_norm),
                bool(self.normalize_advantage),
            )
        self._n_updates += self.n_epochs
        self.logger.record("train/n_updates", self._n_updates, exclude="tensorboard")


@njit(cache=True, nogil=True)
def _epoch(  # type: ignore[no-untyped-def]
    flat, first, second, taken, rate, b1, b2, eps,
    states, n_bins, n_actions, actions, old_logs, advantages, returns,
    batch_size, clip_range, entropy_weight, value_weight, most_norm, normalize,
):  # fmt: skip
    """Take one Adam step a minibatch, in the order of the rows; return the number of steps so far."""
    for start in range(0, len(states), batch_size):
        stop = min(start + batch_size, len(states))
        gradient = _gradient(
            flat, states[start:stop], n_bins, n_actions, actions[start:stop], old_logs[start:stop],
            advantages[start:stop], returns[start:stop],
            clip_range, entropy_weight, value_weight, normalize,
        )  # fmt: skip
        norm = np.sqrt(np.sum(gradient * gradient))
        gradient *= np.float32(min(1.0, most_norm / (norm + 1e-6)))
        taken += 1
        adam(flat, gradient, first, second, rate, b1, b2, eps, taken)
    return taken


@njit(cache=True, nogil=True)
def _gradient(  # type: ignore[no-untyped-def]
    flat, states, n_bins, n_actions, actions, old_logs, advantages, returns,
    clip_range, entropy_weight, value_weight, normalize,
):  # fmt: skip
    """Gradient of PPO's loss over one minibatch."""
    m = len(states)
    logs = np.empty((m, n_actions), dtype=np.float32)
    shares = np.empty_like(logs)
    values = np.empty((m, 1), dtype=np.float32)
    hidden = np.empty((4, m, HIDDEN_UNITS), dtype=np.float32)
    nets_forward(flat, states, n_bins, hidden, logs, shares, values)
    chosen, entropy = np.empty(m, dtype=np.float32), np.empty(m, dtype=np.float32)
    pick(logs, shares, actions, chosen, entropy)
    worth = advantages.astype(np.float64)
    if normalize and m > 1:
        middle = worth.mean()
        spread = np.sqrt(((worth - middle) ** 2).sum() / (m - 1))
        worth = (worth - middle) / (spread + 1e-8)
    d_log = np.empty(m, dtype=np.float32)
    d_value = np.empty(m, dtype=np.float32)
    d_entropy = np.full(m, -entropy_weight / m).astype(np.float32)
    for i in range(m):
        ratio = np.exp(np.float64(chosen[i]) - old_logs[i])
        clipped = min(max(ratio, 1 - clip_range), 1 + clip_range)
        surrogate = worth[i] * ratio
        d_log[i] = -surrogate / m if surrogate <= worth[i] * clipped else 0.0
        d_value[i] = value_weight * 2 * (values[i, 0] - returns[i]) / m
    gradient = np.zeros_like(flat)
    nets_backward(
        flat, states, n_bins, hidden, logs, shares, actions, entropy,
        d_value, d_log, d_entropy, gradient,
    )  # fmt: skip
    return gradient
