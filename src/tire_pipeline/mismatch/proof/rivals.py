"""Whether an effect of some size would be named: by its own equation, beside all that resembles it.

The effect is put into what is left. Its set is weighed where it is true, with the columns that any fitted set
has: all of its parameters, moments and lags among them, and what its form may get wrong. Its rivals are every
other effect in every form of it, linear as in the screen, every unnamed form, and nothing. The names follow
by the rules of ``answer.py``.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.evidence.hypotheses import Asked, plain, scales
from tire_pipeline.mismatch.inference.evidence.likelihood import ColumnProducts, Evidence
from tire_pipeline.mismatch.inference.evidence.products import OfSet
from tire_pipeline.mismatch.inference.sets.answer import LEVEL, MOST_ALTERNATIVES, OPEN
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.inference.sets.screen import screened_forms
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
_NO_RIVAL = 8.0
"""Log evidence by which a rival may stay behind without a part in the answer."""


class Rivals:
    """All that an effect has to beat in one recording beside the set that is named.

    Parameters
    ----------
    analysis : Analysis
    enumerated : Enumerated
        Its sets, with the likelihood by which they were weighed.
    named : OfSet
        The set that is named.
    """

    def __init__(self, analysis: Analysis, enumerated: Enumerated, named: OfSet) -> None:
        self.products, self.named_set = enumerated.products, named
        self.changes: list[Change] = list(named.changes)
        self.likelihood = enumerated.likelihood.at(plain(enumerated.likelihood, named).weights)
        self.learnt = enumerated.likelihood.learnt
        self.rest = residual(analysis.data, self.changes)
        own = named.parameters + named.errors
        columns = self.products.columns_of_set(named.changes, named.free)
        others = [v for v in analysis.variants if v.name not in named.names]
        forms = screened_forms(analysis.data, others, self.changes)
        unnamed = enumerated.products.unnamed_forms
        parts = [*(form.columns for form in forms), *unnamed]
        counts = [part[analysis.data.outputs[0]].shape[1] for part in parts]
        self.columns = {o: np.hstack([columns[o][:, :own], *(p[o] for p in parts)]) for o in self.rest}
        self.base = self.products.of({o: np.column_stack([x, self.rest[o]]) for o, x in self.columns.items()})
        self.picks = [
            np.r_[np.arange(own), rows]
            for rows in np.split(np.arange(own, own + sum(counts)), np.cumsum(counts)[:-1])
        ]
        self.names = [*(form.variant.name for form in forms), *([""] * len(unnamed))]
        self.own_scale, self.own_tailed = scales(named, self.learnt)[:own], named.tailed(own)

    def named(self, variant: Variant, added: Mapping[str, Array]) -> bool:
        """Whether an effect is named, first or as an alternative, where it is there as a variant states it.

        Parameters
        ----------
        variant : Variant
            With the true parameters.
        added : mapping of ndarray, shape (n,)
            What it adds to each force, N.
        """
        truth = self._truth(variant, added)
        own = truth.value + self._odds(variant.name)
        value = self._rivals({o: self.rest[o] + added[o] for o in self.rest}, truth, own - _NO_RIVAL)
        value[variant.name] = own
        total = float(scipy.special.logsumexp(list(value.values())))
        effects = sorted((n for n in value if n), key=lambda n: -value[n])
        group = [n for n in effects[: 1 + MOST_ALTERNATIVES] if value[n] > value[effects[0]] + np.log(OPEN)]
        sure = float(scipy.special.logsumexp([value[n] for n in group])) - total
        return variant.name in group and sure > np.log(LEVEL)

    def _truth(self, variant: Variant, added: Mapping[str, Array]) -> Evidence:
        """Return what the recording says of the effect itself, where its fit would end."""
        changes: list[Change] = [*self.changes, (variant.name, dict(variant.start))]
        each = self.products.of_set(changes, [*self.named_set.free, variant.free], added)
        return plain(self.likelihood, each)

    def _rivals(self, rest: Mapping[str, Array], truth: Evidence, least: float) -> dict[str, float]:
        """Return log evidence and odds of each rival; nothing and all unnamed forms together are "".

        Of an effect the form counts whose columns take most from what is left, as precisely as the truth
        leaves it. Rivals are left out that stay below ``least`` even so.
        """
        moved = self.likelihood.projected(self._with_residual(rest))
        count = self.own_scale.size
        nothing = self.likelihood.evidence(
            moved.take(range(count)), self.own_scale, tailed=self.own_tailed
        ).value
        value: dict[str, float] = {"": nothing}
        each = [truth.weights[o].shrunk(own, moved.parts[o][0]) for o, own in moved.own.items()]
        reduced = np.sum(each, axis=0)
        most = {k: _most(reduced, pick) for k, pick in enumerate(self.picks)}
        forms: dict[str, list[int]] = {}
        for k in most:
            forms.setdefault(self.names[k] or str(k), []).append(k)
        for alike in forms.values():
            k = max(alike, key=most.__getitem__)
            pick, name, odds = self.picks[k], self.names[k], self._odds(self.names[k])
            if nothing + most[k] + odds < least:
                continue
            more = pick.size - count
            spread = self.learnt.prior if name else self.learnt.wide
            found = self.likelihood.evidence(
                moved.take(pick),
                np.r_[self.own_scale, np.full(more, spread)],
                tailed=np.r_[self.own_tailed, np.full(more, bool(name))],
            ).value
            value[name] = found + odds if name else float(np.logaddexp(value[""], found + odds))
        return value

    @cache  # noqa: B019 - a scene lives as long as one report is made
    def _odds(self, name: str) -> float:
        """Return the log odds of an effect, or of one unnamed form, beside the named set."""
        expected = name in self.likelihood.unknown.expected
        sure = len(self.likelihood.unknown.expected & set(self.named_set.names))
        before = len(self.named_set.names) - sure
        forms = 0 if name else self.names.count("")
        asked = [
            Asked(np.array([before + more]), np.array([sure + plus]), np.array([False]), np.array([form]))
            for more, plus, form in ((not expected and bool(name), expected, forms), (0, 0, 0))
        ]
        with_it, without = (float(a.log_prior(self.learnt)[0]) for a in asked)
        return with_it - without

    def _with_residual(self, rest: Mapping[str, Array]) -> ColumnProducts:
        """Return the products of all columns with another residual, N."""
        own, nuisance = {}, {}
        for o, y in rest.items():
            one = self.products.of({o: np.column_stack([self.columns[o], y])[:, -1:]})
            cross = self.columns[o].T @ y / (y.size * self.products.largest[o] ** 2)
            own[o], nuisance[o] = self.base.own[o].copy(), self.base.nuisance[o].copy()
            own[o][:-1, -1] = own[o][-1, :-1] = cross
            own[o][-1, -1] = one.own[o][0, 0]
            nuisance[o][:, -1] = one.nuisance[o][:, 0]
        return ColumnProducts(own, nuisance)


def _most(reduced: Array, pick: Array) -> float:
    """Return what some columns of unit spread take at most from half of the squared residual."""
    aim = reduced[pick, -1]
    return 0.5 * float(aim @ np.linalg.solve(reduced[np.ix_(pick, pick)] + np.eye(pick.size), aim))
