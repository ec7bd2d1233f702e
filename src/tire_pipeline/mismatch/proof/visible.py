"""How large an effect would have to be to be seen in a recording, and what size is ruled out.

Each size of each parameter is added to the residual. The log evidence of the set with the effect is compared
with that of the set without it, by the same likelihood and the same odds by which names are found. A size is
said to be seen only if the effect's own equation then beats its rivals, too: ``rivals.py``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from statistics import NormalDist

import numpy as np

from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.effects.amounts import amount, amount_with_interval
from tire_pipeline.mismatch.effects.base import Parameter
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.evidence.likelihood import Projected
from tire_pipeline.mismatch.inference.evidence.products import OfSet
from tire_pipeline.mismatch.inference.learnt.sizes import EXPECTED
from tire_pipeline.mismatch.inference.linearised_set import Fit
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.inference.sets.screen import screened_forms
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.channels import CHANCE, OF_INTERVAL
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate
from tire_pipeline.mismatch.proof.beside import Beside
from tire_pipeline.mismatch.proof.measured import Visible
from tire_pipeline.mismatch.proof.rivals import Rivals

Array = np.ndarray
_SEEN = NormalDist().inv_cdf(1.0 - CHANCE)
_SIZE_FACTOR = 1.2
"""Factor between the sizes that are tried beside an effect's rivals."""
_LARGER = 4.0
"""Factor between the sizes at which an effect that is not linear is looked at."""
_MOST_FORMS = 3
_SMALLEST_SIZE, _SIZES_TRIED, _HALVINGS = 1e-4, 97, 40
"""Sizes over the largest that the bounds allow: where the possible ones begin is looked for on 24 sizes a
decade, and between two of them to rounding."""
FALSE = 0.02
"""Level of the likelihood-ratio test over all of the catalogue: in so many recordings in which nothing is
missing something may be named (issue 24)."""


@dataclass(frozen=True)
class Sight:
    """What a recording shows of one parameter of an effect that is not named.

    Parameters
    ----------
    variant : Variant
        The effect's form.
    parameter : Parameter
    seen : float
        Smallest size that is named in 95% of repetitions; infinite if none within the bounds is.
    told : float
        The size that a likelihood-ratio test sees in 95% of the same repetitions which knows the form and the
        size of the residual, at the level ``FALSE`` over all of the catalogue; none
        that no tire has.
    value, error : float
        Estimate beside what is named, and its standard error.
    """

    variant: Variant
    parameter: Parameter
    seen: float
    told: float
    value: float
    error: float

    @property
    def form(self) -> dict[str, float]:
        """What says which form of the effect was looked at."""
        form = {p.name for p in self.variant.effect.parameters if p.form}
        return {k: float(v) for k, v in self.variant.start.items() if k in form and v}

    @property
    def ruled_out(self) -> float:
        """Size beyond which the 95% interval does not reach; infinite beyond the bounds."""
        value = max(self.value, 0.0) if self.parameter.one_sided else abs(self.value)
        size = value + OF_INTERVAL * self.error
        return size if size < largest(self.parameter) else np.inf

    def values(self, data: Data, size: float) -> dict[str, float]:
        """Return the effect's parameters where this one alone is off by some size."""
        zero = self.variant.effect.zeros(data)
        return {**zero, **self.form, self.parameter.name: zero[self.parameter.name] + size}


def largest(parameter: Parameter) -> float:
    """Return the largest size that is possible in both directions."""
    return min(abs(b - parameter.zero) for b in (parameter.low, parameter.high) if b != parameter.zero)


