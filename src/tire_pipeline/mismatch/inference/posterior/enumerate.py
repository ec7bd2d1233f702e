"""Enumerate: singles and pairs of what the screen has left, triples by adding to the likeliest pairs."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

import numpy as np

from tire_pipeline.mismatch.discrepancy.background import make_background
from tire_pipeline.mismatch.inference.posterior.evidence import log_evidence
from tire_pipeline.mismatch.inference.posterior.fitting import fitted, of_changes
from tire_pipeline.mismatch.inference.posterior.products import OfCase, OfSet, RecordingProducts
from tire_pipeline.mismatch.inference.posterior.screen import Screened, screen, screened_forms
from tire_pipeline.mismatch.inference.posterior.sizes import LearntSizes
from tire_pipeline.mismatch.inference.search_state import Search
from tire_pipeline.mismatch.model.candidates import Variant

PAIRS = 16
TRIPLES = 6
"""Sets that are fitted by their own equations; the screen has scored all."""
_STEPS = 3


def enumerated(search: Search, sizes: LearntSizes, beside: Iterable[tuple[str, ...]] = ()) -> OfCase:
    """Return what a recording says about every set that is worth a fit.

    Parameters
    ----------
    search : Search
        As :func:`begin` gives it.
    sizes : LearntSizes
        For the screen.
    beside : iterable of tuple of str
        Sets that are fitted in any case: the truth of tuning cases.
    """
    forms = screened_forms(search.data, search.variants)
    background = make_background(search.data, ((f.variant.name, f.columns) for f in forms), search.largest)
    products = RecordingProducts(search, background)
    found = screen(products, forms, sizes)
    fits: dict[tuple[str, ...], OfSet] = {(): of_changes(products, [], [])}
    wanted = [tuple(sorted(names)) for names in beside if set(names) <= set(found.forms)]
    for name in {*found.kept, *(n for names in wanted for n in names)}:
        fits[(name,)] = fitted(products, [found.forms[name]], _STEPS)
    for pair in [*_likeliest_pairs(found), *(names for names in wanted if len(names) == 2)]:
        if pair not in fits:
            fits[pair] = fitted(products, _from_singles(found, fits, pair), _STEPS - 1)
    for triple in _triples(_case(products, fits), found, sizes):
        fits[triple] = fitted(products, _from_singles(found, fits, triple), _STEPS - 1)
    return _case(products, fits)


def _case(products: RecordingProducts, fits: dict[tuple[str, ...], OfSet]) -> OfCase:
    return OfCase(products.families, products.background, products.log_determinant, tuple(fits.values()))


def _likeliest_pairs(found: Screened) -> list[tuple[str, ...]]:
    pairs: list[tuple[str, ...]] = list(combinations(sorted(found.kept), 2))
    return sorted(pairs, key=lambda pair: -found.evidence[pair])[:PAIRS]


def _from_singles(
    found: Screened, fits: dict[tuple[str, ...], OfSet], names: tuple[str, ...]
) -> list[Variant]:
    """Return the forms of some effects, each where its own fit has ended."""
    return [Variant(n, dict(fits[(n,)].changes[0][1]), found.forms[n].free) for n in names]


def _triples(case: OfCase, found: Screened, sizes: LearntSizes) -> list[tuple[str, ...]]:
    """Return the likeliest pair with each effect that does best beside its members."""
    value = log_evidence(case, sizes)[: len(case.sets)]
    pairs = [k for k, each in enumerate(case.sets) if len(each.names) == 2]
    if not pairs:
        return []
    first = case.sets[max(pairs, key=lambda k: value[k])].names
    others = [name for name in found.kept if name not in first]

    def beside(name: str) -> float:
        return float(np.sum([found.evidence[tuple(sorted((name, n)))] for n in first]))

    chosen = sorted(others, key=lambda name: -beside(name))[:TRIPLES]
    return [tuple(sorted((*first, name))) for name in chosen]
