"""Sums of products of terms, by fold, from which an equation is chosen and judged.

The whitened residual is ``r = E c + N d + noise`` with the terms' columns E, the nuisance columns N and
``d ~ N(0, scale^2)``. The nuisance is integrated out; sums are kept by fold, so that the choice can be
repeated without one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.analysis import inflation_of
from tire_pipeline.mismatch.model.channels import ENOUGH_ROWS
from tire_pipeline.mismatch.proof.nested import FOLDS
from tire_pipeline.mismatch.unnamed_physics.language.grammar import EquationError, evaluate, parse
from tire_pipeline.mismatch.unnamed_physics.library import WAY, Term
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import PRIOR_SIZE, Unexplained

Array = np.ndarray
_LEAST_SIZE = 1e-9
"""Root mean square over the largest force below which a term does nothing."""
_SINGULAR = 1e-12
"""Of a matrix of products, over its largest element."""


@dataclass(frozen=True)
class Reduced:
    """Information and score of terms under one size of the misfit, nuisance integrated out.

    ``information`` is (m, m), or (m,) where terms were looked at one by one.
    """

    information: Array
    score: Array
    log_weight: float


def definite(products: Array, prior: float) -> Array:
    """Return the precision of coefficients: products of their columns, and that of their prior.

    Beside the noise of an exact simulation the prior is below rounding, and two columns that are alike would
    leave the matrix singular.

    Parameters
    ----------
    products : ndarray, shape (..., k, k)
    prior : float
    """
    largest = np.max(np.diagonal(products, axis1=-2, axis2=-1), axis=-1, initial=0.0)
    least = prior + _SINGULAR * largest
    return np.asarray(products + np.eye(products.shape[-1]) * least[..., None, None])


@dataclass(frozen=True)
class Products:
    """Sums over folds for ``m`` terms, each scaled to the root mean square of the largest force.

    Parameters
    ----------
    size : ndarray, shape (m,)
        Root mean square of each term over the largest force, before it was scaled.
    ne, nr : mapping of ndarray, shapes (folds, q, m), (folds, q)
        Nuisance times terms, nuisance times residual, whitened.
    ee, er, rr : ndarray, shapes (folds, m, m) or (folds, m), (folds, m), (folds,)
    plain_ee, plain_er, plain_rr : the same in newtons over the mismatch of each output; not for single terms.
    """

    size: Array
    ne: Mapping[str, Array]
    nr: Mapping[str, Array]
    ee: Array
    er: Array
    rr: Array
    plain_ee: Array
    plain_er: Array
    plain_rr: Array


@dataclass(frozen=True)
class _Full:
    """A term over all rows, by output: whitened, in newtons, and times the nuisance by fold."""

    size: float
    white: dict[str, Array]
    plain: dict[str, Array]
    cross: dict[str, Array]


class Columns:
    """Columns of terms and their sums; what several terms share is evaluated once.

    Parameters
    ----------
    problem : Unexplained
    """

    def __init__(self, problem: Unexplained) -> None:
        self.problem = problem
        self._parts: dict[str, Array | None] = {}
        together = problem.block if problem.together is None else problem.together
        self.folds = np.unique(together, return_inverse=True)[1] % FOLDS
        self._fold = self.folds[problem.order]
        self._singles: dict[Term, tuple[Array, ...] | None] = {}
        self._factors: dict[tuple[int, int, bytes, str], tuple[Array, float]] = {}
        self._nn: dict[int, dict[str, Array]] = {}
        self._residual: dict[int, Products] = {}
        self._full: dict[Term, _Full | None] = {}
        self._white_rest: dict[str, Array] = {}
        self.stride = max(1, round(problem.table.size / ENOUGH_ROWS))

    @property
    def fold_of_sweep(self) -> Array:
        """The fold of each sweep, shape (sweeps,)."""
        return self.folds[np.unique(self.problem.block, return_index=True)[1]]

    def part(self, text: str) -> Array | None:
        """Return the value of an expression at each sample; None where it is not finite."""
        if text not in self._parts:
            try:
                self._parts[text] = evaluate(parse(text), self.problem.table)
            except EquationError:
                self._parts[text] = None
        return self._parts[text]

    def of(self, term: Term) -> dict[str, Array] | None:
        """Return a term's force in each output, N; None where it has no finite value."""
        product: Array | float = 1.0
        for factor in term.factors:
            value = self.part(factor.written)
            if value is None:
                return None
            product = product * value
        out = {}
        for o in self.problem.outputs:
            base = WAY[term.way].base.get(o)
            value = None if base is None else self.part(base)
            out[o] = np.zeros(self.problem.table.size) if value is None else value * product
        return out

    def screened(
        self, terms: Sequence[Term], inflation: float, kept: Array
    ) -> tuple[list[Term], list[Reduced]]:
        """Return the terms that do something, and what some folds (bool) say of each by itself."""
        every = self.stride
        new = [t for t in dict.fromkeys(terms) if t not in self._singles]
        for first in range(0, len(new), 100):
            batch = new[first : first + 100]
            there, sums = self._singly(batch, every)
            for i, term in enumerate(there):
                ne = [sums.ne[o][:, :, i] for o in self.problem.outputs]
                self._singles[term] = (sums.size[i], sums.ee[:, i], sums.er[:, i], *ne)
            self._residual[every] = sums
            self._singles.update({t: None for t in batch if t not in self._singles})
        known = {t: f for t in dict.fromkeys(terms) if (f := self._singles[t]) is not None}
        if not known:
            return [], []
        found = list(known.values())
        rest = self._residual[every]
        sums = Products(
            np.array([f[0] for f in found]),
            {o: np.stack([f[3 + j] for f in found], axis=2) for j, o in enumerate(self.problem.outputs)},
            rest.nr,
            np.stack([f[1] for f in found], axis=1),
            np.stack([f[2] for f in found], axis=1),
            rest.rr,
            rest.plain_ee,
            rest.plain_er,
            rest.plain_rr,
        )
        return list(known), self.reduced(sums, inflation, kept, every)

    def products(self, terms: Sequence[Term]) -> tuple[list[Term], Products]:
        """Return the terms that do something, and all their sums over all rows."""
        wanted = list(dict.fromkeys(terms))
        new = [t for t in wanted if t not in self._full]
        there, scaled, sizes = self.scaled(new)
        fresh: dict[Term, _Full] = {}
        for o, columns in scaled.items():
            white = self.problem.whiten(o, columns)
            crosses = np.stack([self.problem.nuisance[o][at].T @ white[at] for at in self._rows(1)])
            for i, term in enumerate(there):
                own = fresh.setdefault(term, _Full(sizes[i], {}, {}, {}))
                own.white[o], own.plain[o] = white[:, i], columns[self.problem.order, i]
                own.cross[o] = crosses[:, :, i]
        self._full.update({t: fresh.get(t) for t in new})
        live = [t for t in wanted if self._full[t] is not None]
        return live, self._multiplied([f for t in live if (f := self._full[t]) is not None])

    def reduced(self, sums: Products, inflation: float, kept: Array, every: int = 1) -> list[Reduced]:
        """Return what some folds (bool) say under each size of the misfit; weights are normalised."""
        single, out = sums.ee.ndim == 2, []
        for number, scale in enumerate(self.problem.sizes):
            information, score = sums.ee[kept].sum(axis=0), sums.er[kept].sum(axis=0)
            left, determinant = float(sums.rr[kept].sum()), 0.0
            for o, s in scale.items():
                factor, log_size = self._factor(number, every, kept, o)
                ne = sums.ne[o][kept].sum(axis=0) * s[:, None]
                nr = sums.nr[o][kept].sum(axis=0) * s
                solved = scipy.linalg.solve_triangular(factor, np.column_stack([ne, nr]), lower=True)
                e, r = solved[:, :-1], solved[:, -1]
                information = information - ((e**2).sum(axis=0) if single else e.T @ e)
                score = score - e.T @ r
                left -= float(r @ r)
                determinant += log_size
            weight = -0.5 * left / inflation - 0.5 * determinant
            out.append(Reduced(information / inflation, score / inflation, weight))
        most = np.logaddexp.reduce([r.log_weight for r in out])
        return [Reduced(r.information, r.score, float(r.log_weight - most)) for r in out]

    def inflation_beside(self, terms: Sequence[Term]) -> float:
        """Return how many whitened samples make one independent one beside some terms and the nuisance."""
        p = self.problem
        left: dict[str, Array] = {}
        for o in p.outputs:
            found = [self.of(term) for term in terms]
            columns = np.column_stack([f[o] for f in found if f is not None])
            size = np.sqrt(np.mean(columns**2, axis=0))
            live = size > _LEAST_SIZE * p.largest[o]
            columns = columns[:, live] * (PRIOR_SIZE * p.largest[o] / size[live])
            white = np.hstack([p.nuisance[o] * p.sizes[0][o], p.whiten(o, columns)])
            rest = p.whiten(o, p.rest[o][:, None])[:, 0]
            c = np.linalg.solve(white.T @ white + np.eye(white.shape[1]), white.T @ rest)
            back = np.empty_like(rest)
            back[p.order] = rest - white @ c
            left[o] = back
        return inflation_of(left, in_time="time" in p.moves)

    def _rows(self, every: int) -> list[Array]:
        return [np.flatnonzero(self._fold[::every] == f) * every for f in range(FOLDS)]

    def _factor(self, number: int, every: int, kept: Array, o: str) -> tuple[Array, float]:
        """Lower factor of the nuisance's matrix under one size, and its log determinant."""
        if every not in self._nn:
            white = self.problem.nuisance
            self._nn[every] = {
                name: np.stack([w[at].T @ w[at] for at in self._rows(every)]) * every
                for name, w in white.items()
            }
        key = (number, every, kept.tobytes(), o)
        if key not in self._factors:
            s = self.problem.sizes[number][o]
            a = self._nn[every][o][kept].sum(axis=0) * s[:, None] * s[None, :]
            lower = np.linalg.cholesky(definite(a, 1.0))
            self._factors[key] = (lower, 2.0 * float(np.log(np.diag(lower)).sum()))
        return self._factors[key]

    def scaled(
        self, terms: Sequence[Term], outputs: Sequence[str] = ()
    ) -> tuple[list[Term], dict[str, Array], list[float]]:
        """Return the terms that do something, and their columns in the size of the largest force.

        Parameters
        ----------
        terms : sequence of Term
        outputs : sequence of str
            Forces that they act on; all if left out.

        Returns
        -------
        list of Term
        dict of ndarray, shape (n, k)
            Output -> columns, N.
        list of float
            Root mean square of each term over the largest force, before it was scaled.
        """
        p, outputs = self.problem, outputs or self.problem.outputs
        live, columns, sizes = [], [], []
        for term in terms:
            column = self.of(term)
            if column is None:
                continue
            size = max(float(np.sqrt(np.mean(column[o] ** 2))) / p.largest[o] for o in outputs)
            if np.isfinite(size) and size > _LEAST_SIZE:
                live.append(term)
                sizes.append(size)
                columns.append({o: c / size for o, c in column.items()})
        empty = np.zeros((p.table.size, 0))
        stacked = {o: np.column_stack([c[o] for c in columns]) if columns else empty for o in outputs}
        return live, stacked, sizes

    def _singly(self, terms: Sequence[Term], every: int) -> tuple[list[Term], Products]:
        """Sums of terms one by one, over every so many rows."""
        p, rows = self.problem, self._rows(every)
        live, scaled, sizes = self.scaled(terms)
        m = len(live)
        ee, er, rr = np.zeros((FOLDS, m)), np.zeros((FOLDS, m)), np.zeros(FOLDS)
        ne, nr = {}, {}
        for o, columns in scaled.items():
            white, rest = p.whiten(o, columns), self._rest(o)
            crosses, own = [], []
            for f, at in enumerate(rows):
                w, r = white[at], rest[at]
                crosses.append(p.nuisance[o][at].T @ w)
                own.append(p.nuisance[o][at].T @ r)
                ee[f] += (w**2).sum(axis=0)
                er[f] += w.T @ r
                rr[f] += float(r @ r)
            ne[o], nr[o] = np.stack(crosses) * every, np.stack(own) * every
        none = np.zeros(0)
        return live, Products(np.array(sizes), ne, nr, ee * every, er * every, rr * every, none, none, none)

    def _rest(self, o: str) -> Array:
        """Whitened residual."""
        if o not in self._white_rest:
            self._white_rest[o] = self.problem.whiten(o, self.problem.rest[o][:, None])[:, 0]
        return self._white_rest[o]

    def _multiplied(self, full: Sequence[_Full]) -> Products:
        p, m, rows = self.problem, len(full), self._rows(1)
        ee, er, rr = np.zeros((FOLDS, m, m)), np.zeros((FOLDS, m)), np.zeros(FOLDS)
        plain_ee, plain_er, plain_rr = np.zeros_like(ee), np.zeros_like(er), np.zeros_like(rr)
        ne, nr = {}, {}
        for o in p.outputs:
            unit = max(float(np.sqrt(np.mean(p.rest[o] ** 2))), 1e-12)
            sides = [
                (np.column_stack([f.white[o] for f in full]), self._rest(o), ee, er, rr),
                (
                    np.column_stack([f.plain[o] for f in full]) / unit,
                    p.rest[o][p.order] / unit,
                    plain_ee,
                    plain_er,
                    plain_rr,
                ),
            ]
            for x, r, own, with_rest, alone in sides:
                for f, at in enumerate(rows):
                    own[f] += x[at].T @ x[at]
                    with_rest[f] += x[at].T @ r[at]
                    alone[f] += float(r[at] @ r[at])
            ne[o] = np.stack([f.cross[o] for f in full], axis=2)
            nr[o] = np.stack([p.nuisance[o][at].T @ self._rest(o)[at] for at in rows])
        size = np.array([f.size for f in full])
        return Products(size, ne, nr, ee, er, rr, plain_ee, plain_er, plain_rr)
