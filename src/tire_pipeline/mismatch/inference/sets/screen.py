"""Screen: log evidence of all single effects and all pairs about a model without effects, all linear."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np

from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import RecordingProducts
from tire_pipeline.mismatch.model.candidates import Variant, screening_columns
from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
Names = tuple[str, ...]
EFFECTS_KEPT = 12
"""Effects that go on to be fitted."""
PAIRS = 2 * EFFECTS_KEPT
"""Pairs of these that are fitted: to fit all 66 takes time, and the others have hardly any evidence."""
_ROUNDS_OF_COUNTING = 8
"""At most: each round counts beside what the count of the round before resolves."""


@dataclass(frozen=True)
class ScreenedForm:
    """One form of an effect as the screen sees it: columns in N, shape (n, k), of unit prior spread."""

    variant: Variant
    columns: Mapping[str, Array]


@dataclass(frozen=True)
class Screened:
    """The result of the screen.

    Parameters
    ----------
    forms : dict of tuple of Variant
        Of each effect the likeliest form, and that of each other choice of parameters that float and of what
        the others are held at: which of these is likelier shows only where they are fitted.
    evidence : dict
        Log evidence of each single effect and each pair, by names, above that of no effect.
    beside : dict
        Pair of names -> the two forms that are likeliest together; of pairs that are likely enough.
    kept : tuple of str
        Effects that are kept.
    independent : dict of float
        Output -> samples that are independent beside all effects together.
    """

    forms: Mapping[str, tuple[Variant, ...]]
    evidence: Mapping[Names, float]
    beside: Mapping[Names, tuple[Variant, Variant]]
    kept: Names
    independent: Mapping[str, float]


def screened_forms(
    data: Data, variants: Sequence[Variant], changes: Sequence[Change] = ()
) -> list[ScreenedForm]:
    """Return the columns of some forms beside effects that are in, scaled by their priors."""
    now = simulate(data, changes)
    forms = []
    for variant in variants:
        columns = screening_columns(data, changes, variant, now)
        count = columns[data.outputs[0]].shape[1]
        if not count:
            continue
        steps = [
            variant.effect.usual(data, p.name)[1] / p.step
            for p in variant.effect.parameters
            if p.name in variant.free and p.name not in variant.effect.scanned
        ]
        wide = np.r_[np.ones(count - len(steps)), steps]
        forms.append(ScreenedForm(variant, {o: c * wide for o, c in columns.items()}))
    return forms


def screen(products: RecordingProducts, guess: Likelihood, forms: Sequence[ScreenedForm]) -> Screened:
    """Score single effects in their likeliest form, pairs of these, and keep ``EFFECTS_KEPT`` effects.

    Parameters
    ----------
    products : RecordingProducts
    guess : Likelihood
        With a guess of the independent samples, from which they are counted. They are counted beside the
        forms that explain most, as if each sample counted: beside others, what an effect leaves counts as one
        long error. With that number forms are chosen again, and scored.
    forms : sequence of ScreenedForm
    """
    columns = _FormColumns(products, guess, forms)
    each = guess.counting(dict.fromkeys(products.data.outputs, float(products.data.size)))
    independent = _independent(columns, guess, columns.likeliest(columns.scores(each)))
    likelihood = guess.counting(independent)
    scores = columns.scores(likelihood)
    best = columns.likeliest(scores)
    nothing = columns.score(likelihood)
    evidence: dict[Names, float] = {(name,): scores[k] - nothing for name, k in best.items()}
    for pair in combinations(sorted(best), 2):
        evidence[pair] = columns.score(likelihood, *(best[name] for name in pair)) - nothing
    choices, kept = columns.each_choice(scores), _kept(evidence)
    beside = {pair: columns.together(likelihood, choices, pair) for pair in likeliest_pairs(evidence, kept)}
    chosen = {name: tuple(forms[k].variant for k in which) for name, which in choices.items()}
    return Screened(chosen, evidence, beside, kept, independent)


def likeliest_pairs(evidence: Mapping[Names, float], kept: Iterable[str]) -> list[Names]:
    """Return the likeliest pairs of the effects that are kept, ``PAIRS`` of them."""
    pairs: list[Names] = list(combinations(sorted(kept), 2))
    return sorted(pairs, key=lambda pair: -evidence[pair])[:PAIRS]


class _FormColumns:
    """The columns of all forms and the residual, and their products as a likelihood weighs them."""

    def __init__(self, products: RecordingProducts, guess: Likelihood, forms: Sequence[ScreenedForm]) -> None:
        data = products.data
        rest = residual(data, [])
        self.recording, self.forms = products, forms
        self.columns = {o: np.column_stack([*(f.columns[o] for f in forms), rest[o]]) for o in data.outputs}
        self.products = guess.projected(products.of(self.columns))
        counts = [f.columns[data.outputs[0]].shape[1] for f in forms]
        self._rows = np.split(np.arange(sum(counts)), np.cumsum(counts)[:-1])

    def of(self, which: Iterable[int]) -> Array:
        """Return the numbers of the columns of some forms."""
        return np.concatenate([np.zeros(0, int), *(self._rows[k] for k in which)]).astype(int)

    def score(self, likelihood: Likelihood, *which: int) -> float:
        """Return the log evidence of some forms together, with nothing unnamed or with something.

        Both, as sets are weighed later. With an error of any size alone, what no set of linear forms makes as
        small as usual tells no effect from another.
        """
        picked = self.of(which)
        products, ones = self.products.take(picked), np.ones(picked.size)
        plain, wide = (likelihood.evidence(products, ones, wide=each).value for each in (False, True))
        return float(np.logaddexp(plain, wide + likelihood.learnt.unnamed))

    def scores(self, likelihood: Likelihood) -> list[float]:
        """Return the log evidence of each form by itself."""
        return [self.score(likelihood, k) for k in range(len(self.forms))]

    def likeliest(self, scores: Sequence[float]) -> dict[str, int]:
        """Return for each effect the number of its likeliest form, the last of equal ones."""
        best: dict[str, int] = {}
        for k, form in enumerate(self.forms):
            name = form.variant.name
            best[name] = max(best.get(name, k), k, key=lambda j: (scores[j], j))
        return best

    def each_choice(self, scores: Sequence[float]) -> dict[str, tuple[int, ...]]:
        """Return the number of the likeliest form of each effect for each choice, best first.

        A choice is of parameters that float, and of values at which the others are held: a file that is right
        at 200 kPa is another one than a file that is right at 250 kPa.
        """
        found: dict[str, dict[tuple[object, ...], int]] = {}
        for k in sorted(range(len(self.forms)), key=lambda k: -scores[k]):
            variant = self.forms[k].variant
            held = tuple((p, x) for p, x in variant.start.items() if p not in variant.free)
            found.setdefault(variant.name, {}).setdefault((variant.free, held), k)
        return {name: tuple(choices.values()) for name, choices in found.items()}

    def together(
        self, likelihood: Likelihood, choices: Mapping[str, tuple[int, ...]], pair: Names
    ) -> tuple[Variant, Variant]:
        """Return the forms of two effects that are likeliest beside each other."""
        first, second = max(
            product(*(choices[name] for name in pair)), key=lambda both: self.score(likelihood, *both)
        )
        return self.forms[first].variant, self.forms[second].variant


def _independent(columns: _FormColumns, guess: Likelihood, best: Mapping[str, int]) -> Mapping[str, float]:
    """Samples of each output that are independent beside all that is looked for.

    What is left beside coefficients and misfit says how many there are, and how many there are says how much
    of these the recording resolves. So both are sought together, starting from few samples.
    """
    chosen = columns.of(best.values())
    every = columns.products.take(chosen)
    looked_for = {o: x[:, np.r_[chosen, -1]] for o, x in columns.columns.items()}
    count: Mapping[str, float] = guess.unknown.independent
    for _ in range(_ROUNDS_OF_COUNTING):
        before = count
        here = guess.counting(before, each=True)
        found = here.evidence(every, np.ones(chosen.size), wide=True)
        count = columns.recording.independent(looked_for, found)
        if all(abs(np.log(count[o] / before[o])) < CHANCE for o in count):
            break
    return count


def _kept(evidence: Mapping[Names, float]) -> Names:
    """Effects in the order in which they come in the likeliest sets: half by themselves, half in pairs."""
    order = sorted(evidence, key=lambda names: -evidence[names])
    kept = [names[0] for names in order if len(names) == 1][: EFFECTS_KEPT // 2]
    for names in order:
        kept += [name for name in names if name not in kept]
    return tuple(kept[:EFFECTS_KEPT])
