"""Log evidence and probability of every hypothesis: a set of effects, with something unnamed or not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from tire_pipeline.mismatch.inference.evidence.likelihood import Evidence, Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfCase, OfSet
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes

Array = np.ndarray


@dataclass(frozen=True)
class Hypothesis:
    """One explanation: a set of effects, with something unnamed beside it or not."""

    effects: OfSet
    unnamed: bool

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects, in alphabetical order."""
        return self.effects.names


def hypotheses(case: OfCase) -> list[Hypothesis]:
    """Return every set of a case, first all without and then all with something unnamed."""
    return [Hypothesis(each, unnamed) for unnamed in (False, True) for each in case.sets]


def scales(each: OfSet, learnt: LearntSizes) -> Array:
    """Return the standard deviations of a set's columns: parameters, form errors, what has no name."""
    return np.r_[
        np.full(each.parameters, learnt.prior),
        np.full(each.errors, learnt.form_error),
        np.full(each.unnamed, learnt.wide),
    ]


def plain(likelihood: Likelihood, each: OfSet) -> Evidence:
    """Return the evidence of a set with nothing unnamed beside it."""
    own = scales(each, likelihood.learnt)[: each.parameters + each.errors]
    return likelihood.evidence(each.plain, own)


def plain_evidence(likelihood: Likelihood, each: OfSet) -> float:
    """Return the log evidence of a set with nothing unnamed beside it."""
    return plain(likelihood, each).value


def unnamed_evidence(likelihood: Likelihood, each: OfSet) -> float:
    """Return the log evidence of a set with something unnamed beside it."""
    return likelihood.evidence(each.products, scales(each, likelihood.learnt), wide=True).value


def log_evidence(case: OfCase, sizes: LearntSizes, likelihood: Likelihood | None = None) -> Array:
    """Return the log evidence of each of :func:`hypotheses`, shape (h,).

    Parameters
    ----------
    case : OfCase
    sizes : LearntSizes
    likelihood : Likelihood, optional
        Of this case and these sizes, where it is at hand.
    """
    likelihood = likelihood or Likelihood(case.unknown, sizes)
    ways = (plain_evidence, unnamed_evidence)
    return np.array([way(likelihood, each) for way in ways for each in case.sets])


def log_prior(case: OfCase, sizes: LearntSizes) -> Array:
    """Return the log odds of each of :func:`hypotheses`, shape (h,)."""
    return np.array([_log_odds(h, case.unknown.expected, sizes) for h in hypotheses(case)])


def _log_odds(hypothesis: Hypothesis, expected: frozenset[str], sizes: LearntSizes) -> float:
    sure = len(expected & set(hypothesis.names))
    return sizes.log_prior(len(hypothesis.names) - sure, sure, unnamed=hypothesis.unnamed)


def log_posterior(case: OfCase, sizes: LearntSizes) -> Array:
    """Return the log of the posterior probability of each of :func:`hypotheses`, shape (h,)."""
    value = log_evidence(case, sizes) + log_prior(case, sizes)
    return value - logsumexp(value)


def position(case: OfCase, names: Sequence[str]) -> int | None:
    """Return the number of the set of some names, or None if it was not enumerated."""
    wanted = tuple(sorted(names))
    return next((i for i, each in enumerate(case.sets) if each.names == wanted), None)
