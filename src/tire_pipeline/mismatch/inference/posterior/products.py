"""Sums of products that hold all a recording says about a set, for every size of the misfit at once.

The coefficients and the formula's misfit are integrated out for each size on a grid. What is left are small
matrices, from which the evidence follows for any sizes of background and form error.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import scipy

from tire_pipeline.mismatch import settings
from tire_pipeline.mismatch.discrepancy.background import Background
from tire_pipeline.mismatch.inference.search_state import Search, nuisance_scale
from tire_pipeline.mismatch.model.forces import Change

Array = np.ndarray
_EVERY = 2
"""Of the sizes of the misfit that the search tries, each second one: they overlap."""


@dataclass(frozen=True)
class OfSet:
    """One set of effects: products of its columns, the form errors' columns and the residual.

    Parameters
    ----------
    changes : tuple of (name, parameters)
    parameters : int
        Columns of parameters, each times the spread of its prior; those of form errors follow, then the
        residual with all parameters at the centres of their priors.
    own : ndarray, shape (g, m, m)
        For each size of the misfit.
    with_background : ndarray, shape (g, b, m)
    power : float
        Log of the mean square of what the set leaves, in newtons, summed over outputs.
    """

    changes: tuple[Change, ...]
    parameters: int
    own: Array
    with_background: Array
    power: float = 0.0

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects, in alphabetical order."""
        return tuple(sorted(name for name, _ in self.changes))


@dataclass(frozen=True)
class OfCase:
    """What a recording says: the background's products and those of every set that was fitted.

    Parameters
    ----------
    families : tuple of str, length b
    background : ndarray, shape (g, b, b)
    log_determinant : ndarray, shape (g,)
        Of the coefficients and the misfit.
    sets : tuple of OfSet
        The empty one first.
    """

    families: tuple[str, ...]
    background: Array
    log_determinant: Array
    sets: tuple[OfSet, ...]


class RecordingProducts:
    """Makes the products of one recording.

    Parameters
    ----------
    search : Search
        Noise, misfit and how many samples make one independent one.
    background : Background
    """

    def __init__(self, search: Search, background: Background) -> None:
        self.search, self.families = search, background.families
        self.system = search.system
        self.inflation = search.inflation
        self._seen = self.system.whiten(background.columns)
        beside = {o: self.system.white[o].T @ self._seen[o] for o in self._seen}
        own = sum(x.T @ x for x in self._seen.values())
        self._grid = self._misfits()
        scales = [nuisance_scale(search.sizes, share, path) for share, path in self._grid]
        self._factors = [self._factored(scale) for scale in scales]
        self._beside = [self._solved(factor, beside) for factor in self._factors]
        self.background = np.stack(
            [(own - sum(beside[o].T @ solved[o] for o in beside)) / self.inflation for solved in self._beside]
        )
        self.log_determinant = np.array([determinant for *_, determinant in self._factors])

    def _misfits(self) -> list[tuple[float, float]]:
        """Sizes of the misfit and of its dependence on the way, over the largest force."""
        depends = any(size.path for size in self.search.sizes.values())
        paths = settings.PATH_SHARES[::_EVERY] if depends else settings.PATH_SHARES[:1]
        return [(share, path) for share in settings.MISFIT_SHARES[::_EVERY] for path in paths]

    def _factored(self, scale: dict[str, Array]) -> tuple[dict[str, Array], dict[str, Array], float]:
        """Return scales, Cholesky factors, and log determinant for one size of the misfit."""
        factors, total = {}, 0.0
        for o, s in scale.items():
            gram = self.system.gram(o) * s[:, None] * s[None, :] / self.inflation
            factors[o] = np.linalg.cholesky(gram + np.eye(s.size))
            total += 2.0 * float(np.log(np.diag(factors[o])).sum())
        return scale, factors, total

    def _solved(
        self, factor: tuple[dict[str, Array], dict[str, Array], float], beside: dict[str, Array]
    ) -> dict[str, Array]:
        """Return what takes the nuisance off products with it, for each output of shape (q, k)."""
        scale, factors, _ = factor
        return {
            o: scale[o][:, None]
            * scipy.linalg.cho_solve((factors[o], True), scale[o][:, None] * x / self.inflation)
            for o, x in beside.items()
        }

    def of(self, columns: dict[str, Array]) -> tuple[Array, Array]:
        """Return products of some columns with each other and with the background.

        Parameters
        ----------
        columns : dict of ndarray, shape (n, m)
            N.

        Returns
        -------
        ndarray, shape (g, m, m), ndarray, shape (g, b, m)
        """
        owns, acrosses = zip(*self._reduced(columns, range(len(self._factors))), strict=True)
        return np.stack(owns), np.stack(acrosses)

    def at_middle(self, columns: dict[str, Array]) -> tuple[Array, Array, Array]:
        """Return the products of :meth:`of`, and the background's, for the size that the search has taken."""
        search = self.search
        share = int(np.argmin(np.abs(np.log(np.array(self._grid)[:, 0] / search.misfit))))
        near = [k for k, (s, _) in enumerate(self._grid) if s == self._grid[share][0]]
        middle = min(near, key=lambda k: abs(np.log(self._grid[k][1] / max(search.path, 1e-9))))
        ((own, across),) = self._reduced(columns, [middle])
        return own, across, self.background[middle]

    def _reduced(self, columns: dict[str, Array], misfits: Iterable[int]) -> Iterator[tuple[Array, Array]]:
        """Yield the products of some columns, with each other and with the background, for some sizes."""
        white = self.system.whiten(columns)
        beside = {o: self.system.white[o].T @ x for o, x in white.items()}
        own = sum(x.T @ x for x in white.values())
        across = sum(self._seen[o].T @ x for o, x in white.items())
        for k in misfits:
            solved, seen = self._solved(self._factors[k], beside), self._beside[k]
            yield (
                (own - sum(beside[o].T @ solved[o] for o in white)) / self.inflation,
                (across - sum(seen[o].T @ beside[o] for o in white)) / self.inflation,
            )
