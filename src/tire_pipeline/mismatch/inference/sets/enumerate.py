"""Enumerate sets: singles and pairs of the effects that the screen keeps, triples from the likeliest pairs,
and those that differ from the likeliest by an effect that looks alike."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tire_pipeline.mismatch.discrepancy.background import make_background
from tire_pipeline.mismatch.effects import look_alike
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.evidence.hypotheses import NO_MASS, log_prior, plain_evidence
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfCase, OfSet, RecordingProducts
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes
from tire_pipeline.mismatch.inference.sets.fitting import fitted
from tire_pipeline.mismatch.inference.sets.screen import EFFECTS_KEPT, Screened, screen, screened_forms
from tire_pipeline.mismatch.model.candidates import Variant
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
Names = tuple[str, ...]
TRIPLES = EFFECTS_KEPT // 2
"""Sets that are fitted by their own equations; the screen has scored all singles and pairs."""
_INDEPENDENT = 100.0
"""Independent samples, to begin with: how many there are is known only beside the effects."""


@dataclass(frozen=True)
class Enumerated:
    """Every set that was fitted, and what it is weighed by."""

    products: RecordingProducts
    likelihood: Likelihood
    sets: tuple[OfSet, ...]

    @property
    def case(self) -> OfCase:
        """The part of a recording that learning needs."""
        return OfCase(self.likelihood.unknown, self.sets)

    def with_mass(self, probabilities: Mapping[Names, float], named: Collection[str]) -> Enumerated:
        """Return only the sets that have mass, and what remains of a named one without some of its effects.

        Parameters
        ----------
        probabilities : mapping
            Set of names -> probability.
        named : collection of str
        """
        least = max(probabilities.values()) * np.exp(-NO_MASS)
        likely = {names for names, p in probabilities.items() if p > least}
        kept = [s for s in self.sets if s.names in likely or set(s.names) <= set(named)]
        return replace(self, sets=tuple(kept))

    def log_evidence_of(self, columns: Mapping[str, Array], spread: float) -> float:
        """Return the log evidence of some columns in place of effects.

        Parameters
        ----------
        columns : mapping of ndarray, shape (n, k)
            Output -> columns, N.
        spread : float
            Standard deviation of their coefficients, which are normal.
        """
        rest = residual(self.products.data, [])
        every = {o: np.column_stack([x, rest[o]]) for o, x in columns.items()}
        count = next(iter(columns.values())).shape[1]
        scale, tailed = np.full(count, spread), np.zeros(count, bool)
        return self.likelihood.evidence(self.products.of(every), scale, tailed=tailed).value


def enumerate_sets(analysis: Analysis, sizes: LearntSizes, beside: Iterable[Names] = ()) -> Enumerated:
    """Return every set that is worth a fit, with its evidence in a recording.

    Parameters
    ----------
    analysis : Analysis
    sizes : LearntSizes
    beside : iterable of tuple of str
        Sets that are fitted in any case: the truth of tuning cases.
    """
    looked = screened_recording(analysis, sizes)
    products, found = looked.products, looked.found
    likelihood = looked.guess.counting(found.independent)
    fits = _Fits(products, likelihood, found)
    fits.take((), products.of_set([], []))
    singles, pairs = sets_to_fit(found, likelihood.unknown.expected, beside)
    for names in [*((name,) for name in singles), *pairs]:
        fits.fit(names)
    for names in _triples(fits, found):
        fits.fit(names)
    swapped_in: list[Names] = []
    while swapped_in != (best := [fits.likeliest(count) for count in (1, 2, 3)]):
        swapped_in = best  # a swap may find a likelier set, whose own swaps are due
        for names in _swapped(best, fits, found):
            fits.fit(names)
    return Enumerated(products, likelihood, _with_forms(products, fits))


class _Fits:
    """The sets that were fitted, and the log evidence of each, which is weighed once.

    Parameters
    ----------
    products : RecordingProducts
    likelihood : Likelihood
    found : Screened
    """

    def __init__(self, products: RecordingProducts, likelihood: Likelihood, found: Screened) -> None:
        self.products, self.likelihood, self.found = products, likelihood, found
        self.singles: list[tuple[Variant, OfSet]] = []
        self.sets: dict[Names, OfSet] = {}
        self.evidence: dict[Names, float] = {}

    def take(self, names: Names, each: OfSet) -> None:
        """Keep a set, unless one of these effects is there that has as much evidence."""
        evidence = plain_evidence(self.likelihood, each)
        if names not in self.sets or evidence > self.evidence[names]:
            self.sets[names], self.evidence[names] = each, evidence

    def fit(self, names: Names) -> None:
        """Fit a set of effects, if it was not: one in all of its forms, several from where these have ended.

        A pair in the forms that are likeliest beside each other, too: a form that explains most by itself
        takes up a part of what the other effect does.
        """
        if names in self.sets:
            return
        if len(names) == 1:
            self._fit_forms(names)
            return
        for name in names:
            self.fit((name,))
        ends = [self.sets[(name,)] for name in names]
        self._take_from(names, ends)
        forms = self.found.beside.get(names, ())
        others = [found for form in forms for own, found in self.singles if own is form]
        if len(others) == len(names) and any(a is not b for a, b in zip(ends, others, strict=True)):
            self._take_from(names, others)

    def _fit_forms(self, names: Names) -> None:
        for form in self.found.forms[names[0]]:
            fit = fitted(self.products, self.likelihood, [form])
            self.singles.append((form, fit))
            self.take(names, fit)

    def _take_from(self, names: Names, ends: Sequence[OfSet]) -> None:
        begin = [
            Variant(n, dict(each.changes[0][1]), each.free[0]) for n, each in zip(names, ends, strict=True)
        ]
        self.take(names, fitted(self.products, self.likelihood, begin))

    def likeliest(self, count: int, without: Collection[str] = ()) -> Names:
        """Return the likeliest set of so many effects, by its evidence and by what physics expects.

        ``without`` are effects that it does not hold.
        """
        names = [each for each in self.sets if len(each) == count and not set(each) & set(without)]
        case = OfCase(self.likelihood.unknown, tuple(self.sets[each] for each in names))
        odds = log_prior(case, self.likelihood.learnt)[: len(names)]  # of the sets alone, which come first
        mass = [self.evidence[each] + float(p) for each, p in zip(names, odds, strict=True)]
        return names[int(np.argmax(mass))] if names else ()


@dataclass(frozen=True)
class ScreenedRecording:
    """A recording with the screen's result, before any set is fitted."""

    products: RecordingProducts
    guess: Likelihood
    found: Screened


