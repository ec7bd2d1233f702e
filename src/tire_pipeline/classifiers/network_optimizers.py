"""AdamW, SGD and RMSprop for many networks at once, each with its own rate and decay.

The formulas and constants are torch's. torch's own optimisers take one learning rate for a tensor;
here every row of the buffer is another network. One compiled pass a step reads each number once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import torch
from numba import njit

from tire_pipeline.errors import DomainError

Step = Callable[[np.ndarray], None]


def make_optimizer(
    name: str,
    flat: torch.Tensor,
    gradient: torch.Tensor,
    learning_rates: Sequence[float],
    weight_decays: Sequence[float],
) -> Step:
    """Give the function that moves ``flat`` by one step along ``gradient``.

    Parameters
    ----------
    name : {"AdamW", "SGD", "RMSprop"}
    flat, gradient : Tensor, shape (M, parameters)
        Read and written in place.
    learning_rates, weight_decays : sequence, length M

    Returns
    -------
    callable
        Takes a bool array of shape (M,): the networks that take this step.
    """
    rates = np.asarray(learning_rates, dtype=np.float32)
    decays = np.asarray(weight_decays, dtype=np.float32)
    values, slopes = flat.numpy(), gradient.numpy()
    if name == "AdamW":
        first, second = np.zeros_like(values), np.zeros_like(values)
        taken = np.zeros(len(values), dtype=np.int64)

        def step(active: np.ndarray) -> None:
            taken[active] += 1
            _adamw(values, slopes, first, second, rates, decays, taken, active)

    elif name == "SGD":

        def step(active: np.ndarray) -> None:
            _sgd(values, slopes, rates, decays, active)

    elif name == "RMSprop":
        mean_square = np.zeros_like(values)

        def step(active: np.ndarray) -> None:
            _rmsprop(values, slopes, mean_square, rates, decays, active)

    else:
        raise DomainError(f"there is no optimiser {name!r}", todo="choose one of AdamW, SGD, RMSprop")
    return step


@njit(cache=True, fastmath=True, nogil=True)
def _adamw(values, slopes, first, second, rates, decays, taken, active):  # type: ignore[no-untyped-def]
    one = np.float32(1)
    b1, b2, tiny = np.float32(0.9), np.float32(0.999), np.float32(1e-8)
    for row in range(values.shape[0]):
        if not active[row]:
            continue
        rate = rates[row]
        shrink = one - rate * decays[row]
        size = np.float32(rate / (1 - 0.9 ** taken[row]))
        root = np.float32(1 / np.sqrt(1 - 0.999 ** taken[row]))
        for i in range(values.shape[1]):
            slope = slopes[row, i]
            m = b1 * first[row, i] + (one - b1) * slope
            v = b2 * second[row, i] + (one - b2) * slope * slope
            first[row, i] = m
            second[row, i] = v
            values[row, i] = values[row, i] * shrink - size * m / (np.sqrt(v) * root + tiny)


@njit(cache=True, fastmath=True, nogil=True)
def _sgd(values, slopes, rates, decays, active):  # type: ignore[no-untyped-def]
    for row in range(values.shape[0]):
        if active[row]:
            rate, decay = rates[row], decays[row]
            for i in range(values.shape[1]):
                value = values[row, i]
                values[row, i] = value - rate * (slopes[row, i] + decay * value)


@njit(cache=True, fastmath=True, nogil=True)
def _rmsprop(values, slopes, mean_square, rates, decays, active):  # type: ignore[no-untyped-def]
    keep, tiny = np.float32(0.99), np.float32(1e-8)
    for row in range(values.shape[0]):
        if active[row]:
            rate, decay = rates[row], decays[row]
            for i in range(values.shape[1]):
                slope = slopes[row, i] + decay * values[row, i]
                square = keep * mean_square[row, i] + (np.float32(1) - keep) * slope * slope
                mean_square[row, i] = square
                values[row, i] -= rate * slope / (np.sqrt(square) + tiny)
