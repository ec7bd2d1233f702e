"""What a posterior says: names, alternatives, confidence, agreement, and whether something has no name."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch.inference.posterior.evidence import hypotheses, log_posterior
from tire_pipeline.mismatch.inference.posterior.products import OfCase
from tire_pipeline.mismatch.inference.posterior.sizes import LearntSizes

Names = tuple[str, ...]
LIKELIER = 0.5
"""A name, with its alternatives, is said where it is likelier than not."""
MOST_ALTERNATIVES = 2
"""More names would be no answer."""


@dataclass(frozen=True)
class SetAnswer:
    """What the posterior over sets says of one recording.

    Parameters
    ----------
    sets : tuple of (names, probability)
        One of the names is a cause; the likeliest comes first. The probability is that of all sets which hold
        one of them.
    agreement : float
        Probability that nothing is missing.
    unnamed : float
        Probability that something without a name is there, beside names or not.
    probabilities : mapping
        Set of names -> probability, with something unnamed or without.
    """

    sets: tuple[tuple[Names, float], ...]
    agreement: float
    unnamed: float
    probabilities: Mapping[Names, float]


def answered(case: OfCase, sizes: LearntSizes) -> SetAnswer:
    """Return what the sets of a case say together."""
    every, mass = hypotheses(case), np.exp(log_posterior(case, sizes))
    probabilities: dict[Names, float] = defaultdict(float)
    for each, p in zip(every, mass, strict=True):
        probabilities[each.names] += float(p)
    agreement = sum(float(p) for e, p in zip(every, mass, strict=True) if not e.names and not e.unnamed)
    unnamed = sum(float(p) for e, p in zip(every, mass, strict=True) if e.unnamed)
    return SetAnswer(_named(probabilities), agreement, unnamed, dict(probabilities))


def _named(probabilities: Mapping[Names, float]) -> tuple[tuple[Names, float], ...]:
    """Return each member of the likeliest set that holds names, with what could stand in its place."""
    named = {names: p for names, p in probabilities.items() if names}
    if not named:
        return ()
    best = max(named, key=lambda names: named[names])
    out = []
    for name in best:
        group = (name, *_instead(named, best, name))
        sure = sum(p for names, p in named.items() if set(names) & set(group))
        if sure > LIKELIER:
            out.append((group, min(sure, 1.0)))
    return tuple(out)


def _instead(named: Mapping[Names, float], best: Names, name: str) -> Names:
    """Return the likeliest effects in the place of one of a set, at most two."""
    others = set(best) - {name}
    swaps = {
        next(iter(set(names) - others)): p
        for names, p in named.items()
        if len(names) == len(best) and others < set(names) and name not in names
    }
    order = sorted(swaps, key=lambda other: -swaps[other])
    return tuple(other for other in order if swaps[other] > _least(named[best]))[:MOST_ALTERNATIVES]


def _least(first: float) -> float:
    """A twentieth of the first: what 95% leave open."""
    return 0.05 * first
