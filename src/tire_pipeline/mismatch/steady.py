"""Steady points: which parameters of a found effect are kept, by pieces of the operating space left out."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from tire_pipeline.mismatch.candidates import Variant
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.gates import accepted
from tire_pipeline.mismatch.proof import left_out
from tire_pipeline.mismatch.refit import Fit, refit
from tire_pipeline.mismatch.search import Search


def choose_parameters(search: Search) -> None:
    """Give the found effects those parameters that predict pieces left out of their fit best.

    A few dozen points stand at the corners of the operating space; what the information criterion keeps
    rests on one of them as easily as on many, and is wrong at the next corner. Effects stay what they are:
    what makes them so is kept.

    Parameters
    ----------
    search : Search
        Of a recording without a time line, its effects found.
    """
    best, least = search.fit, _predicted(search, search.fit)
    for index, (name, _) in enumerate(search.fit.changes):
        effect = catalogue()[name]
        free = effect.free(search.data, effect.zeros(search.data))
        for size in range(1, len(free) + 1):
            for chosen in combinations(free, size):
                if not set(effect.needed) & set(free) <= set(chosen):
                    continue
                variants = [*best.variants]
                variants[index] = Variant(name, effect.zeros(search.data), chosen)
                fit = refit(search.system, variants)
                error = _predicted(search, fit)
                if error < least and not fit.at_bound:
                    best, least = fit, error
    ok, gates = accepted(search, best)
    if ok:
        search.fit, search.gates = best, gates


def _predicted(search: Search, fit: Fit) -> float:
    """Error on pieces left out, over the noise."""
    rest = left_out(search, fit)
    return float(sum(np.mean((rest[o] / search.noise[o].floor) ** 2) for o in rest))
