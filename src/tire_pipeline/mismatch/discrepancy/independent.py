"""How many samples of a recording are independent."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy

from tire_pipeline.channels import SLIP_AND_LOAD
from tire_pipeline.mismatch.model.channels import least_spread
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.residual import rms

Array = np.ndarray
_SLIP_CHANNELS = ("slip_angle", "slip_ratio")
_FEWEST_STRETCHES = 15
"""Fewest stretches whose variance is meaningful."""


def measured_apart(data: Data) -> float:
    """Return the share of samples that were measured by themselves: without time, those without a neighbour.

    A neighbour is where slip, camber and load count as held. Samples of a run have neighbours in whatever
    order the rows are given; the points of a test plan are apart.
    """
    if data.time is not None:
        return 0.0
    inputs = [data.get(n) / least_spread(n, data.get(n)) for n in SLIP_AND_LOAD if data.varies(n)]
    if not inputs:
        return 0.0
    place = np.column_stack(inputs)
    distance, _ = scipy.spatial.cKDTree(place).query(place, k=2, p=np.inf)
    return float(np.mean(distance[:, 1] > 1.0))


def independent(left: Array, orders: Sequence[Array]) -> float:
    """Return how many samples are independent, by the correlation of the residual.

    Sums over stretches of white noise have the variance of their length; the residual has more. The stretch
    at which the excess is largest counts, in the order in which neighbours are more alike.

    Parameters
    ----------
    left : ndarray, shape (n,)
        The residual of one output.
    orders : sequence of ndarray of int, shape (n,)
        Of :func:`orders_of`.
    """
    unit = left / max(rms(left), 1e-300)
    return left.size / max(_most_alike(unit[order]) for order in orders)


def orders_of(data: Data) -> list[Array]:
    """Return the orders in which neighbours may err alike: that of the rows, and without time a k-d tree's.

    Its points are the slips and the model's forces, each over its range: stretches of its leaves are regions
    of the operating space, in whatever order the rows were given.
    """
    rows = np.arange(data.size)
    if data.time is not None:
        return [rows]
    place = np.column_stack(
        [*(data.get(n) for n in _SLIP_CHANNELS if data.varies(n)), *data.simulation.base.values()]
    )
    tree = scipy.spatial.cKDTree(place / np.maximum(np.ptp(place, axis=0), 1e-12), leafsize=1)
    return [rows, np.asarray(tree.indices)]


def _most_alike(x: Array) -> float:
    """Largest variance of sums over stretches of a series of unit power, over that of white noise."""
    worst, length = 1.0, 1
    while x.size // length >= _FEWEST_STRETCHES:
        whole = x[: x.size // length * length].reshape(-1, length)
        worst = max(worst, float(np.mean(whole.sum(axis=1) ** 2)) / length)
        length *= 2
    return worst
