"""The likelihood of a recording: everything linear is integrated out, the size of the error is unknown.

``y = J x + E e + Z c + error``, in units of the largest force of each output: ``x`` the parameters of a set
of effects (unit prior after scaling by their priors' spread), ``e`` the errors of their forms, ``c`` the
nuisance: coefficients, the formula's misfit, and a background of usual effects. The *error* is what this
model still misses. It is white and its size is unknown. Neighbouring samples of a real recording have similar
errors, so it counts for fewer independent samples than were recorded. The correlation of the residual says
how many are independent, and a learnt number of these counts. This is the one power to which the likelihood
is raised.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product

import numpy as np

from tire_pipeline.mismatch.discrepancy.nuisance.columns import Sizes
from tire_pipeline.mismatch.discrepancy.nuisance.sizes import nuisance_scale
from tire_pipeline.mismatch.inference.evidence.summed import summed
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes
from tire_pipeline.mismatch.inference.one_sided import log_possible
from tire_pipeline.mismatch.inference.tails import log_correction, widening
from tire_pipeline.mismatch.model.channels import DOES_NOTHING

Array = np.ndarray
MISFITS = (0.002, 0.006, 0.02)
"""Sizes of the formula's misfit over the largest force; all as likely beforehand."""
PATHS = (0.0005, 0.008)
"""Sizes of the misfit's difference between rising and falling slip."""
BACKGROUNDS = (0.3, 1.0)
"""Sizes of the background over the usual one: some rigs have hardly any, and its many directions show it."""
ERRORS = np.geomspace(2e-4, 0.4, 60)
"""Sizes of the error over the largest force over which it is summed."""
_ROUNDS_OF_CLIMBING = 4
"""At most: each round finds the sizes of misfit and error at the coefficients of the round before."""
_WIDER = 10.0
"""Times as wide as they are: from there priors with tails are tried, too. They can have a second mode, far
out."""


@dataclass(frozen=True)
class ColumnProducts:
    """Mean products of some columns, the residual last, with each other and with what is never known.

    Parameters
    ----------
    own : dict of ndarray, shape (m + 1, m + 1)
        For each output, over the square of its largest force.
    nuisance : dict of ndarray, shape (q, m + 1)
    """

    own: Mapping[str, Array]
    nuisance: Mapping[str, Array]

    def of_forces(self, forces: Collection[str]) -> ColumnProducts:
        """Return those of some of the forces."""
        return ColumnProducts(
            {o: a for o, a in self.own.items() if o in forces},
            {o: a for o, a in self.nuisance.items() if o in forces},
        )

    def take(self, columns: Sequence[int] | Array) -> ColumnProducts:
        """Return the products of some of the columns, with the residual."""
        last = next(iter(self.own.values())).shape[0] - 1
        picked = np.r_[np.asarray(columns, dtype=int), last]
        return ColumnProducts(
            {o: a[np.ix_(picked, picked)] for o, a in self.own.items()},
            {o: a[:, picked] for o, a in self.nuisance.items()},
        )


@dataclass(frozen=True)
class Projected:
    """Products of some columns as every size of the misfit weighs them.

    Parameters
    ----------
    own : dict of ndarray, shape (m + 1, m + 1)
    parts : dict of ndarray, shape (sizes, q, m + 1)
        For each output and each size, the products with the eigenvectors of what is never known.
    """

    own: Mapping[str, Array]
    parts: Mapping[str, Array]

    def take(self, columns: Sequence[int] | Array) -> Projected:
        """Return those of some of the columns, with the residual."""
        last = next(iter(self.own.values())).shape[0] - 1
        picked = np.r_[np.asarray(columns, dtype=int), last]
        return Projected(
            {o: a[np.ix_(picked, picked)] for o, a in self.own.items()},
            {o: np.take(parts, picked, axis=2) for o, parts in self.parts.items()},
        )