def sights(analysis: Analysis, enumerated: Enumerated, named: OfSet) -> Iterator[Sight]:
    """Yield what a recording shows of each parameter of each effect that is not named.

    Of several forms of one effect (references of a temperature, moments of a change) the one in the middle of
    three. Without parameters that only refine others, that can't stand alone, or that say which form it is.

    Parameters
    ----------
    analysis : Analysis
    enumerated : Enumerated
        Its sets, with the likelihood by which they were weighed.
    named : OfSet
        The set that is named.
    """
    scene = _Recorded(analysis, enumerated, named)
    for name in dict.fromkeys(v.name for v in analysis.variants):
        if name in named.names:
            continue
        effect = catalogue()[name]
        for p in effect.parameters:
            alone = not effect.needed or p.name in effect.needed
            if p.form or p.further or p.ratio or not alone:
                continue
            forms = [v for v in analysis.variants if v.name == name and p.name in v.free]
            picks = np.unique(np.linspace(0, len(forms) - 1, _MOST_FORMS + 2).astype(int)[1:-1])
            seen = [s for s in (scene.sight(forms[i], p) for i in picks if forms) if s is not None]
            if seen:
                yield sorted(seen, key=lambda s: s.seen)[(len(seen) - 1) // 2]


class _Recorded:
    """One recording beside the set that is named."""

    def __init__(self, analysis: Analysis, enumerated: Enumerated, named: OfSet) -> None:
        beside = Beside.of(enumerated, named)
        self.data, self.changes, self.products = analysis.data, list(named.changes), enumerated.products
        self.rest, self.own, self.likelihood = beside.rest, beside.columns, beside.likelihood
        self.scale, self.tailed = beside.scale, beside.tailed
        self.count = len({v.name for v in analysis.variants})
        learnt = enumerated.likelihood.learnt
        self.odds = {True: -EXPECTED, False: -(learnt.further if named.names else learnt.effect)}
        self.rivals = Rivals(analysis, enumerated.products, beside)

    def sight(self, variant: Variant, parameter: Parameter) -> Sight | None:
        """Return what shows of one parameter, or None if nothing does.

        The column is that of a finite size, the size that is seen: some effects are far from linear.
        """
        forms = screened_forms(self.data, [variant], self.changes)
        if not forms:
            return None
        (form,) = forms
        size, most = parameter.step, largest(parameter)
        out = Sight(variant, parameter, np.inf, np.inf, 0.0, np.inf)
        before = self._simulated(out, 0.0)
        column = self._column(out, size, before)
        while not any(np.any(c) for c in column.values()) and size < most:
            size = min(2.0 * size, most)  # a lag of less than a sample does nothing
            column = self._column(out, size, before)
        if not any(np.any(c) for c in column.values()):
            return None
        odds = self.odds[variant.effect.expected(self.data)]
        value, error, seen = self._weighed(column, form.columns, most, odds)
        while seen > most > size:  # ... and one of little more than a sample hardly anything
            size = min(_LARGER * size, most)
            there = self._column(out, size, before)
            if all(
                np.allclose(there[o], column[o], CHANCE, CHANCE * np.max(np.abs(there[o]))) for o in there
            ):
                break
            column = there
            value, error, seen = self._weighed(column, form.columns, most, odds)
        if seen <= most:  # the column of the size that is seen, from that of a smaller one
            column = self._column(out, seen, before)
            value, error, seen = self._weighed(column, form.columns, most, odds)
        if seen <= most:
            seen = self._beyond_rivals(out, seen, error, before)
        told = (_SEEN - float(NormalDist().inv_cdf(0.5 * FALSE / max(self.count, 1)))) * error
        return Sight(variant, parameter, self._possible(out, seen), self._possible(out, told), value, error)

    def _weighed(
        self, column: Mapping[str, Array], form: Mapping[str, Array], most: float, odds: float
    ) -> tuple[float, float, float]:
        """Return estimate and standard error of a size, and the size that is named in 95% of repetitions."""
        products = self.products.of(
            {o: np.column_stack([self.own[o], form[o], column[o], self.rest[o]]) for o in self.rest}
        )
        one = self.likelihood.projected(products)
        count, inner = self.scale.size, form[self.data.outputs[0]].shape[1]
        alone = one.take([*range(count), count + inner])
        wide = max(most, 1e-300)
        found = self.likelihood.evidence(
            alone, np.r_[self.scale, wide], tailed=np.r_[self.tailed, False], wide=True
        )
        value, error = float(found.mode[-1]), float(np.sqrt(found.covariance[-1, -1]))

        def gain(size: float) -> float:
            moved = _moved(one, size)
            with_it = self.likelihood.evidence(
                moved.take(range(count + inner)),
                np.r_[self.scale, np.full(inner, self.likelihood.learnt.prior)],
                tailed=np.r_[self.tailed, np.ones(inner, bool)],
            )
            without = self.likelihood.evidence(moved.take(range(count)), self.scale, tailed=self.tailed)
            return with_it.value - without.value

        low, high = 0.0, 3.0 * error
        while gain(high) <= odds:
            if not 0.0 < high <= most:
                return value, error, np.inf
            low, high = high, 2.0 * high
        while high - low > CHANCE * max(high, error):  # what is left unexplained may gain by itself
            middle = 0.5 * (low + high)
            low, high = (low, middle) if gain(middle) > odds else (middle, high)
        return value, error, high + _SEEN * error

    def _beyond_rivals(self, sight: Sight, seen: float, error: float, before: dict[str, Array]) -> float:
        """Return the smallest size from one on at which the effect is named, or infinity.

        What repetitions add to a size that is seen by itself they add to this one.
        """
        size = max(seen - _SEEN * error, 0.0)
        signs = (1.0,) if sight.parameter.one_sided else (1.0, -1.0)
        while size <= largest(sight.parameter):
            if all(self._named(sight, sign * size, before) for sign in signs):
                return max(size + _SEEN * error, seen)
            size = max(_SIZE_FACTOR * size, 0.5 * error)
        return float(np.inf)

    def _named(self, sight: Sight, size: float, before: dict[str, Array]) -> bool:
        """Whether an effect of some size, of either sign, is named beside its rivals."""
        change = self._simulated(sight, size)
        there = replace(sight.variant, start=sight.values(self.data, size))
        return self.rivals.named(there, {o: change[o] - before[o] for o in change})

    def _column(self, sight: Sight, size: float, before: dict[str, Array]) -> dict[str, Array]:
        there = self._simulated(sight, size)
        return {o: (there[o] - before[o]) / size for o in self.data.outputs}

    def _simulated(self, sight: Sight, size: float) -> dict[str, Array]:
        changes: list[Change] = [*self.changes, (sight.variant.name, sight.values(self.data, size))]
        return simulate(self.data, changes)

    def _possible(self, sight: Sight, size: float) -> float:
        """Return the smallest size from this one on that a tire or a rig can have, or infinity."""
        size = max(size, self._least(sight))
        possible = size <= largest(sight.parameter) and not self._outside(sight, size)
        return size if possible else np.inf

    def _least(self, sight: Sight) -> float:
        """Return the smallest size that a tire or a rig can have, whatever the recording shows."""
        sizes = np.geomspace(_SMALLEST_SIZE, 1.0, _SIZES_TRIED) * largest(sight.parameter)
        k = next((k for k, size in enumerate(sizes) if not self._outside(sight, size)), None)
        if not k:
            return 0.0 if k == 0 else np.inf
        low, high = float(sizes[k - 1]), float(sizes[k])
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self._outside(sight, middle) else (low, middle)
        return high

    def _outside(self, sight: Sight, size: float) -> bool:
        return sight.variant.effect.outside(self.data, sight.values(self.data, size))


def _moved(products: Projected, size: float) -> Projected:
    """Return products with a size of the last column but one put into the residual, which comes last."""
    count = next(iter(products.own.values())).shape[0]
    turn = np.delete(np.eye(count), count - 2, axis=1)
    turn[count - 2, -1] = size
    return Projected(
        {o: turn.T @ a @ turn for o, a in products.own.items()},
        {o: parts @ turn for o, parts in products.parts.items()},
    )


def visible(analysis: Analysis, enumerated: Enumerated, named: OfSet, *, unexplained: bool) -> list[Visible]:
    """Return what a recording shows of each effect of the catalogue.

    Parameters
    ----------
    analysis : Analysis
    enumerated : Enumerated
    named : OfSet
        The set that is named.
    unexplained : bool
        Whether there is an unexplained residual: then nothing is ruled out.
    """
    fit = analysis.fit
    rows = [_named(name, dict(values), fit, i) for i, (name, values) in enumerate(fit.changes)]
    found = list(sights(analysis, enumerated, named))
    said = {s.variant.name for s in found}
    out = [row for each in rows for row in each] + [_row(s, unexplained=unexplained) for s in found]
    for name, effect in catalogue().items():
        if name in said or name in fit.names:
            continue
        if not effect.parameters:
            text = "detected directly in the channels, whatever its size"
        else:
            text = f"{analysis.absent.get(name, 'this recording does not show it')}, nothing can be said"
        out.append(Visible(name, "", "", np.nan, np.nan, f"{effect.title}: {text}"))
    order = list(catalogue())
    return sorted(out, key=lambda row: order.index(row.name))


def _named(name: str, values: dict[str, float], fit: Fit, index: int) -> list[Visible]:
    """Rows of an effect that is named."""
    effect, rows = catalogue()[name], []
    for (i, parameter), error, ends in zip(fit.labels, fit.errors, fit.intervals, strict=True):
        if i != index:
            continue
        unit = effect.parameter(parameter).unit
        value, interval = amount_with_interval(values[parameter], error, ends, unit)
        text = f"{effect.title}: named, {parameter} {value} ({interval})"
        rows.append(Visible(name, parameter, unit, np.nan, np.nan, text))
    return rows


def _row(sight: Sight, *, unexplained: bool) -> Visible:
    """One row of an effect that is not named."""
    effect, parameter, unit = sight.variant.effect, sight.parameter.name, sight.parameter.unit
    seen, ruled_out = sight.seen, np.inf if unexplained else sight.ruled_out
    parts = []
    if np.isfinite(ruled_out):
        parts.append(f"changes above {amount(ruled_out, unit)} are ruled out")
    elif unexplained:
        parts.append("nothing is ruled out while there is an unexplained residual")
    else:
        parts.append("no size that is possible is ruled out")
    if np.isfinite(seen):
        parts.append(f"from {amount(seen, unit)} on it would be named")
    else:
        parts.append("no size that is possible would be named")
    text = f"{effect.title} ({parameter}): {'; '.join(parts)}"
    known = [x if np.isfinite(x) else np.nan for x in (seen, ruled_out)]
    return Visible(effect.name, parameter, unit, known[0], known[1], text, sight.form)
