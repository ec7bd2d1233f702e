"""Training of the autoencoder with torch; imported only when one is trained."""

from __future__ import annotations

import numpy as np
import torch
from torch import nn

from tire_pipeline.numerics.small_networks import uncompiled


def train_autoencoder(
    curves: np.ndarray,
    *,
    n_features: int,
    epochs: int,
    batch_size: int,
    learning_rate: float,
    seed: int,
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Train d-128-128-n-128-128-d with ReLU, mean squared error and Adam.

    Parameters
    ----------
    curves : ndarray, shape (n, d)
        Scaled curves.

    Returns
    -------
    list of (weight, bias)
        Six linear layers, encoder first; weights have shape (out, in).
    """
    generator = torch.Generator().manual_seed(seed)
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        width = curves.shape[1]
        network = nn.Sequential(
            nn.Linear(width, 128), nn.ReLU(), nn.Linear(128, 128), nn.ReLU(),
            nn.Linear(128, n_features),
            nn.Linear(n_features, 128), nn.ReLU(), nn.Linear(128, 128), nn.ReLU(),
            nn.Linear(128, width),
        )  # fmt: skip
    data = torch.as_tensor(curves, dtype=torch.float32)
    optimizer = uncompiled(torch.optim.Adam)(network.parameters(), lr=learning_rate, fused=True)
    loss_function = nn.MSELoss()
    for _ in range(epochs):
        for batch in torch.randperm(len(data), generator=generator).split(batch_size):
            part = data[batch]
            loss = loss_function(network(part), part)
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
    return [
        (layer.weight.detach().numpy().astype(float), layer.bias.detach().numpy().astype(float))
        for layer in network
        if isinstance(layer, nn.Linear)
    ]
