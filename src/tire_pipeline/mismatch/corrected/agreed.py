"""The change that several explanations agree on, where a recording cannot tell them apart."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate, simulate_moments

Array = np.ndarray
UNSURE = 0.5 * math.erfc(math.sqrt(0.5))
"""Probability that a change may be smaller than what is added: that of one standard deviation below."""


def agreed(
    plain: Mapping[str, Array], each: Sequence[Mapping[str, Array]], weights: Sequence[float]
) -> dict[str, Array]:
    """Return forces changed by no more than explanations agree on.

    On the recording that was explained, the explanations predict nearly the same forces. At other loads,
    times and slips they can differ: wear continues, a gain stays constant. Each sample changes in the
    direction of the likeliest explanation, by an amount that the true change exceeds except with probability
    ``UNSURE``.

    Parameters
    ----------
    plain : mapping of str to ndarray, shape (n,)
        Output -> what the model predicts with nothing added, N or N m.
    each : sequence of mappings
        The same with each explanation added, the likeliest first.
    weights : sequence of float
        Of the explanations: their probabilities, or multiples of them.
    """
    weight = np.asarray(weights, float) / np.sum(weights)
    out = {}
    for name, start in plain.items():
        changes = np.array([forces[name] - start for forces in each])
        sign = np.sign(changes[0])
        sizes = np.maximum(changes * sign, 0.0)
        order = np.argsort(sizes, axis=0)
        first = (np.cumsum(weight[order], axis=0) > UNSURE).argmax(axis=0)
        chosen = np.take_along_axis(order, first[None], axis=0)
        out[name] = start + sign * np.take_along_axis(sizes, chosen, axis=0)[0]
    return out


def share_agreed(
    data: Data,
    changes: Sequence[Change],
    instead: Sequence[tuple[float, Sequence[Change]]],
    moments: Sequence[str] = (),
) -> dict[str, Array]:
    """Return the share of the likeliest explanation's change that others agree on, 0 to 1, at each sample.

    Parameters
    ----------
    data : Data
    changes : sequence of (name, parameters)
        The likeliest explanation.
    instead : sequence of (odds, changes)
        The others; without any there is no output in what is returned.
    moments : sequence of str
        Recorded moments, beside the forces.
    """
    if not instead:
        return {}

    def simulated(changes: Sequence[Change]) -> dict[str, Array]:
        return simulate(data, changes) | (simulate_moments(data, changes, moments) if moments else {})

    plain, each = simulated(()), [simulated(changes) for changes in (changes, *(c for _, c in instead))]
    whole = agreed(plain, each, [1.0, *(odds for odds, _ in instead)])
    out = {}
    for name in (*data.outputs, *moments):
        own, added = each[0][name] - plain[name], whole[name] - plain[name]
        out[name] = np.clip(np.divide(added, own, out=np.ones_like(own), where=own != 0.0), 0.0, 1.0)
    return out
