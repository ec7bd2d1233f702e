"""Physical priors of the parameters of a set, as the effects' files state them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change

Array = np.ndarray
Labels = Sequence[tuple[int, str]]


def prior(data: Data, changes: Sequence[Change], labels: Labels) -> tuple[Array, Array]:
    """Return how far the parameters of a set are from where their priors are centred, and the priors' spread.

    A parameter whose prior says nothing is centred where it is.

    Parameters
    ----------
    data : Data
    changes : sequence of (name, parameters)
    labels : sequence of (index of effect, parameter)

    Returns
    -------
    ndarray, shape (k,), ndarray, shape (k,)
    """
    off, wide = np.zeros(len(labels)), np.ones(len(labels))
    for row, (i, name) in enumerate(labels):
        effect, values = catalogue()[changes[i][0]], changes[i][1]
        centre, wide[row] = effect.usual(data, name)
        off[row] = 0.0 if np.isnan(centre) else values[name] - centre
    return off, wide
