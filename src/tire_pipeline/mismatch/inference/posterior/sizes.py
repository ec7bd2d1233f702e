"""What the posterior has learnt: sizes of the background, of form errors, odds, and one exponent."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib import resources
from typing import Any

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class LearntSizes:
    """The learnt numbers.

    Parameters
    ----------
    background : mapping
        Family -> RMS that an effect of it has in a usual recording, over the largest force.
    form_error : float
        How wrong the form of a named effect is, as a share of it.
    tails : float
        Degrees of freedom of the background: how seldom it is many times as large as usual.
    wide : float
        How many times the background something without a name is.
    prior : float
        Factor on the spread of all physical priors.
    exponent : float
        Power of the evidence, for what the model still gets wrong.
    samples : float
        Independent samples for which the mean square of what is left counts, in newtons.
    effect, further, unnamed : float
        Log odds of one effect, of each further one beside it, and of something without a name.
    """

    background: Mapping[str, float]
    form_error: float
    tails: float
    wide: float
    prior: float
    exponent: float
    samples: float
    effect: float
    further: float
    unnamed: float

    def of(self, families: tuple[str, ...]) -> Array:
        """Return the standard deviation of each column of a background, shape (b,)."""
        usual = float(np.median(list(self.background.values())))
        return np.array([self.background.get(family, usual) for family in families])

    def log_prior(self, count: int, *, unnamed: bool) -> float:
        """Return the log odds of a set of ``count`` effects, with something unnamed or without."""
        named = self.effect * (count > 0) + self.further * max(count - 1, 0)
        return named + self.unnamed * unnamed

    def to_dict(self) -> dict[str, Any]:
        """Return the numbers for a file."""
        return {**asdict(self), "background": dict(self.background)}


def learnt() -> LearntSizes:
    """Return the sizes that ship with the package; their provenance stands beside them in the file."""
    package = "tire_pipeline.mismatch.inference.posterior"
    text = resources.files(package).joinpath("learnt.json").read_text(encoding="utf-8")
    return LearntSizes(**json.loads(text)["sizes"])
