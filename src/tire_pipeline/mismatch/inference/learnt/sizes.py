"""Learnt numbers of the posterior: sizes of the background, of form errors and of the error, and odds."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from tire_pipeline.errors import RecordingError

Array = np.ndarray
EXPECTED = 4.0
"""Log odds of an effect of which physics leaves no doubt: 50 to 1. By hand: of 57 tuning cases that could
have such an effect one lacks it."""
_OF_NOISE = 0.5
"""Second differences take what changes from one sample to the next for noise, too."""


@dataclass(frozen=True)
class LearntSizes:
    """The learnt numbers.

    Parameters
    ----------
    background : mapping
        Family -> RMS that an effect of it has in a usual recording, over the largest force.
    form_error : float
        How wrong the form of a named effect is, as a share of it.
    prior : float
        Factor on the spread of all physical priors.
    independent, growth : float
        Of n seemingly independent samples ``independent * n ** growth`` count. What a model misses has a
        form, so the tenth sample of it says less than the first.
    error, spread : float
        Usual size of the error, over the largest force, and standard deviation of its logarithm.
    wide : float
        Size of unnamed physics, over the largest force.
    effect, further, unnamed : float
        Log odds of one effect, of each further one beside it, and of something unnamed.
    left : (float, float)
        Range that holds the error of two recordings in three, over the largest force, if nothing is assumed
        about it. Reports compare with it; no probability does.
    """

    background: Mapping[str, float]
    form_error: float
    prior: float
    independent: float
    error: float
    spread: float
    wide: float
    effect: float
    further: float
    unnamed: float
    left: tuple[float, float]
    growth: float = 1.0

    def count(self, independent: float) -> float:
        """Return how many of some seemingly independent samples count."""
        return min(self.independent * independent**self.growth, independent)

    def of(self, families: tuple[str, ...]) -> Array:
        """Return the standard deviation of each column of a background, shape (b,)."""
        usual = float(np.median(list(self.background.values())))
        return np.array([self.background.get(family, usual) for family in families])

    def log_prior(self, effects: Array, expected: Array, *, unnamed: Array, forms: Array) -> Array:
        """Return the log odds of some hypotheses.

        Parameters
        ----------
        effects : ndarray of int, shape (h,)
            Effects that physics does not lead one to expect.
        expected : ndarray of int, shape (h,)
            Effects of which physics leaves no doubt.
        unnamed : ndarray of bool, shape (h,)
            Whether something of any form is there.
        forms : ndarray of int, shape (h,)
            Where one unnamed form is there: of how many. All together are as likely as one effect.
        """
        count = effects + (forms > 0)
        found = self.effect * (count > 0) + self.further * np.maximum(count - 1, 0)
        return np.asarray(found + EXPECTED * expected + self.unnamed * unnamed - np.log(np.maximum(forms, 1)))

    def log_error(self, errors: Array, white: float, *, wide: bool) -> Array:
        """Return the log probability of each size of the error; where something is unnamed, all above usual.

        Where the white noise of a recording is larger than the usual error, its size is that of the noise.
        Something unnamed makes the error larger, never smaller: a recording that fits better than usual is
        no sign of it. What its probability loses below the usual size is not given to larger ones.
        """
        away = (np.log(errors) - np.log(max(self.error, _OF_NOISE * white))) / self.spread
        if wide:
            return np.asarray(-0.5 * np.minimum(away, 0.0) ** 2 - np.log(errors.size))
        value = -0.5 * away**2
        value = value - value.max()
        return np.asarray(value - np.log(np.exp(value).sum()))

    def to_dict(self) -> dict[str, Any]:
        """Return the numbers for a file."""
        return {**asdict(self), "background": dict(self.background), "left": list(self.left)}


def learnt(path: str | Path | None = None) -> LearntSizes:
    """Return the sizes that ship with the package, or those of a file of ``calibrate_mismatch``.

    Their provenance stands beside them in the file.

    Raises
    ------
    RecordingError
        The file is not there, or holds no learnt sizes.
    """
    shipped = resources.files("tire_pipeline.mismatch.inference.learnt").joinpath("learnt.json")
    try:
        text = (Path(path) if path else shipped).read_text(encoding="utf-8")
        sizes = json.loads(text)["sizes"]
        return LearntSizes(**{**sizes, "left": tuple(sizes["left"])})
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RecordingError(
            f"there are no learnt sizes ({error})",
            where=str(path or shipped),
            todo="use a file that kedro run --pipeline calibrate_mismatch has written",
        ) from error
