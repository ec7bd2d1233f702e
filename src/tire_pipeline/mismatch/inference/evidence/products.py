"""Products of columns in one recording, in units of the largest force of each output."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from tire_pipeline.mismatch.discrepancy.background import Background
from tire_pipeline.mismatch.discrepancy.form_error import shape_columns
from tire_pipeline.mismatch.discrepancy.independent import independent, measured_apart, orders_of
from tire_pipeline.mismatch.discrepancy.noise import AS_STORED
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.evidence.likelihood import ColumnProducts, Evidence, Unknown
from tire_pipeline.mismatch.inference.linearised_set import columns_of
from tire_pipeline.mismatch.inference.priors import Labels, prior
from tire_pipeline.mismatch.model.channels import ENOUGH_ROWS, white_noise
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import residual, rms

Array = np.ndarray
Free = Sequence[tuple[str, ...]]


@dataclass(frozen=True)
class OfSet:
    """One set of effects where its fit has ended.

    Parameters
    ----------
    changes : tuple of (name, parameters)
    free : tuple of tuple of str
        Parameters of each effect that float.
    parameters : int
        Columns of parameters, each times the spread of its prior; those of form errors follow, then those of
        unnamed forms, then the residual with all parameters at the centres of their priors.
    errors : int
        Columns of form errors.
    products : ColumnProducts
    forms : tuple of int
        Columns of each unnamed form by itself, which come after those of all together; empty for sets that
        are too unlikely.
    spread : float
        Log of how much wider the moments at which forces jump spread than their derivatives say: these are
        spikes. It is added to the log evidence.
    """

    changes: tuple[Change, ...]
    free: tuple[tuple[str, ...], ...]
    parameters: int
    errors: int
    products: ColumnProducts
    forms: tuple[int, ...] = ()
    spread: float = 0.0

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects, in alphabetical order."""
        return tuple(sorted(name for name, _ in self.changes))

    @property
    def plain(self) -> ColumnProducts:
        """Products without the columns of unnamed forms."""
        return self.products.take(self.columns())

    @property
    def unnamed(self) -> int:
        """Columns of unnamed forms."""
        every = int(next(iter(self.products.own.values())).shape[0]) - 1
        return every - self.parameters - self.errors - sum(self.forms)

    def tailed(self, count: int) -> Array:
        """Return which of the first columns have priors with tails: the parameters, no errors of form."""
        return np.arange(count) < self.parameters

    def positive(self, count: int) -> Array:
        """Return which of the first columns have coefficients that are never negative."""
        never = [
            p.one_sided and p.prior > 0.0
            for (name, _), free in zip(self.changes, self.free, strict=True)
            for p in catalogue()[name].parameters
            if p.name in free
        ]
        return np.r_[never, np.zeros(count - self.parameters, bool)].astype(bool)

    def columns(self, *, wide: bool = False, form: int | None = None) -> Array:
        """Return the numbers of the set's columns, with all unnamed forms together or with one of them."""
        own = self.parameters + self.errors
        if wide:
            return np.arange(own + self.unnamed)
        if form is None:
            return np.arange(own)
        first = own + self.unnamed + sum(self.forms[:form])
        return np.r_[np.arange(own), first : first + self.forms[form]]


@dataclass(frozen=True)
class OfCase:
    """The nuisance of a recording, and every set that was fitted, the empty one first."""

    unknown: Unknown
    sets: tuple[OfSet, ...]


def rows_weighed(samples: int) -> Array:
    """Return the rows over which means of products are taken: of a long recording one of every two, three ...

    The residual of neighbouring samples is alike, so a recording counts for far fewer than it has. Which row
    of each group is chance: what turns at a frequency of its own does not meet the same phase.
    """
    every = max(1, round(samples / ENOUGH_ROWS))
    firsts = np.arange(0, samples - every + 1, every)
    return firsts + np.random.default_rng(0).integers(every, size=firsts.size)


