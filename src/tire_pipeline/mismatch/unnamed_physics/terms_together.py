"""Where an equation of several terms was seen to hold: at sizes of theirs that came together."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tire_pipeline.mismatch.model.channels import DOES_NOTHING, largest
from tire_pipeline.mismatch.unnamed_physics.language.grammar import number

Array = np.ndarray


def distance(terms: Mapping[str, Array]) -> tuple[str, float] | None:
    """Return how far the terms of an equation are out together, and the most that was recorded of it.

    Two terms may cancel wherever they grew together, and only there: at high speed with a small slip angle,
    where each by itself was recorded, nothing says what is left of them. The distance is that of
    Mahalanobis, from zero: the square root of the leverage that a sample would have in the fit.

    Parameters
    ----------
    terms : mapping of ndarray, shape (n,)
        Text of a term -> its values in the recording, N.

    Returns
    -------
    (str, float) or None
        The distance as an expression of the grammar, and what 99% of the samples stay below. None for a
        single term: how large that may be, the ranges of its channels say.
    """
    if len(terms) < 2:
        return None
    x = np.column_stack(list(terms.values()))
    sizes, directions = np.linalg.eigh(x.T @ x / len(x))
    white = directions / np.sqrt(np.maximum(sizes, DOES_NOTHING**2 * sizes[-1]))
    forms = [
        " + ".join(f"{number(float(w))}*{text}" for w, text in zip(form, terms, strict=True))
        for form in white.T
    ]
    text = "sqrt(" + " + ".join(f"({form})^2" for form in forms) + ")"
    return text, largest(np.linalg.norm(x @ white, axis=1))
