"""Generalised least squares by sweeps: everything is computed from sums of products.

Per output the whitened residual is ``r = E x + N c + noise`` with effects' columns E, nuisance
columns N, prior ``c ~ N(0, diag(scale^2))`` and unit white noise. Sums over each sweep are kept, so
that leaving sweeps out costs nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from tire_pipeline.mismatch.discrepancy.noise import ForceNoise
from tire_pipeline.mismatch.effects.shared import njit
from tire_pipeline.mismatch.model.data import Data

Array = np.ndarray


@dataclass
class Sums:
    """Sums of products of effects' columns and residual over each sweep, one entry per output.

    Parameters
    ----------
    ne, nr : dict of ndarray, shapes (blocks or 1, q, k), (blocks or 1, q)
        Nuisance times effects, nuisance times residual; over the whole recording where sweeps are
        not left out.
    ee, er, rr : ndarray, shapes (blocks, k, k), (blocks, k), (blocks,)
        Sums over outputs.
    """

    ne: dict[str, Array]
    nr: dict[str, Array]
    ee: Array
    er: Array
    rr: Array


@njit(cache=True)
def _block_products(x: Array, edges: Array) -> Array:
    """Return ``x.T @ x`` over each stretch of rows between two edges, for few columns."""
    k = x.shape[1]
    out = np.zeros((edges.size - 1, k, k))
    for b in range(edges.size - 1):
        for i in range(edges[b], edges[b + 1]):
            for p in range(k):
                for q in range(p + 1):
                    out[b, p, q] += x[i, p] * x[i, q]
        for p in range(k):
            for q in range(p):
                out[b, q, p] = out[b, p, q]
    return out


class System:
    """Noise, nuisance columns and sweeps of one recording.

    Parameters
    ----------
    data : Data
    noise : dict of ForceNoise
    block : ndarray of int, shape (n,)
        Sweep of each sample.
    columns : dict of ndarray, shape (n, q)
        Nuisance columns, N.
    scale : dict of ndarray, shape (q,)
        Prior standard deviation of their coefficients.
    """

    def __init__(
        self,
        data: Data,
        noise: dict[str, ForceNoise],
        block: Array,
        columns: dict[str, Array],
        scale: dict[str, Array],
    ) -> None:
        self.data, self.noise, self.block = data, noise, block
        self.count = int(block.max()) + 1
        self._order: Any = np.argsort(block, kind="stable")
        if np.all(np.diff(self._order) == 1):
            self._order = slice(None)
        self._edges = np.searchsorted(np.sort(block), np.arange(self.count + 1))
        self.white = {o: noise[o].whiten(columns[o], data.start)[self._order] for o in data.outputs}
        self._gram = {o: self._by_block(w, w) for o, w in self.white.items()}
        self.scale = scale
        self._begin()
        self._factor()

    def rescaled(self, scale: dict[str, Array]) -> System:
        """Return the same system with other prior standard deviations."""
        other = object.__new__(System)
        other.__dict__.update(self.__dict__)
        other.scale = scale
        other._factor()
        return other

    def extended(self, columns: dict[str, Array], scale: dict[str, Array]) -> System:
        """Return the system with further nuisance columns."""
        other = object.__new__(System)
        other.__dict__.update(self.__dict__)
        other.white, other._gram = {}, {}
        for o in self.data.outputs:
            w = self.noise[o].whiten(columns[o], self.data.start)[self._order]
            cross = self._by_block(self.white[o], w)
            own = self._by_block(w, w)
            other.white[o] = np.hstack([self.white[o], w])
            top = np.concatenate([self._gram[o], cross], axis=2)
            bottom = np.concatenate([cross.transpose(0, 2, 1), own], axis=2)
            other._gram[o] = np.concatenate([top, bottom], axis=1)
        other.scale = {o: np.concatenate([self.scale[o], scale[o]]) for o in scale}
        other._begin()
        other._factor()
        return other

    def _by_block(self, a: Array, b: Array) -> Array:
        out = np.empty((self.count, a.shape[1], b.shape[1]))
        for k in range(self.count):
            piece = slice(self._edges[k], self._edges[k + 1])
            out[k] = a[piece].T @ b[piece]
        return out

    def _begin(self) -> None:
        """Sum over sweeps, and keep factors by scale: sizes are learnt by trying the same ones again."""
        self._total = {o: g.sum(axis=0) for o, g in self._gram.items()}
        self._factors: dict[tuple[str, bytes], Any] = {}

    def _factor(self) -> None:
        self._chol: dict[Any, Any] = {}
        for o, total in self._total.items():
            s = self.scale[o]
            key = (o, s.tobytes())
            if key not in self._factors:
                scaled = total * s[:, None] * s[None, :]
                self._factors[key] = scipy.linalg.cho_factor(scaled + np.eye(s.size))
            self._chol[o] = self._factors[key]

    def gram(self, output: str) -> Array:
        """Return the products of the whitened nuisance columns of an output, shape (q, q)."""
        return self._total[output]

    def whiten(self, x: dict[str, Array]) -> dict[str, Array]:
        """Return whitened arrays in the order of sweeps."""
        return {o: self.noise[o].whiten(x[o], self.data.start)[self._order] for o in x}

    def sums(self, residual: dict[str, Array], columns: dict[str, Array] | None = None) -> Sums:
        """Return the sums for a residual and effects' columns, both in N."""
        r = self.whiten(residual)
        e = {o: np.zeros((x.size, 0)) for o, x in r.items()} if columns is None else self.whiten(columns)
        return self._sums(r, e)

    def _sums(self, r: dict[str, Array], e: dict[str, Array], *, by_sweep: bool = False) -> Sums:
        k = next(iter(e.values())).shape[1]
        ne, nr = {}, {}
        ee, er, rr = np.zeros((self.count, k, k)), np.zeros((self.count, k)), np.zeros(self.count)
        for o, x in r.items():
            both = np.column_stack([e[o], x])
            cross = self._by_block(self.white[o], both) if by_sweep else (self.white[o].T @ both)[None]
            own = _block_products(np.ascontiguousarray(both), self._edges)
            ne[o], nr[o] = cross[:, :, :k], cross[:, :, k]
            ee += own[:, :k, :k]
            er += own[:, :k, k]
            rr += own[:, k, k]
        return Sums(ne, nr, ee, er, rr)

    def by_sweep(self, residual: dict[str, Array], columns: dict[str, Array]) -> Sums:
        """Return the sums of :meth:`sums` with those of the nuisance over each sweep as well."""
        return self._sums(self.whiten(residual), self.whiten(columns), by_sweep=True)

    def reduce(self, sums: Sums) -> tuple[Array, Array, float]:
        """Return S, s, J: information and score of the effects given the nuisance, and the misfit left.

        ``J = r' V^-1 r`` with V the covariance of noise and nuisance; ``x = S^-1 s``.
        """
        ee, er, rr = sums.ee.sum(axis=0), sums.er.sum(axis=0), float(sums.rr.sum())
        for o in sums.nr:
            s = self.scale[o]
            ne = sums.ne[o].sum(axis=0) * s[:, None]
            nr = sums.nr[o].sum(axis=0) * s
            solved = scipy.linalg.cho_solve(self._chol[o], np.column_stack([ne, nr]))
            ee = ee - ne.T @ solved[:, :-1]
            er = er - ne.T @ solved[:, -1]
            rr -= float(nr @ solved[:, -1])
        return 0.5 * (ee + ee.T), er, rr

    def log_determinant(self) -> float:
        """Log determinant of the prior-weighted nuisance, for the marginal likelihood."""
        return float(sum(2.0 * np.log(np.diag(c[0])).sum() for c in self._chol.values()))

    def fitted(self, residual: dict[str, Array], columns: dict[str, Array] | None = None) -> dict[str, Array]:
        """Return the coefficients of the nuisance columns in a fit with the effects' columns."""
        sums = self.sums(residual, columns)
        info, score, _ = self.reduce(sums)
        x = np.linalg.lstsq(info, score, rcond=1e-12)[0] if score.size else score
        out = {}
        for o in residual:
            s = self.scale[o]
            rest = sums.nr[o].sum(axis=0) - sums.ne[o].sum(axis=0) @ x
            out[o] = scipy.linalg.cho_solve(self._chol[o], rest * s) * s
        return out

    def left(self, residual: dict[str, Array], columns: dict[str, Array] | None = None) -> dict[str, Array]:
        """Return the whitened residual after nuisance and effects, in the order of time."""
        sums = self.sums(residual, columns)
        info, score, _ = self.reduce(sums)
        x = np.linalg.lstsq(info, score, rcond=1e-12)[0] if score.size else score
        r = self.whiten(residual)
        e = {} if columns is None else self.whiten(columns)
        out = {}
        for o, w in r.items():
            s = self.scale[o]
            rest = sums.nr[o].sum(axis=0) - sums.ne[o].sum(axis=0) @ x
            c = scipy.linalg.cho_solve(self._chol[o], rest * s) * s
            left = w - self.white[o] @ c
            if columns is not None:
                left = left - e[o] @ x
            back = np.empty_like(left)
            back[self._order] = left
            out[o] = back
        return out
