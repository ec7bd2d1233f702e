"""Trains many small networks side by side: one matrix product a layer for all of them.

A single network of 128-128-64 nodes with batches of 32 keeps a processor busy for a tenth of the
time that torch needs to start each operation. Networks that share size, optimiser, loss and batch
size but differ in data, seed, learning rate and weight decay are therefore trained together.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import torch

from tire_pipeline.errors import DomainError
from tire_pipeline.numerics.small_networks import uncompiled
from tire_pipeline.progress import track

HIDDEN_LAYERS = (128, 128, 64)
"""Nodes of the thesis' three hidden layers."""

LOSSES = ("CrossEntropyLoss", "NLLLoss", "MSELoss")

_OPTIMIZERS: dict[str, tuple[Any, dict[str, bool]]] = {
    "AdamW": (uncompiled(torch.optim.AdamW), {"fused": True}),
    "SGD": (uncompiled(torch.optim.SGD), {"fused": True}),
    "RMSprop": (uncompiled(torch.optim.RMSprop), {}),
}

Layers = list[tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class TrainingSet:
    """What one network learns from.

    Attributes
    ----------
    features : ndarray, shape (n, d)
    labels : ndarray of int, shape (n,)
        Class numbers.
    """

    features: np.ndarray
    labels: np.ndarray


def train_networks(
    sets: Sequence[TrainingSet],
    *,
    n_classes: int,
    learning_rates: Sequence[float],
    weight_decays: Sequence[float],
    seeds: Sequence[int],
    optimizer: str = "AdamW",
    loss: str = "CrossEntropyLoss",
    batch_size: int = 32,
    epochs: Iterable[int] = (300,),
    hidden: tuple[int, ...] = HIDDEN_LAYERS,
) -> dict[int, list[Layers]]:
    """Train M networks: ReLU between the layers, softmax after the last.

    Parameters
    ----------
    sets : sequence of TrainingSet, length M
        With the same number of features; the numbers of rows may differ.
    n_classes : int
    learning_rates, weight_decays, seeds : sequence, length M
    optimizer : {"AdamW", "SGD", "RMSprop"}
        With torch's defaults.
    loss : {"CrossEntropyLoss", "NLLLoss", "MSELoss"}
        The first two are the same function of a softmax output; the third compares the
        probabilities with one-hot labels.
    batch_size : int
    epochs : iterable of int
        The networks are handed out after each of these; training ends with the last. As nothing
        depends on the number of epochs to come, it is the same as training again for each.
    hidden : tuple of int

    Returns
    -------
    dict
        Epochs -> for each network its layers (weight of shape (in, out), bias).
    """
    if loss not in LOSSES:
        raise DomainError(f"there is no loss {loss!r}", todo=f"choose one of {', '.join(LOSSES)}")
    wanted = sorted(set(epochs))
    width = sets[0].features.shape[1]
    sizes = [width, *hidden, n_classes]
    data, labels, counts = _padded(sets)
    longest = len(data) // len(sets)
    first_row = longest * np.arange(len(sets))[:, None]
    network = _Networks(sizes, seeds)
    shuffles = [np.random.default_rng([seed, 1]) for seed in seeds]
    steps_of = -(-counts // batch_size)
    steps = _TrainingSteps(optimizer, network, learning_rates, weight_decays, steps_of)
    out: dict[int, list[Layers]] = {}
    order = np.zeros((len(sets), int(steps_of.max()) * batch_size), dtype=np.int64)
    for epoch in track(range(1, wanted[-1] + 1), "training neural networks, epoch by epoch"):
        for index, (shuffle, count) in enumerate(zip(shuffles, counts, strict=True)):
            order[index, :count] = shuffle.permutation(count)
            order[index, count:] = longest - 1
        for number in range(int(steps_of.max())):
            rows = order[:, number * batch_size : (number + 1) * batch_size] + first_row
            chosen = torch.from_numpy(rows.ravel())
            inputs = data.index_select(0, chosen).view(*rows.shape, width)
            network.backward(inputs, labels.index_select(0, chosen).view(rows.shape), loss)
            steps.take(number)
        if epoch in wanted:
            out[epoch] = network.layers()
    return out


def _padded(sets: Sequence[TrainingSet]) -> tuple[torch.Tensor, torch.Tensor, np.ndarray]:
    """Put the sets below each other, all as long as the longest and a padding row with label -1."""
    counts = np.array([len(some.features) for some in sets])
    longest = int(counts.max()) + 1
    data = np.zeros((len(sets), longest, sets[0].features.shape[1]), dtype=np.float32)
    labels = np.full((len(sets), longest), -1, dtype=np.int64)
    for index, some in enumerate(sets):
        data[index, : counts[index]] = some.features
        labels[index, : counts[index]] = some.labels
    return torch.from_numpy(data).flatten(0, 1), torch.from_numpy(labels).flatten(), counts


class _Networks:
    """Parameters of M networks in one buffer (M, parameters), with the gradient beside it."""

    def __init__(self, sizes: Sequence[int], seeds: Sequence[int]) -> None:
        shapes = list(itertools.pairwise(sizes))
        total = sum(a * b + b for a, b in shapes)
        self.flat = torch.zeros(len(seeds), total)
        self.gradient = torch.zeros(len(seeds), total)
        self.weights: list[torch.Tensor] = []
        self.biases: list[torch.Tensor] = []
        self.weight_gradients: list[torch.Tensor] = []
        self.bias_gradients: list[torch.Tensor] = []
        start = 0
        for a, b in shapes:
            stop = start + a * b
            for buffer, weights, biases in (
                (self.flat, self.weights, self.biases),
                (self.gradient, self.weight_gradients, self.bias_gradients),
            ):
                weights.append(buffer[:, start:stop].view(len(seeds), a, b))
                biases.append(buffer[:, stop : stop + b])
            start = stop + b
        for index, seed in enumerate(seeds):  # torch's own start for nn.Linear
            generator = torch.Generator().manual_seed(int(seed))
            for weight, bias in zip(self.weights, self.biases, strict=True):
                bound = weight.shape[1] ** -0.5
                weight[index].uniform_(-bound, bound, generator=generator)
                bias[index].uniform_(-bound, bound, generator=generator)

    def backward(self, inputs: torch.Tensor, labels: torch.Tensor, loss: str) -> None:
        """Write the gradient of the mean loss over each network's batch."""
        layers = [inputs]
        for index, (weight, bias) in enumerate(zip(self.weights, self.biases, strict=True)):
            values = torch.baddbmm(bias[:, None, :], layers[-1], weight)
            if index < len(self.weights) - 1:
                values.relu_()
            layers.append(values)
        delta = _output_gradient(layers.pop(), labels, loss)
        for index in reversed(range(len(self.weights))):
            below = layers.pop()
            self.weight_gradients[index].copy_(torch.bmm(below.transpose(1, 2), delta))
            self.bias_gradients[index].copy_(delta.sum(dim=1))
            if index:
                delta = torch.bmm(delta, self.weights[index].transpose(1, 2))
                delta = torch.ops.aten.threshold_backward(delta, below, 0)  # 0 where ReLU cuts off

    def layers(self) -> list[Layers]:
        """Copy the weights out, network by network."""
        return [
            [
                (weight[index].numpy().astype(float), bias[index].numpy().astype(float))
                for weight, bias in zip(self.weights, self.biases, strict=True)
            ]
            for index in range(len(self.flat))
        ]


class _TrainingSteps:
    """An optimiser over all networks; neighbours with the same rate, decay and steps are one group."""

    def __init__(
        self,
        name: str,
        network: _Networks,
        rates: Sequence[float],
        decays: Sequence[float],
        steps_of: np.ndarray,
    ) -> None:
        if name not in _OPTIMIZERS:
            raise DomainError(
                f"there is no optimiser {name!r}", todo=f"choose one of {', '.join(_OPTIMIZERS)}"
            )
        kind, options = _OPTIMIZERS[name]
        groups: list[dict[str, Any]] = []
        self.members: list[tuple[torch.Tensor, torch.Tensor, int]] = []
        for (rate, decay, steps), same in itertools.groupby(
            range(len(rates)), lambda index: (float(rates[index]), float(decays[index]), int(steps_of[index]))
        ):
            places = list(same)
            place = slice(places[0], places[-1] + 1)
            rows = network.flat[place]
            self.members.append((rows, network.gradient[place], steps))
            groups.append({"params": [rows], "lr": rate, "weight_decay": decay})
        self.optimizer = kind(groups, **options)

    def take(self, number: int) -> None:
        """Move the networks that have a batch of this number one step along their gradients."""
        for rows, slopes, steps in self.members:
            rows.grad = slopes if number < steps else None
        self.optimizer.step()


def _output_gradient(scores: torch.Tensor, labels: torch.Tensor, loss: str) -> torch.Tensor:
    """Gradient of the mean loss with respect to the scores before softmax; padding counts 0."""
    real = (labels >= 0)[..., None]
    share = real / real.sum(dim=1, keepdim=True).clamp(min=1)
    probability = torch.softmax(scores, dim=-1)
    wanted = torch.zeros_like(scores).scatter_(2, labels.clamp(min=0)[..., None], 1.0)
    away = probability - wanted
    if loss == "MSELoss":
        away *= 2 / scores.shape[-1]
        away = probability * (away - (away * probability).sum(dim=-1, keepdim=True))
    return away * share