@dataclass(frozen=True)
class Unknown:
    """The nuisance in one recording: products of its columns, and their kinds.

    Parameters
    ----------
    gram : dict of ndarray, shape (q, q)
        Mean products of the columns of each output over the square of its largest force.
    sizes : dict of Sizes
        Numbers of columns of coefficients and misfit.
    families : tuple of str
        Of the background's columns, which follow them.
    samples : int
    independent : dict of float
        Samples of each output that are independent, by the correlation of the residual beside all that is
        looked for.
    white : dict of float
        White noise of neighbouring samples, RMS over the largest force.
    expected : frozenset of str
        Effects of which physics leaves no doubt in this recording.
    apart : float
        Share of the samples that were measured separately and do not follow the one before.
    steady : frozenset of str
        Channels that do not vary and that would tell effects apart.
    """

    gram: Mapping[str, Array]
    sizes: Mapping[str, Sizes]
    families: tuple[str, ...]
    samples: int
    independent: Mapping[str, float]
    white: Mapping[str, float] = field(default_factory=dict)
    expected: frozenset[str] = frozenset()
    apart: float = 0.0
    steady: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Weights:
    """How one output is weighted: by one size of the misfit and one of the error."""

    precision: float
    values: Array
    vectors: Array
    cell: int = 0
    """Number of the size of the misfit, among those of the likelihood."""

    def reduced(self, own: Array, nuisance: Array) -> Array:
        """Return products given what is never known, shape as ``own``."""
        return self.shrunk(own, self.vectors.T @ nuisance)

    def shrunk(self, own: Array, seen: Array) -> Array:
        """Return the same from the products with the eigenvectors of what is never known."""
        less = seen / (1.0 + self.precision * self.values)[:, None]
        return np.asarray(self.precision * own - self.precision**2 * seen.T @ less)

    def known(self, nuisance: Array) -> Array:
        """Return the mean of the coefficients of what is never known, given its products with a residual."""
        seen = self.vectors.T @ nuisance
        return np.asarray(self.vectors @ (self.precision * seen / (1.0 + self.precision * self.values)))


@dataclass(frozen=True)
class Evidence:
    """Log evidence of a set of columns, with mean and covariance of their coefficients, and the weights."""

    value: float
    mode: Array
    covariance: Array
    weights: Mapping[str, Weights]
    errors: Mapping[str, float]


