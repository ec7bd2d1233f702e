"""The choice repeated without each fifth of the sweeps: its residual on sweeps that it has not seen.

Sets are weighed again without a fold, and the set that is named then predicts the fold by parameters that it
has not fitted. Only which sets are weighed at all, and where each fit is linearised, has seen every sweep.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np

from tire_pipeline.mismatch.inference.evidence.likelihood import ColumnProducts, Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfCase, OfSet
from tire_pipeline.mismatch.inference.linearised_set import LOCKED
from tire_pipeline.mismatch.inference.priors import prior
from tire_pipeline.mismatch.inference.sets.answer import answered
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
Names = tuple[str, ...]
FOLDS = 5
"""Parts of the sweeps, each of which is predicted by what the others teach."""


@dataclass(frozen=True)
class Unseen:
    """Residuals of repeated choices.

    Parameters
    ----------
    left : dict of ndarray, shape (n,)
        Output -> residual, N, of each sweep by a choice and a fit that have not seen it.
    chosen : tuple of tuple of str
        Names that each fold was predicted with.
    """

    left: dict[str, Array]
    chosen: tuple[Names, ...]


class RepeatedChoice:
    """The choice made again without each fold; asked as often as what is added changes.

    Parameters
    ----------
    sets : Enumerated
        All sets that were fitted.
    block : ndarray of int, shape (n,)
        Sweep of each sample. Folds interleave sweeps; a recording of one sweep proves nothing.
    level : float
        Probability from which an effect, with its alternatives, is named.
    """

    def __init__(self, sets: Enumerated, block: Array, level: float) -> None:
        self._data = sets.products.data
        folds, self._fold = np.unique(block % FOLDS, return_inverse=True)
        self._every: list[ByFold] = []
        self._answers: list[tuple[Likelihood, OfCase, Names]] = []
        if folds.size < 2:
            return
        self._every = [ByFold(sets, each, self._fold) for each in sets.sets]
        for number in range(folds.size):
            likelihood = _without(sets, self._fold != number)
            case = OfCase(likelihood.unknown, tuple(each.without(number) for each in self._every))
            names = answered(case, likelihood.learnt, level, likelihood).names
            self._answers.append((likelihood, case, names))

    def unseen(self, withheld: Collection[str] = ()) -> Unseen:
        """Predict each fold with what is named without it.

        Parameters
        ----------
        withheld : collection of str
            Effects whose correction is not added: nothing is predicted of them.
        """
        left = residual(self._data, [])
        chosen: list[Names] = []
        for number, (likelihood, case, said) in enumerate(self._answers):
            names = tuple(name for name in said if name not in withheld)
            chosen.append(names)
            index = next((i for i, e in enumerate(case.sets) if e.names == tuple(sorted(names))), None)
            if not names or index is None:
                continue
            found = self._every[index].predicted(likelihood, case.sets[index])
            rows = self._fold == number
            for o in left:
                left[o][rows] = found[o][rows]
        return Unseen(left, tuple(chosen))


def _without(sets: Enumerated, kept: Array) -> Likelihood:
    """Return the likelihood of some rows."""
    unknown, share = sets.likelihood.unknown, float(kept.mean())
    gram = sets.products.gram_of(kept)
    independent = {o: share * n for o, n in unknown.independent.items()}
    fewer = replace(unknown, gram=gram, samples=int(kept.sum()), independent=independent)
    return Likelihood(fewer, sets.likelihood.learnt)


class ByFold:
    """One set of effects with the sums of its columns in each fold."""

    def __init__(self, sets: Enumerated, each: OfSet, fold: Array) -> None:
        self.products, self.each = sets.products, replace(each, forms=())
        self.likelihood = sets.likelihood
        self.count = np.bincount(fold[self.products.rows], minlength=int(fold.max()) + 1)
        _, columns = self.products.columns_of_set(each.changes, each.free)
        self.sums = [self.products.of(columns, fold == k) for k in range(self.count.size)]

    def without(self, fold: int) -> OfSet:
        """Return the set as the other folds show it."""
        kept = [k for k in range(self.count.size) if k != fold]
        weights = self.count[kept] / self.count[kept].sum()

        def mean(parts: list[Mapping[str, Array]]) -> dict[str, Array]:
            return {o: sum(w * part[o] for w, part in zip(weights, parts, strict=True)) for o in parts[0]}

        sums = [self.sums[k] for k in kept]
        products = ColumnProducts(mean([s.own for s in sums]), mean([s.nuisance for s in sums]))
        return replace(self.each, products=products)

    def predicted(self, likelihood: Likelihood, seen: OfSet) -> dict[str, Array]:
        """Return the residual of all rows, N, with parameters by the rows that were seen.

        From where the fit to all rows ended, they go as far as the likeliest parameters go when rows are left
        out. The linear step is asked for that change only: where a fit ended elsewhere than a linear model
        has its optimum, no such optimum is promised. They are weighed without errors of form, with priors of
        the learnt width and an error of any size. Those that one sweep determines stay where they are.
        """
        data, each = self.products.data, self.each
        labels, columns = self.products.columns_of_set(each.changes, each.free)
        off, wide = prior(data, each.changes, labels)
        change = self._likeliest(likelihood, seen) - self._likeliest(self.likelihood, each)
        locked = np.array([name in LOCKED for _, name in labels], bool)
        at = off / wide + np.where(locked, 0.0, change)
        return {o: x[:, -1] - x[:, : each.parameters] @ at for o, x in columns.items()}

    def _likeliest(self, likelihood: Likelihood, seen: OfSet) -> Array:
        """Parameters by some rows, in widths of their priors as the effects state them."""
        own = seen.products.take(np.arange(self.each.parameters))
        scale = np.full(self.each.parameters, likelihood.learnt.prior)
        return likelihood.evidence(own, scale, wide=True).mode
