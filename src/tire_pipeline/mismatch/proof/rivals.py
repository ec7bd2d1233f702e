"""Whether an effect of some size would be named: by its own equation, beside all that resembles it.

The effect is added to the residual. Its set is weighed where it is true, with the columns that any fitted set
has: all of its parameters, moments and lags among them, and what its form may get wrong. Its rivals are every
other effect in every form of it, linear as in the screen, every unnamed form, and nothing. The names follow
by the rules of ``answer.py``.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.evidence.hypotheses import NO_MASS, plain
from tire_pipeline.mismatch.inference.evidence.likelihood import Evidence, Projected
from tire_pipeline.mismatch.inference.evidence.products import RecordingProducts
from tire_pipeline.mismatch.inference.sets.answer import LEVEL, MOST_ALTERNATIVES, OPEN
from tire_pipeline.mismatch.inference.sets.screen import screened_forms
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.forces import Change
from tire_pipeline.mismatch.proof.beside import Beside

Array = np.ndarray


class Rivals:
    """The hypotheses that an effect has to beat in one recording, beside the set that is named.

    Parameters
    ----------
    analysis : Analysis
    products : RecordingProducts
    beside : Beside
        The set that is named.
    """

    def __init__(self, analysis: Analysis, products: RecordingProducts, beside: Beside) -> None:
        self.products, self.beside, self.rest = products, beside, beside.rest
        self.changes: list[Change] = list(beside.named.changes)
        others = [v for v in analysis.variants if v.name not in beside.named.names]
        forms = screened_forms(analysis.data, others, self.changes)
        parts = [*(form.columns for form in forms), *products.unnamed_forms]
        self.names = [*(form.variant.name for form in forms), *([""] * len(products.unnamed_forms))]
        own, counts = beside.scale.size, [part[analysis.data.outputs[0]].shape[1] for part in parts]
        rows = np.split(np.arange(own, own + sum(counts)), np.cumsum(counts)[:-1])
        self.picks = [np.r_[np.arange(own), added] for added in rows]
        columns = {o: np.hstack([x, *(p[o] for p in parts)]) for o, x in beside.columns.items()}
        base = products.of({o: np.column_stack([x, self.rest[o]]) for o, x in columns.items()})
        self.base = beside.likelihood.projected(base)
        self.columns = {o: x[products.rows] for o, x in columns.items()}
        self.odds = self._odds()

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
        own = truth.value + self.odds[variant.name]
        value = self._rivals({o: self.rest[o] + added[o] for o in self.rest}, truth, variant.name, own)
        if value is None:
            return False
        value[variant.name] = own
        total = float(scipy.special.logsumexp(list(value.values())))
        effects = sorted((n for n in value if n), key=lambda n: -value[n])
        group = [n for n in effects[: 1 + MOST_ALTERNATIVES] if value[n] > value[effects[0]] + np.log(OPEN)]
        sure = float(scipy.special.logsumexp([value[n] for n in group])) - total
        return variant.name in group and sure > np.log(LEVEL)

    def _truth(self, variant: Variant, added: Mapping[str, Array]) -> Evidence:
        """Return what the recording says of the effect itself, where its fit would end."""
        changes: list[Change] = [*self.changes, (variant.name, dict(variant.start))]
        each = self.products.of_effects(changes, [*self.beside.named.free, variant.free], added)
        return plain(self.beside.likelihood, each)

    def _rivals(
        self, rest: Mapping[str, Array], truth: Evidence, name_of_truth: str, own: float
    ) -> dict[str, float] | None:
        """Return log evidence and odds of each rival; nothing and all unnamed forms together are "".

        Of an effect the form counts whose columns take most from the residual, as precisely as the truth
        leaves it. Rivals are left out that stay far below the truth's ``own`` even so. None as soon as one of
        them, the strongest first, is so far above it that the truth is not named whatever the others are.
        """
        beside = self.beside
        likelihood, scale, tailed, positive = beside.likelihood, beside.scale, beside.tailed, beside.positive
        moved = self._with_residual(rest)
        alone = moved.take(range(scale.size))
        nothing = likelihood.evidence(alone, scale, tailed=tailed, positive=positive).value
        value: dict[str, float] = {"": nothing}
        above = own - np.log(OPEN)
        unsure = above + np.log((1 + MOST_ALTERNATIVES) * (1.0 - LEVEL) / LEVEL)
        each = [
            truth.weights[o].shrunk(products, moved.parts[o][truth.weights[o].cell])
            for o, products in moved.own.items()
        ]
        reduced = np.sum(each, axis=0)
        most = {k: _most(reduced, pick) for k, pick in enumerate(self.picks)}
        forms: dict[str, list[int]] = {}
        for k in most:
            forms.setdefault(self.names[k] or str(k), []).append(k)
        best = [max(alike, key=most.__getitem__) for alike in forms.values()]
        for k in sorted(best, key=lambda k: -most[k] - self.odds[self.names[k]]):
            pick, name, odds = self.picks[k], self.names[k], self.odds[self.names[k]]
            if nothing + most[k] + odds < own - NO_MASS:
                break
            if name == name_of_truth:
                continue
            more = pick.size - scale.size
            spread = likelihood.learnt.prior if name else likelihood.learnt.wide
            found = likelihood.evidence(
                moved.take(pick),
                np.r_[scale, np.full(more, spread)],
                tailed=np.r_[tailed, np.full(more, bool(name))],
                positive=np.r_[positive, np.zeros(more, bool)],
            ).value
            value[name] = found + odds if name else float(np.logaddexp(value[""], found + odds))
            if (name and value[name] >= above) or value[""] > unsure:
                return None  # ``named`` says no from here on, whatever the others are worth
        return value

    def _odds(self) -> dict[str, float]:
        """Return the log odds of each effect beside the named set; of one unnamed form by ""."""
        expected = self.beside.likelihood.unknown.expected
        before = len(set(self.beside.named.names) - expected)
        # nothing more, one effect more, an expected one, an unnamed form
        forms = np.array([0, 0, 0, self.names.count("")])
        nothing, effect, sure, form = self.beside.likelihood.learnt.log_prior(
            np.array([before, before + 1, before, before]),
            np.array([0, 0, 1, 0]),
            unnamed=np.zeros(forms.size, bool),
            forms=forms,
        )
        odds = {name: float((sure if name in expected else effect) - nothing) for name in self.names if name}
        return {**odds, "": float(form - nothing)}

    def _with_residual(self, rest: Mapping[str, Array]) -> Projected:
        """Return the products of all columns with another residual, N."""
        alone = self.products.of({o: y[:, None] for o, y in rest.items()})
        residual = self.beside.likelihood.projected(alone)
        own, parts = {}, {}
        for o, y in rest.items():
            own[o] = self.base.own[o].copy()
            seen = y[self.products.rows]
            own[o][:-1, -1] = own[o][-1, :-1] = (
                self.columns[o].T @ seen / (seen.size * self.products.largest[o] ** 2)
            )
            own[o][-1, -1] = residual.own[o][0, 0]
            parts[o] = np.concatenate([self.base.parts[o][:, :, :-1], residual.parts[o]], axis=2)
        return Projected(own, parts)


def _most(reduced: Array, pick: Array) -> float:
    """Return what some columns of unit spread take at most from half of the squared residual."""
    aim = reduced[pick, -1]
    return 0.5 * float(aim @ np.linalg.solve(reduced[np.ix_(pick, pick)] + np.eye(pick.size), aim))