class RecordingProducts:
    """Makes the products of one recording.

    Parameters
    ----------
    analysis : Analysis
        Noise and the columns of coefficients and misfit.
    background : Background
    """

    def __init__(self, analysis: Analysis, background: Background) -> None:
        self.analysis, self.data = analysis, analysis.data
        own = {o: rms(f) for o, f in self.data.recorded.items()}
        self.largest = {o: max(size, own[o]) for o, size in analysis.largest.items()}
        self.beside = {
            o: np.hstack([analysis.columns[o], background.columns[o]]) / self.largest[o]
            for o in self.data.outputs
        }
        self._unnamed, self._forms = background.unnamed, background.forms
        self.families = background.families
        self.rows = rows_weighed(self.data.size)
        self._beside = {o: z[self.rows] for o, z in self.beside.items()}
        self.gram = self.gram_of(np.ones(self.data.size, bool))

    def gram_of(self, kept: Array) -> dict[str, Array]:
        """Return the mean products of the nuisance over some samples (bool, shape (n,))."""
        parts = {o: z[kept[self.rows]] for o, z in self._beside.items()}
        return {o: z.T @ z / len(z) for o, z in parts.items()}

    @cached_property
    def _orders(self) -> list[Array]:
        return orders_of(self.data)

    def unknown(self, independent: Mapping[str, float]) -> Unknown:
        """Return the nuisance, with the number of samples of each output that are independent."""
        in_time, rest = self.data.time is not None, residual(self.data, [])
        white = {o: white_noise(r) / self.largest[o] if in_time else 0.0 for o, r in rest.items()}
        names = {v.name for v in self.analysis.variants}
        tells = {channel for n in names for channel in catalogue()[n].told_by.values()}
        return Unknown(
            self.gram,
            self.analysis.sizes,
            self.families,
            self.data.size,
            independent,
            white,
            expected=frozenset(n for n in names if catalogue()[n].expected(self.data)),
            apart=measured_apart(self.data),
            steady=frozenset(channel for channel in tells if not self.data.varies(channel)),
        )

    def independent(self, columns: Mapping[str, Array], found: Evidence) -> dict[str, float]:
        """Return how many samples of each output are independent, by the correlation of the residual.

        All are where no more than rounding is left: a simulation may be exact but for one effect.

        Parameters
        ----------
        columns : mapping of ndarray, shape (n, m + 1)
            All that is looked for, in N, the residual last.
        found : Evidence
            Of these columns.
        """
        out = {}
        for o, x in columns.items():
            left = x @ np.r_[-found.mode, 1.0] / self.largest[o]
            left = left - self.beside[o] @ found.weights[o].known(self.beside[o].T @ left / left.size)
            out[o] = independent(left, self._orders) if rms(left) > AS_STORED else float(left.size)
        return out

    def of(self, columns: Mapping[str, Array], rows: Array | None = None) -> ColumnProducts:
        """Return products of some columns in N, the residual last; shape (n, m + 1) for each output.

        Parameters
        ----------
        columns : mapping of ndarray
        rows : ndarray of bool, shape (n,), optional
            Samples over which the mean is taken; all that are weighed if left out.
        """
        own, nuisance = {}, {}
        for o, x in columns.items():
            scaled, beside = x[self.rows] / self.largest[o], self._beside[o]
            if rows is not None:
                scaled, beside = scaled[rows[self.rows]], beside[rows[self.rows]]
            own[o] = scaled.T @ scaled / len(scaled)
            nuisance[o] = beside.T @ scaled / len(scaled)
        return ColumnProducts(own, nuisance)

    def _with_unnamed(self, columns: Mapping[str, Array], before: int) -> ColumnProducts:
        """Return products of some columns with those of unnamed forms put in before one of them.

        The unnamed forms are the same beside every set: their own products are made once.
        """
        own, nuisance, alone = {}, {}, self.of(columns)
        for o, x in columns.items():
            forms, forms_own, forms_nuisance = self._unnamed_products[o]
            both = (x[self.rows] / self.largest[o]).T @ forms / len(forms)
            count = x.shape[1]
            order = np.r_[:before, count : count + forms.shape[1], before:count]
            own[o] = np.block([[alone.own[o], both], [both.T, forms_own]])[np.ix_(order, order)]
            nuisance[o] = np.hstack([alone.nuisance[o], forms_nuisance])[:, order]
        return ColumnProducts(own, nuisance)

    @cached_property
    def _unnamed_products(self) -> dict[str, tuple[Array, Array, Array]]:
        """The unnamed forms over the largest force, and their products with each other and the nuisance."""
        out = {}
        for o, x in self._unnamed.items():
            forms = x[self.rows] / self.largest[o]
            out[o] = (forms, forms.T @ forms / len(forms), self._beside[o].T @ forms / len(forms))
        return out

    @property
    def unnamed_forms(self) -> tuple[dict[str, Array], ...]:
        """The columns of each unnamed form by itself, N, each of shape (n, k)."""
        return self._forms

    def of_set(self, changes: Sequence[Change], free: Free) -> OfSet:
        """Return a set at given parameters, with columns for its form errors and for unnamed forms.

        Parameters
        ----------
        changes : sequence of (name, parameters)
        free : sequence of tuple of str
        """
        labels, every = self.columns_of_set(changes, free, self._nothing)
        before = every[self.data.outputs[0]].shape[1] - 1  # the residual comes last
        return self._set(changes, free, labels, before, self._with_unnamed(every, before))

    def of_effects(self, changes: Sequence[Change], free: Free, added: Mapping[str, Array]) -> OfSet:
        """Return a set as :meth:`of_set` does, without unnamed forms, where more was recorded.

        Parameters
        ----------
        changes : sequence of (name, parameters)
        free : sequence of tuple of str
        added : mapping of ndarray, shape (n,)
            What is recorded besides, N.
        """
        labels, every = self.columns_of_set(changes, free, self._nothing)
        for o, more in added.items():
            every[o][:, -1] += more
        before = every[self.data.outputs[0]].shape[1] - 1
        return self._set(changes, free, labels, before, self.of(every))

    def with_forms(self, each: OfSet) -> OfSet:
        """Return a set with the columns of every unnamed form by itself."""
        _, every = self.columns_of_set(each.changes, each.free)
        joined = {
            o: np.hstack([x[:, :-1], *(f[o] for f in self._forms), x[:, -1:]]) for o, x in every.items()
        }
        counts = tuple(next(iter(form.values())).shape[1] for form in self._forms)
        return replace(each, products=self.of(joined), forms=counts)

    def columns_of_set(
        self, changes: Sequence[Change], free: Free, unnamed: Mapping[str, Array] | None = None
    ) -> tuple[Labels, dict[str, Array]]:
        """Return the columns of a set, N, and which parameter each of the first ones is.

        Parameters, form errors, unnamed forms (those of the background if left out), and the residual.
        """
        data, unnamed = self.data, self._unnamed if unnamed is None else unnamed
        rest = residual(data, changes)
        labels, columns = columns_of(data, list(changes), list(free))
        off, wide = prior(data, changes, labels)
        shapes = [shape_columns(data, changes, i) for i in range(len(changes))]
        every = {}
        for o in data.outputs:
            errors = [
                part[o] if other == o else np.zeros_like(part[o]) for part in shapes for other in data.outputs
            ]
            every[o] = np.column_stack([columns[o] * wide, *errors, unnamed[o], rest[o] + columns[o] @ off])
        return labels, every

    @property
    def _nothing(self) -> dict[str, Array]:
        return {o: np.zeros((self.data.size, 0)) for o in self.data.outputs}

    @staticmethod
    def _set(
        changes: Sequence[Change], free: Free, labels: Labels, columns: int, products: ColumnProducts
    ) -> OfSet:
        copied = tuple((name, dict(values)) for name, values in changes)
        return OfSet(copied, tuple(free), len(labels), columns - len(labels), products)