class Likelihood:
    """Log evidence of columns in one recording.

    Parameters
    ----------
    unknown : Unknown
    learnt : LearntSizes
    """

    def __init__(self, unknown: Unknown, learnt: LearntSizes) -> None:
        self.unknown, self.learnt, self._each = unknown, learnt, False
        background = learnt.of(unknown.families)
        depends = any(size.path for size in unknown.sizes.values())
        self._cells: dict[str, list[tuple[Array, Array]]] = {o: [] for o in unknown.gram}
        for share, path, part in product(MISFITS, PATHS if depends else PATHS[:1], BACKGROUNDS):
            scale = nuisance_scale(dict(unknown.sizes), share, path)
            for o, gram in unknown.gram.items():
                s = np.r_[scale[o], part * background]
                values, vectors = np.linalg.eigh(gram * s[:, None] * s[None, :])
                self._cells[o].append((np.maximum(values, 0.0), s[:, None] * vectors))

    def counting(self, independent: Mapping[str, float], *, each: bool = False) -> Likelihood:
        """Return the same for another number of independent samples of each output.

        Parameters
        ----------
        independent : mapping of float
        each : bool
            Whether each of them counts, not as many as was learnt.
        """
        other = object.__new__(Likelihood)
        other.unknown, other.learnt = replace(self.unknown, independent=independent), self.learnt
        other._each = each
        other._cells = self._cells
        return other

    def at(self, weights: Mapping[str, Weights]) -> Likelihood:
        """Return the same with the misfit at one size for each output, that of some weights; much faster."""
        other = object.__new__(Likelihood)
        other.unknown, other.learnt, other._each = self.unknown, self.learnt, self._each
        other._cells = {o: [(w.values, w.vectors)] for o, w in weights.items()}
        return other

    @cached_property
    def count(self) -> Mapping[str, float]:
        """How many independent samples each output of the recording counts for.

        In a run as many as was learnt. Points of a test plan were measured separately, and each counts.
        """
        known = self.unknown.independent
        if self._each:
            return known
        apart = self.unknown.apart
        return {o: apart * n + (1.0 - apart) * self.learnt.count(n) for o, n in known.items()}

    def projected(self, products: ColumnProducts) -> Projected:
        """Return what :meth:`evidence` needs of some columns, for many choices among them."""
        return self.projected_together([products])[0]

    def projected_together(self, every: Sequence[ColumnProducts]) -> list[Projected]:
        """Return :meth:`projected` of each of many columns, of the same forces, by one large product.

        Columns that several of them have, of unnamed forms or of nothing, are projected once.
        """
        parts: list[dict[str, Array]] = [{} for _ in every]
        for o in every[0].own:
            different: dict[bytes, int] = {}
            which = [
                np.array(
                    [different.setdefault(column.tobytes(), len(different)) for column in each.nuisance[o].T]
                )
                for each in every
            ]
            whole = np.array([np.frombuffer(column) for column in different]).T
            seen = np.array([v.T @ whole for _, v in self._cells[o]])
            for part, columns in zip(parts, which, strict=True):
                part[o] = np.take(seen, columns, axis=2)
        return [Projected(each.own, part) for each, part in zip(every, parts, strict=True)]

    def evidence(
        self,
        products: ColumnProducts | Projected,
        scale: Array,
        *,
        tailed: Array | None = None,
        positive: Array | None = None,
        wide: bool = False,
    ) -> Evidence:
        """Return the log evidence of columns, by Laplace's approximation.

        Parameters
        ----------
        products : ColumnProducts or Projected
        scale : ndarray, shape (m,)
            Spreads of the coefficients' priors.
        tailed : ndarray of bool, shape (m,), optional
            Coefficients whose priors have tails; the others' are normal. All have, if left out.
        positive : ndarray of bool, shape (m,), optional
            Coefficients that are never negative. None, if left out.
        wide : bool
            Whether the error may be of any size, as it may if something is unnamed. If not, it is of the
            usual size.
        """
        known = products if isinstance(products, Projected) else self.projected(products)
        has_tails = np.ones(scale.size, bool) if tailed is None else tailed
        near, least_squares = self._climbed(known, scale, has_tails, 1.0, wide=wide)
        found = near
        if has_tails.any() and np.any(widening(least_squares[has_tails]) > 1.0):
            far, _ = self._climbed(known, scale, has_tails, _WIDER, wide=wide)
            found = max(near, far, key=lambda each: each.value)
        if positive is None or not positive.any():
            return found
        possible = log_possible(found.mode, found.covariance, positive)
        return replace(found, value=found.value + possible)

    def _climbed(
        self, known: Projected, scale: Array, has_tails: Array, start: float, *, wide: bool
    ) -> tuple[Evidence, Array]:
        """Return the evidence about the mode that is reached from one widening of the priors with tails.

        And what each coefficient would be by itself without its prior, over its spread: where none is in a
        tail, there is one mode.
        """
        z: Array = np.zeros(scale.size)
        times = np.where(has_tails, start, 1.0)
        for number in range(_ROUNDS_OF_CLIMBING):
            times = times if number == 0 else np.where(has_tails, widening(z), 1.0)
            spread = scale * times
            inner, aim = np.eye(scale.size), np.zeros(scale.size)
            total, power = 0.0, 0.0
            weights, errors = {}, {}
            u = np.append(-z * scale, 1.0)
            for o, own in known.own.items():
                grid, parts = self._grid[o], np.ascontiguousarray(known.parts[o])
                value, k, j = summed(own, parts, u, *grid, self._error_priors[o, wide])
                weights[o] = Weights(self.count[o] / ERRORS[j] ** 2, *self._cells[o][k], k)
                errors[o] = float(ERRORS[j])
                reduced = weights[o].shrunk(own, parts[k])
                inner += reduced[:-1, :-1] * spread[:, None] * spread[None, :]
                aim += reduced[:-1, -1] * spread
                power += float(reduced[-1, -1])
                total += value + 0.5 * float(u @ reduced @ u)
            before, z = z, times * np.linalg.solve(inner, aim)
            if np.max(np.abs(z - before), initial=0.0) < DOES_NOTHING:  # over their spreads
                break
        value = total - 0.5 * (power - float(aim @ (z / times))) - 0.5 * float(np.linalg.slogdet(inner)[1])
        value += log_correction(z[has_tails], times[has_tails])
        covariance = np.linalg.inv(inner) * spread[:, None] * spread[None, :]
        least_squares = times * aim / np.maximum(np.diag(inner) - 1.0, 1e-12)
        return Evidence(value, z * scale, covariance, weights, errors), least_squares

    @cached_property
    def _grid(self) -> Mapping[str, tuple[Array, Array, Array]]:
        """For each output what :func:`summed` needs and no residual changes."""
        out = {}
        for o, cells in self._cells.items():
            precision = self.count[o] / ERRORS**2
            inner = 1.0 + precision[None, :, None] * np.array([v for v, _ in cells])[:, None, :]
            size = 0.5 * np.log(inner).sum(axis=2) + self.count[o] * np.log(ERRORS)
            explains = 0.5 * precision[None, :, None] ** 2 / inner
            out[o] = (explains, -size - np.log(len(cells)), 0.5 * precision)
        return out

    @cached_property
    def _error_priors(self) -> Mapping[tuple[str, bool], Array]:
        """For each output, log density of each size of error: of any size, or of the usual one."""
        return {
            (o, wide): self.learnt.log_error(ERRORS, self.unknown.white.get(o, 0.0), wide=wide)
            for o in self._cells
            for wide in (False, True)
        }