def screened_recording(analysis: Analysis, sizes: LearntSizes) -> ScreenedRecording:
    """Return the screen's result for all effects of a recording."""
    forms = screened_forms(analysis.data, analysis.variants)
    background = make_background(
        analysis.data, ((f.variant.name, f.columns) for f in forms), analysis.largest
    )
    products = RecordingProducts(analysis, background)
    guess = Likelihood(products.unknown(dict.fromkeys(analysis.data.outputs, _INDEPENDENT)), sizes)
    return ScreenedRecording(products, guess, screen(products, guess, forms))


def sets_to_fit(
    found: Screened, expected: Collection[str], beside: Iterable[Names] = ()
) -> tuple[list[str], list[Names]]:
    """Return the single effects and the pairs that are fitted.

    Parameters
    ----------
    found : Screened
    expected : collection of str
        Effects of which physics leaves no doubt: each alone, and with every other one.
    beside : iterable of tuple of str
        Sets that are fitted in any case.
    """
    sure = sorted(set(expected) & set(found.forms))
    wanted = [tuple(sorted(names)) for names in beside if set(names) <= set(found.forms)]
    wanted += [(name,) for name in sure]
    pairs = [*found.beside, *(names for names in wanted if len(names) == 2)]
    pairs += [tuple(sorted((first, n))) for first in sure for n in found.forms if n != first]
    singles = [*found.kept, *(n for names in pairs + wanted for n in names)]
    return list(dict.fromkeys(singles)), list(dict.fromkeys(pairs))


def _with_forms(products: RecordingProducts, fits: _Fits) -> tuple[OfSet, ...]:
    """Return all sets, the empty one and the likeliest with unnamed forms beside them."""
    order = sorted(fits.sets, key=lambda names: -fits.evidence[names])
    asked = {(), *order[:EFFECTS_KEPT]}
    return tuple(products.with_forms(e) if names in asked else e for names, e in fits.sets.items())


def _triples(fits: _Fits, found: Screened) -> list[Names]:
    """Return the likeliest pair with each effect that does best beside its members.

    And each of its members with the likeliest pair of other effects: what one effect with several parameters
    does, two may do together, as another friction and stiffness do what a temperature does.
    """
    first = fits.likeliest(2)
    if not first:
        return []
    others = [name for name in found.kept if name not in first]

    def beside(name: str) -> float:
        return float(np.sum([found.evidence[tuple(sorted((name, n)))] for n in first]))

    chosen = sorted(others, key=lambda name: -beside(name))[:TRIPLES]
    triples = [tuple(sorted((*first, name))) for name in chosen]
    for name in first:  # what looks like it has its place
        alike = [n for n in found.forms if look_alike(name, n, fits.likelihood.unknown.steady)]
        two = fits.likeliest(2, {*first, *alike})
        triples += [tuple(sorted((name, *two)))] if two else []
    return triples


def _swapped(likeliest: Sequence[Names], fits: _Fits, found: Screened) -> list[Names]:
    """Return the likeliest single effect, pair and triple with a like effect in place of one of them.

    Without these an effect is not told from what looks like it, but taken for it. The screen may have left
    out the like effect: it sees small sizes, at which a large compliance has another shape.
    """
    steady = fits.likelihood.unknown.steady
    return [
        tuple(sorted((*(set(best) - {name}), other)))
        for best in likeliest
        for name in best
        for other in found.forms
        if other not in best and look_alike(name, other, steady)
    ]
