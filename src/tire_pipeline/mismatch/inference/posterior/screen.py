"""Screen: log evidence of all single effects and all pairs about a model without effects, all linear."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.posterior.evidence import gaussian
from tire_pipeline.mismatch.inference.posterior.priors import spread
from tire_pipeline.mismatch.inference.posterior.products import RecordingProducts
from tire_pipeline.mismatch.inference.posterior.sizes import LearntSizes
from tire_pipeline.mismatch.model.candidates import Variant, screening_columns
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import simulate

Array = np.ndarray
Names = tuple[str, ...]
EFFECTS_KEPT = 12
"""Effects that go on to be fitted."""


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
    """

    forms: Mapping[str, Variant]
    evidence: Mapping[Names, float]
    kept: Names


def screened_forms(data: Data, variants: list[Variant]) -> list[ScreenedForm]:
    """Return the columns of all forms about a model without effects, scaled by their priors."""
    now = simulate(data, [])
    forms = []
    for variant in variants:
        columns = screening_columns(data, [], variant, now)
        count = columns[data.outputs[0]].shape[1]
        if not count:
            continue
        steps = [
            spread(data, p) / p.step
            for p in variant.effect.parameters
            if p.name in variant.free and p.name not in variant.effect.scanned
        ]
        wide = np.r_[np.ones(count - len(steps)), steps]
        forms.append(ScreenedForm(variant, {o: c * wide for o, c in columns.items()}))
    return forms


def screen(products: RecordingProducts, forms: list[ScreenedForm], sizes: LearntSizes) -> Screened:
    """Score single effects in their likeliest form, pairs of these, and keep ``EFFECTS_KEPT`` effects.

    Beside a background of usual size, and the misfit as the search knows it.
    """
    data = products.search.data
    rest = {o: data.recorded[o] - data.base[o] for o in data.outputs}
    every = {o: np.column_stack([*(f.columns[o] for f in forms), rest[o]]) for o in data.outputs}
    matrix = _beside_background(products, every, sizes)
    counts = [f.columns[data.outputs[0]].shape[1] for f in forms]
    rows = np.split(np.arange(sum(counts)), np.cumsum(counts)[:-1])

    def score(*which: int) -> float:
        picked = np.concatenate([*(rows[k] for k in which), [matrix.shape[0] - 1]]).astype(int)
        small = matrix[np.ix_(picked, picked)][None]
        return float(gaussian(small, np.ones(picked.size - 1))[0] + 0.5 * matrix[-1, -1])

    best: dict[str, tuple[float, int]] = {}
    for k, form in enumerate(forms):
        best[form.variant.name] = max(best.get(form.variant.name, (-np.inf, k)), (score(k), k))
    evidence: dict[Names, float] = {(name,): value for name, (value, _) in best.items()}
    for pair in combinations(sorted(best), 2):
        evidence[pair] = score(*(best[name][1] for name in pair))
    return Screened({n: forms[k].variant for n, (_, k) in best.items()}, evidence, _kept(evidence))


def _kept(evidence: Mapping[Names, float]) -> Names:
    """Effects in the order in which they come in the likeliest sets: half by themselves, half in pairs."""
    order = sorted(evidence, key=lambda names: -evidence[names])
    kept = [names[0] for names in order if len(names) == 1][: EFFECTS_KEPT // 2]
    for names in order:
        kept += [name for name in names if name not in kept]
    return tuple(kept[:EFFECTS_KEPT])


def _beside_background(products: RecordingProducts, columns: dict[str, Array], sizes: LearntSizes) -> Array:
    """Return products of columns given misfit and background, shape (m, m)."""
    own, across, background = products.at_middle(columns)
    scale = sizes.of(products.families)
    inner = background * scale[:, None] * scale[None, :] + np.eye(scale.size)
    factor = scipy.linalg.cho_factor(inner)
    seen = across * scale[:, None]
    return np.asarray(own - seen.T @ scipy.linalg.cho_solve(factor, seen))
