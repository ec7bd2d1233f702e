"""Random network distillation: a bonus for what an agent has seldom seen (Burda et al. 2018)."""

from __future__ import annotations

import numpy as np
import torch
from torch import nn

from tire_pipeline.numerics.small_networks import uncompiled


class Curiosity:
    """Bonus: error of a network that learns to give what a fixed random network gives.

    Parameters
    ----------
    size : int
        Numbers in an observation.
    seed : int
    weight : float
        Bonus of an observation that is as strange as the average so far.
    """

    def __init__(self, size: int, seed: int, weight: float = 0.1) -> None:
        generator = torch.Generator().manual_seed(seed)
        self.random, self.learner = (_network(size, generator) for _ in range(2))
        self.random.requires_grad_(False)
        self.optimizer = uncompiled(torch.optim.Adam)(self.learner.parameters(), lr=1e-3)
        self.weight, self.usual = weight, 1.0

    def __call__(self, seen: np.ndarray) -> np.ndarray:
        """Return the bonus (n,) of observations (n, size), and learn from them."""
        inputs = torch.as_tensor(seen, dtype=torch.float32)
        errors = ((self.learner(inputs) - self.random(inputs)) ** 2).mean(dim=1)
        self.optimizer.zero_grad()
        errors.mean().backward()
        self.optimizer.step()
        found = errors.detach().numpy()
        self.usual = 0.99 * self.usual + 0.01 * float(found.mean())
        return self.weight * found / max(self.usual, 1e-9)


def _network(size: int, generator: torch.Generator) -> nn.Sequential:
    network = nn.Sequential(nn.Linear(size, 32), nn.ReLU(), nn.Linear(32, 16))
    with torch.no_grad():
        for weights in network.parameters():
            drawn = torch.randn(weights.shape, generator=generator)
            weights.copy_(drawn / np.sqrt(max(weights.shape[-1], 1)))
    return network
