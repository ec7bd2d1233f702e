"""Screen: log evidence of all single effects and all pairs about a model without effects, all linear."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import RecordingProducts
from tire_pipeline.mismatch.model.candidates import Variant, screening_columns
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate
from tire_pipeline.mismatch.model.residual import residual

Array = np.ndarray
Names = tuple[str, ...]
EFFECTS_KEPT = 12
"""Effects that go on to be fitted."""
_ROUNDS = 8
_ALIKE = 0.05
"""Change of a count, as a part of it, below which it stays."""


@dataclass(frozen=True)
class ScreenedForm:
    """One form of an effect as the screen sees it: columns in N, shape (n, k), of unit prior spread."""

    variant: Variant
    columns: Mapping[str, Array]


@dataclass(frozen=True)
class Screened:
    """What the screen says.

    Parameters
    ----------
    forms : dict
        Likeliest form of each effect.
    evidence : dict
        Log evidence of each single effect and each pair, by names, above that of no effect.
    kept : tuple of str
        Effects that go on.
    independent : dict of float
        Output -> samples that are independent beside all effects together.
    """

    forms: Mapping[str, Variant]
    evidence: Mapping[Names, float]
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


def screen(products: RecordingProducts, likelihood: Likelihood, forms: Sequence[ScreenedForm]) -> Screened:
    """Score single effects in their likeliest form, pairs of these, and keep ``EFFECTS_KEPT`` effects."""
    data = products.data
    rest = residual(data, [])
    columns = {o: np.column_stack([*(f.columns[o] for f in forms), rest[o]]) for o in data.outputs}
    every = products.of(columns)
    counts = [f.columns[data.outputs[0]].shape[1] for f in forms]
    rows = np.split(np.arange(sum(counts)), np.cumsum(counts)[:-1])

    def score(*which: int) -> float:
        picked = np.concatenate([rows[k] for k in which]).astype(int) if which else np.zeros(0, int)
        return likelihood.evidence(every.take(picked), np.ones(picked.size), wide=True).value

    nothing = score()
    best: dict[str, tuple[float, int]] = {}
    for k, form in enumerate(forms):
        best[form.variant.name] = max(best.get(form.variant.name, (-np.inf, k)), (score(k) - nothing, k))
    evidence: dict[Names, float] = {(name,): value for name, (value, _) in best.items()}
    for pair in combinations(sorted(best), 2):
        evidence[pair] = score(*(best[name][1] for name in pair)) - nothing
    chosen = np.concatenate([rows[k] for _, k in best.values()]).astype(int) if best else np.zeros(0, int)
    independent = _independent(products, likelihood, {o: x[:, np.r_[chosen, -1]] for o, x in columns.items()})
    likeliest = {name: forms[k].variant for name, (_, k) in best.items()}
    return Screened(likeliest, evidence, _kept(evidence), independent)


def _independent(
    products: RecordingProducts, likelihood: Likelihood, columns: Mapping[str, Array]
) -> Mapping[str, float]:
    """Samples of each output that are independent beside all that is looked for.

    What is left beside coefficients and misfit says how many there are, and how many there are says how much
    of these the recording resolves. So both are sought together, from few samples on.
    """
    every = products.of(columns)
    count: Mapping[str, float] = likelihood.unknown.independent
    for _ in range(_ROUNDS):
        before = count
        here = likelihood.counting({o: n / likelihood.learnt.independent for o, n in before.items()})
        found = here.evidence(every, np.ones(columns[products.data.outputs[0]].shape[1] - 1), wide=True)
        count = products.independent(columns, found)
        if all(abs(np.log(count[o] / before[o])) < _ALIKE for o in count):
            break
    return count


def _kept(evidence: Mapping[Names, float]) -> Names:
    """Effects in the order in which they come in the likeliest sets: half by themselves, half in pairs."""
    order = sorted(evidence, key=lambda names: -evidence[names])
    kept = [names[0] for names in order if len(names) == 1][: EFFECTS_KEPT // 2]
    for names in order:
        kept += [name for name in names if name not in kept]
    return tuple(kept[:EFFECTS_KEPT])
