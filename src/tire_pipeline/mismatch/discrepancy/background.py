"""The background: small contributions of the catalogue's effects that every recording has.

A flat belt lags a little behind its slip, a small car's forces follow its speed a little, a load cell is a
little off. None of this is a finding. An effect is named if its size stands out against what is usual in its
family.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch.discrepancy import load_curvature
from tire_pipeline.mismatch.discrepancy.unnamed import forms
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray
Columns = Mapping[str, Array]
UNNAMED = "unnamed"
"""Family of the unnamed forms: rates, memory, play, what repeats along the road."""
_MOST_DIRECTIONS = 12
"""Of one effect's forms. They differ in one shape or two: the first directions hold nearly all of it."""
_LEAST_OF_FIRST = 0.02
"""Least variance of a direction over that of the first: one of a smaller share changes no evidence."""
_NO_COLUMN = 1e-9


@dataclass(frozen=True)
class Background:
    """Columns of the background, N.

    Parameters
    ----------
    columns : dict of ndarray, shape (n, b)
        Coefficients of standard deviation s give an effect an RMS of s times the largest force.
    families : tuple of str, length b
    forms : tuple of dict of ndarray, shape (n, k)
        The main directions of each unnamed form by itself, in the same measure.
    """

    columns: dict[str, Array]
    families: tuple[str, ...]
    forms: tuple[dict[str, Array], ...] = ()

    @property
    def unnamed(self) -> dict[str, Array]:
        """The columns of the unnamed forms."""
        which = np.array([family == UNNAMED for family in self.families], bool)
        return {o: x[:, which] for o, x in self.columns.items()}


def make_background(
    data: Data, screened: Iterable[tuple[str, Columns]], largest: Mapping[str, float]
) -> Background:
    """Return a few directions for each effect, for what the load leaves, and for all unnamed forms together.

    Parameters
    ----------
    data : Data
    screened : iterable of (name, columns)
        Each form of each effect with its columns, shape (n, k) for each output, N.
    largest : dict
        Largest force of each output, N.
    """
    ways: dict[str, list[Columns]] = {}
    for name, columns in screened:
        ways.setdefault(name, []).append(columns)
    ways[load_curvature.FAMILY] = load_curvature.load_curvature(data)
    ways[UNNAMED] = list(forms(data, []))
    parts: list[Columns] = []
    families: list[str] = []
    for name, own in ways.items():
        found = principal(own, largest)
        if found is None:
            continue
        parts.append(found)
        count = next(iter(found.values())).shape[1]
        families += [catalogue()[name].family if name in catalogue() else name] * count
    stacked = {o: np.hstack([np.zeros((data.size, 0)), *(p[o] for p in parts)]) for o in data.outputs}
    alone = (principal([form], largest) for form in ways[UNNAMED])
    return Background(stacked, tuple(families), tuple(form for form in alone if form is not None))


def principal(columns: Sequence[Columns], largest: Mapping[str, float]) -> dict[str, Array] | None:
    """Return the main directions of some columns, each of which may be of the same size.

    Parameters
    ----------
    columns : sequence of dict of ndarray, shape (n, k)
    largest : dict
        Unit of each output, N.

    Returns
    -------
    dict of ndarray, shape (n, m), or None
        With random coefficients of standard deviation 1 their RMS is ``largest``. None if nothing acts.
    """
    if not columns:
        return None
    outputs = list(columns[0])
    joined = np.vstack([np.hstack([c[o] / largest[o] for c in columns]) for o in outputs])
    size = np.sqrt(np.mean(joined**2, axis=0))
    joined = joined[:, size > _NO_COLUMN] / size[size > _NO_COLUMN]
    if joined.shape[1] == 0:
        return None
    values, vectors = np.linalg.eigh(joined.T @ joined / joined.shape[0])
    kept = [j for j in np.argsort(-values)[:_MOST_DIRECTIONS] if values[j] > _LEAST_OF_FIRST * values[-1]]
    found = joined @ vectors[:, kept] / np.sqrt(joined.shape[1])
    pieces = np.split(found, len(outputs))
    return {o: piece * largest[o] for o, piece in zip(outputs, pieces, strict=True)}
