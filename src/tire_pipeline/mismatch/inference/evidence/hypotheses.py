"""Log evidence and probability of every hypothesis: a set of effects, with something unnamed or not.

Unnamed physics comes in two ways. Either it has one of the unnamed forms: the rate of an input, memory or
play, or what repeats along the road. Each of these is a hypothesis, as an effect is. Or it has any form: all
of these at once, with an error of any size.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.evidence.likelihood import (
    ColumnProducts,
    Evidence,
    Likelihood,
    Projected,
)
from tire_pipeline.mismatch.inference.evidence.products import OfCase, OfSet
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes

Array = np.ndarray
NO_MASS = 12.0
"""Log odds to the likeliest hypothesis beyond which one has no mass, nor with other sizes or fewer sweeps."""


@dataclass(frozen=True)
class Hypothesis:
    """One explanation: a set of effects, with something unnamed beside it or not.

    Parameters
    ----------
    effects : OfSet
    wide : bool
        Whether something unnamed of any form is added.
    form : int, optional
        Number of the unnamed form that is added.
    """

    effects: OfSet
    wide: bool = False
    form: int | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects, in alphabetical order."""
        return self.effects.names

    @property
    def unnamed(self) -> bool:
        """Whether something unnamed is beside the effects."""
        return self.wide or self.form is not None

    def log_evidence(self, likelihood: Likelihood, products: Projected) -> float:
        """Return the log evidence of the hypothesis, with the products of all columns of its set."""
        return self.evidence(likelihood, products).value + self.effects.spread

    def evidence(self, likelihood: Likelihood, products: ColumnProducts | Projected) -> Evidence:
        """Return the evidence of the columns, with the products of all columns of the set."""
        columns = self.effects.columns(wide=self.wide, form=self.form)
        own = scales(self.effects, likelihood.learnt)
        scale = np.r_[own, np.full(columns.size - own.size, likelihood.learnt.wide)]
        return likelihood.evidence(
            products.take(columns),
            scale,
            tailed=self.effects.tailed(columns.size),
            positive=self.effects.positive(columns.size),
            wide=self.wide,
        )


def hypotheses(case: OfCase) -> list[Hypothesis]:
    """Return all hypotheses of a case: its sets alone, then with any form, then with one form at a time."""
    alone = [Hypothesis(each) for each in case.sets]
    wide = [Hypothesis(each, wide=True) for each in case.sets]
    return [*alone, *wide, *(Hypothesis(e, form=k) for e in case.sets for k in range(len(e.forms)))]


def scales(each: OfSet, learnt: LearntSizes) -> Array:
    """Return the standard deviations of a set's columns: parameters, then form errors."""
    return np.r_[np.full(each.parameters, learnt.prior), np.full(each.errors, learnt.form_error)]


def plain(likelihood: Likelihood, each: OfSet, *, wide: bool = False) -> Evidence:
    """Return the evidence of a set with nothing unnamed, and with an error of usual size or of any size."""
    scale = scales(each, likelihood.learnt)
    tailed, positive = each.tailed(scale.size), each.positive(scale.size)
    return likelihood.evidence(each.plain, scale, tailed=tailed, positive=positive, wide=wide)


def plain_evidence(likelihood: Likelihood, each: OfSet) -> float:
    """Return the log evidence of a set with nothing unnamed."""
    return plain(likelihood, each).value + each.spread


def log_evidence(
    case: OfCase,
    sizes: LearntSizes,
    likelihood: Likelihood | None = None,
    which: Sequence[int] | None = None,
) -> Array:
    """Return the log evidence of each of :func:`hypotheses`, shape (h,).

    Parameters
    ----------
    case : OfCase
    sizes : LearntSizes
    likelihood : Likelihood, optional
        Of this case and these sizes, where it is at hand.
    which : sequence of int, optional
        Numbers of the hypotheses to weigh; all of them if left out.
    """
    likelihood, every = likelihood or Likelihood(case.unknown, sizes), hypotheses(case)
    weighed = every if which is None else [every[k] for k in which]
    asked_for = {each.names: each.effects for each in weighed}
    together = likelihood.projected_together([effects.products for effects in asked_for.values()])
    known = dict(zip(asked_for, together, strict=True))
    return np.array([each.log_evidence(likelihood, known[each.names]) for each in weighed])


@dataclass(frozen=True)
class Asked:
    """What the odds of some hypotheses depend on, each of shape (h,).

    Parameters
    ----------
    effects : ndarray of int
        Effects that physics does not lead one to expect.
    expected : ndarray of int
        Effects of which physics leaves no doubt.
    wide : ndarray of bool
    forms : ndarray of int
        Of how many unnamed forms one is there; 0 where none is.
    """

    effects: Array
    expected: Array
    wide: Array
    forms: Array

    def log_prior(self, sizes: LearntSizes) -> Array:
        """Return the log odds of each hypothesis, shape (h,)."""
        return sizes.log_prior(self.effects, self.expected, unnamed=self.wide, forms=self.forms)


def asked(case: OfCase) -> Asked:
    """Return what the odds of :func:`hypotheses` depend on."""
    every, sure = hypotheses(case), case.unknown.expected
    expected = np.array([len(sure & set(h.names)) for h in every])
    forms = np.array([0 if h.form is None else len(h.effects.forms) for h in every])
    effects = np.array([len(h.names) for h in every]) - expected
    return Asked(effects, expected, np.array([h.wide for h in every]), forms)


def log_prior(case: OfCase, sizes: LearntSizes) -> Array:
    """Return the log odds of each of :func:`hypotheses`, shape (h,)."""
    return asked(case).log_prior(sizes)


def log_posterior(case: OfCase, sizes: LearntSizes) -> Array:
    """Return the log of the posterior probability of each of :func:`hypotheses`, shape (h,)."""
    value = log_evidence(case, sizes) + log_prior(case, sizes)
    return value - scipy.special.logsumexp(value)


def position(case: OfCase, names: Sequence[str]) -> int | None:
    """Return the number of the set of some names, or None if it was not enumerated."""
    wanted = tuple(sorted(names))
    return next((i for i, each in enumerate(case.sets) if each.names == wanted), None)
