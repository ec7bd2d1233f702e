"""Cycle-consistent translation of scores: there, back again, and the same tire (Zhu et al. 2017).

Two networks move scores, one from any source category to the target and one back; two critics, who see the
metadata, tell moved from measured. What is lost going there and back is charged, and so is what is moved.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
import pandas as pd
import torch
from torch import nn

from tire_pipeline.numerics.row_products import by_row
from tire_pipeline.numerics.small_networks import one_torch_thread, uncompiled
from tire_pipeline.translation.population.model import CurveMixedModel, Prediction
from tire_pipeline.translation.predict.likelihood_environment import Situation, situation_of

ROUNDS = 1500
BATCH = 128
CYCLE, IDENTITY = 3.0, 0.1


@dataclass(frozen=True)
class CyclePredictor:
    """Adversarial networks in the scores' space, without pairs.

    Attributes
    ----------
    rounds : int
        Training rounds.
    layers : tuple of ndarray
        Weights and biases of the network to the target; empty until it is fitted.
    """

    rounds: int = ROUNDS
    layers: tuple[np.ndarray, ...] = ()

    def fit(self, model: CurveMixedModel, training: pd.DataFrame, target: str, seed: int) -> Self:
        """Train the networks."""
        own = training["category"].astype(str) == target
        there = _rows(_situation(model, training.loc[own], target))
        here = _rows(_situation(model, training.loc[~own], target))
        sizes = len(model.scale), len(model.categories)
        with one_torch_thread():
            layers = _train(here, there, *sizes, self.rounds, seed)
        return replace(self, layers=tuple(layers))

    def predict(self, model: CurveMixedModel, source: pd.DataFrame, target: str) -> Prediction:
        """Let the first network move the scores."""
        found = model.predict(source, target, trust=0.0)
        situation = _situation(model, source, target)
        first, first_bias, last, last_bias = self.layers
        seen = np.concatenate([situation.scores, situation.context], axis=1)
        hidden = np.maximum(by_row(seen, first) + first_bias, 0.0)
        moved = (by_row(hidden, last) + last_bias) * situation.unit
        return replace(found, shift=moved, target=found.source + moved)

    def to_state(self) -> dict[str, Any]:
        """Return the arrays, strings and numbers that restore it."""
        return {
            "option_rounds": self.rounds,
            **{f"network_{k}": layer for k, layer in enumerate(self.layers)},
        }

    @classmethod
    def from_state(cls, state: Mapping[str, Any]) -> Self:
        """Restore what :meth:`to_state` returned."""
        return cls(int(state["option_rounds"]), tuple(np.asarray(state[f"network_{k}"]) for k in range(4)))


def _situation(model: CurveMixedModel, table: pd.DataFrame, target: str) -> Situation:
    """Scores about the middle of all training files rather than about the category's expectation."""
    found = situation_of(model, table, target)
    scores, _ = model.space.encode(table)
    return replace(found, scores=np.clip(scores / found.unit, -8.0, 8.0))


def _rows(situation: Situation) -> torch.Tensor:
    return torch.as_tensor(np.concatenate([situation.scores, situation.context], axis=1), dtype=torch.float32)


def _network(inputs: int, outputs: int, hidden: int, *, still: bool = False) -> nn.Sequential:
    network = nn.Sequential(nn.Linear(inputs, hidden), nn.ReLU(), nn.Linear(hidden, outputs))
    if still:
        for last in network[2].parameters():
            nn.init.zeros_(last)
    return network


def _train(
    here: torch.Tensor, there: torch.Tensor, scores: int, organisations: int, rounds: int, seed: int
) -> list[np.ndarray]:
    """Train both directions; give the weights of the one to the target."""
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        width = here.shape[1]
        go, back = (_network(width, scores, 64, still=True) for _ in range(2))
        critics = [_network(width, 1, 64) for _ in range(2)]
        adam = uncompiled(torch.optim.Adam)
        moving = adam([*go.parameters(), *back.parameters()], lr=1e-3, betas=(0.5, 0.9))
        judging = adam([w for c in critics for w in c.parameters()], lr=1e-3, betas=(0.5, 0.9))
        generator = torch.Generator().manual_seed(seed)
        for _ in range(rounds):
            a = here[torch.randint(len(here), (BATCH,), generator=generator)]
            b = there[torch.randint(len(there), (BATCH,), generator=generator)]
            context_a, context_b = a[:, scores:], b[:, scores:]
            # a target's file, taken to the category of the source beside it, and the reverse
            as_a = torch.cat([context_a[:, :organisations], context_b[:, organisations:]], dim=1)
            as_b = torch.cat([context_b[:, :organisations], context_a[:, organisations:]], dim=1)
            fake_b = a[:, :scores] + go(a)
            fake_a = b[:, :scores] + back(torch.cat([b[:, :scores], as_a], dim=1))
            again_a = fake_b + back(torch.cat([fake_b, context_a], dim=1))
            again_b = fake_a + go(torch.cat([fake_a, as_a], dim=1))
            rating_b = critics[0](torch.cat([fake_b, as_b], dim=1))
            rating_a = critics[1](torch.cat([fake_a, as_a], dim=1))
            loss = ((rating_b - 1.0) ** 2).mean() + ((rating_a - 1.0) ** 2).mean()
            own_a, own_b = a[:, :scores], b[:, :scores]
            loss = loss + CYCLE * ((again_a - own_a).abs().mean() + (again_b - own_b).abs().mean())
            loss = loss + IDENTITY * ((fake_b - own_a).abs().mean() + (fake_a - own_b).abs().mean())
            moving.zero_grad()
            loss.backward()
            moving.step()
            rating_fake_b = critics[0](torch.cat([fake_b.detach(), as_b], dim=1))
            rating_fake_a = critics[1](torch.cat([fake_a.detach(), as_a], dim=1))
            judged = ((critics[0](b) - 1.0) ** 2).mean() + (rating_fake_b**2).mean()
            judged = judged + ((critics[1](a) - 1.0) ** 2).mean() + (rating_fake_a**2).mean()
            judging.zero_grad()
            judged.backward()
            judging.step()
    weights = [w for layer in (go[0], go[2]) for w in layer.parameters()]
    return [w.detach().numpy().T.astype(float) for w in weights]
