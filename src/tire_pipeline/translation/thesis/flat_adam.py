"""torch's Adam for one parameter, as one compiled pass."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import torch

from tire_pipeline.translation.thesis.compiled_policy import adam


class FlatAdam(torch.optim.Optimizer):
    """Adam without weight decay for a single parameter; a test compares it with torch's.

    Parameters
    ----------
    params : iterable of one Parameter
        Of type float32, on the CPU.
    lr : float
    betas : tuple of float
    eps : float
        stable-baselines3's default for PPO, not torch's.
    """

    def __init__(
        self,
        params: Iterable[torch.nn.Parameter],
        lr: float = 1e-3,
        betas: tuple[float, float] = (0.9, 0.999),
        eps: float = 1e-5,
    ) -> None:
        super().__init__(params, {"lr": lr, "betas": betas, "eps": eps})
        (self._only,) = self.param_groups[0]["params"]
        self.values = self._only.detach().numpy()
        self.first = np.zeros_like(self.values)
        self.second = np.zeros_like(self.values)
        self.taken = 0

    def zero_grad(self, set_to_none: bool = True) -> None:
        """Forget the gradient."""
        self._only.grad = None

    def step(self, closure: Callable[[], float] | None = None) -> Any:  # type: ignore[override]
        """Take one step along the gradient."""
        self.taken += 1
        group = self.param_groups[0]
        adam(  # type: ignore[call-arg]
            self.values,
            self._only.grad.numpy(),
            self.first,
            self.second,
            group["lr"],
            *group["betas"],
            group["eps"],
            self.taken,
        )
