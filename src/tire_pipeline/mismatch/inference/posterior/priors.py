"""Physical priors of the parameters of a set, as the effects' files state them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.base import Parameter
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change

Array = np.ndarray
Labels = Sequence[tuple[int, str]]
_OF_UNIFORM = 12.0**-0.5


def spread(data: Data, parameter: Parameter) -> float:
    """Return the standard deviation of a parameter's prior; that of a uniform one where none is stated.

    Between the bounds, or between the ends of the recording for a moment in time.
    """
    if parameter.prior:
        return parameter.prior * (float(getattr(data, parameter.prior_in)) if parameter.prior_in else 1.0)
    width = parameter.high - parameter.low
    if parameter.unit == "s" and data.time is not None:
        width = min(width, float(data.time[-1] - data.time[0]))
    return width * _OF_UNIFORM


def prior(data: Data, changes: Sequence[Change], labels: Labels) -> tuple[Array, Array]:
    """Return how far the parameters of a set are from where their priors are centred, and the priors' spread.

    A parameter whose prior says nothing (0) is centred where it is.

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
        parameter = effect.parameter(name)
        wide[row] = spread(data, parameter)
        off[row] = values[name] - effect.zeros(data)[name] if parameter.prior else 0.0
    return off, wide
