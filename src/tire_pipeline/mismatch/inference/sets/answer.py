"""The answer of a posterior: names, alternatives, confidence, agreement, and whether something is unnamed."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import scipy

from tire_pipeline.mismatch.effects import look_alike, told_by
from tire_pipeline.mismatch.inference.evidence.hypotheses import (
    Hypothesis,
    hypotheses,
    log_evidence,
    log_prior,
    plain,
    scales,
)
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfCase, OfSet
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes
from tire_pipeline.mismatch.model.channels import CHANCE
from tire_pipeline.mismatch.model.forces import Change

Array = np.ndarray
Names = tuple[str, ...]
OPEN = CHANCE
"""An effect less likely than this part of the first is not an alternative."""
LEVEL = 0.5
"""An effect, with its alternatives, is named if it is likelier than not."""
MOST_ALTERNATIVES = 2
"""More are not listed. There is no answer where nothing here tells one of them from a listed one."""


@dataclass(frozen=True)
class SetAnswer:
    """The answer of the posterior over sets for one recording.

    Parameters
    ----------
    sets : tuple of (names, probability)
        One of the names is a cause; the likeliest comes first. The probability is that of all sets which hold
        one of them.
    named : OfSet
        The set of the first names.
    agreement : float
        Probability that nothing is missing, or nothing that shows.
    unnamed : float
        Probability that something unnamed is present, with or without names.
    probabilities : mapping
        Set of names -> probability, with something unnamed or without.
    gains : mapping
        Effect -> how much log evidence the best set with it has above the best one without.
    left : mapping
        Output -> likeliest size of the error beside the named set, over the largest force.
    case : OfCase
    alone : mapping
        Set of names -> probability with nothing unnamed.
    log_weight : float
        Log of the evidence times the odds of all hypotheses that hold names.
    """

    sets: tuple[tuple[Names, float], ...]
    named: OfSet
    agreement: float
    unnamed: float
    probabilities: Mapping[Names, float]
    gains: Mapping[str, float]
    left: Mapping[str, float]
    case: OfCase
    alone: Mapping[Names, float] = field(default_factory=dict)
    log_weight: float = -np.inf

    def single(self, name: str) -> tuple[Change, ...]:
        """Return an effect alone, where its own fit has ended."""
        return next(each.changes for each in self.case.sets if each.names == (name,))

    @property
    def likely(self) -> tuple[OfSet, ...]:
        """The sets that hold names and are at least 1 in 20 as likely as the likeliest of them."""
        named = [each for each in self.case.sets if each.names and each.names in self.probabilities]
        most = max((self.probabilities[each.names] for each in named), default=0.0)
        return tuple(each for each in named if self.probabilities[each.names] > OPEN * most)

    @property
    def rivals(self) -> tuple[OfSet, ...]:
        """The likely sets, the likeliest first, where one of them is the answer and no name stands out."""
        if self.sets or self.unnamed + self.agreement >= 1.0 - LEVEL:
            return ()
        return tuple(sorted(self.likely, key=lambda each: -self.probabilities[each.names]))

    @property
    def one_cause(self) -> float:
        """Probability that one effect explains the mismatch, with nothing unnamed beside it."""
        return sum(p for names, p in self.alone.items() if len(names) == 1)

    @property
    def beside_unnamed(self) -> tuple[Names, ...]:
        """Something unnamed, as an empty set, and the sets that would do instead of it.

        The likeliest first. Nothing where names or rivals stand out, or where no set would do.
        """
        if self.sets or self.rivals:
            return ()
        able = [names for names, p in self.alone.items() if names and p > OPEN]
        return ((), *sorted(able, key=lambda names: -self.alone[names])) if able else ()

    @property
    def names(self) -> Names:
        """First name of each set."""
        return tuple(names[0] for names, _ in self.sets)


def answered(
    case: OfCase, sizes: LearntSizes, level: float = LEVEL, likelihood: Likelihood | None = None
) -> SetAnswer:
    """Return the answer of all sets of a case.

    Parameters
    ----------
    case : OfCase
    sizes : LearntSizes
    level : float
        Probability from which an effect, with its alternatives, is named.
    likelihood : Likelihood, optional
        Of this case and these sizes, where it is at hand.
    """
    likelihood = likelihood or Likelihood(case.unknown, sizes)
    every, evidence = hypotheses(case), log_evidence(case, sizes, likelihood)
    value = evidence + log_prior(case, sizes)
    mass = np.exp(value - scipy.special.logsumexp(value))
    probabilities: dict[Names, float] = defaultdict(float)
    for each, p in zip(every, mass, strict=True):
        probabilities[each.names] += float(p)
    best = likeliest_description(probabilities, case.unknown.steady)
    hidden = _hidden(case, likelihood, best)
    agreement = sum(
        float(p) for e, p in zip(every, mass, strict=True) if set(e.names) <= hidden and not e.unnamed
    )
    unnamed = sum(float(p) for e, p in zip(every, mass, strict=True) if e.unnamed)
    without = {each.names: float(p) for each, p in zip(every, mass, strict=True) if not each.unnamed}
    as_good = _fit_as_well(case, likelihood, best)
    sets = _named(probabilities, without, best, hidden, as_good, level, case.unknown.steady)
    named = _set_of(case, probabilities, tuple(names[0] for names, _ in sets))
    left = plain(likelihood, named, wide=True).errors
    gains = _gains(case, evidence)
    with_names = np.array([bool(each.names) for each in every])
    weight = float(scipy.special.logsumexp(value[with_names])) if with_names.any() else -np.inf
    return SetAnswer(sets, named, agreement, unnamed, dict(probabilities), gains, left, case, without, weight)


def nothing(case: OfCase) -> SetAnswer:
    """Return an empty answer, where nothing may be explained."""
    return SetAnswer((), case.sets[0], 1.0, 0.0, {(): 1.0}, {}, {}, case)


def _named(
    probabilities: Mapping[Names, float],
    without: Mapping[Names, float],
    best: Names,
    hidden: frozenset[str],
    as_good: frozenset[Names],
    level: float,
    steady: frozenset[str],
) -> tuple[tuple[Names, float], ...]:
    """Return each member of the likeliest set that holds names, with the effects that could replace it.

    A name must be likelier than not both with and without something unnamed: an effect that only resembles a
    part of something unknown is not named. An effect that physics expects must also show: that it is likelier
    than not says nothing about the recording.
    """
    named = {names: p for names, p in probabilities.items() if names}
    out: list[tuple[Names, float]] = []
    for name in best:
        taken = {n for names, _ in out for n in names}
        instead = [n for n in _instead(named, best, name, as_good) if n not in taken]
        group = (name, *instead[:MOST_ALTERNATIVES])
        if any(told_by(o, n) in steady for o in instead[MOST_ALTERNATIVES:] for n in group):
            continue  # one would be left out that nothing here tells from a listed one
        sure = sum(p for names, p in named.items() if set(names) & set(group))
        alone = sum(p for names, p in without.items() if set(names) & set(group))
        likelier = sure > level and alone > level * sum(without.values())
        if likelier and name not in taken and name not in hidden:
            out.append((group, min(sure, 1.0)))
    return tuple(sorted(out, key=lambda each: -each[1]))


def likeliest_description(probabilities: Mapping[Names, float], steady: frozenset[str]) -> Names:
    """Return the likeliest set that holds names: of a description that shares its mass, the likeliest of it.

    A gain of the force, one of the load and another friction, each beside another stiffness, are one
    description with three names. One effect in place of all of them is not likelier than that for having one.

    Parameters
    ----------
    probabilities : mapping
        Set of names -> probability.
    steady : frozenset of str
        Channels that do not vary.
    """
    named = {names: p for names, p in probabilities.items() if names}

    def alike(best: Names) -> list[Names]:
        return [names for names in named if _like_in_place(names, best, steady)]

    top = max(named, key=lambda names: named[names] + sum(named[e] for e in alike(names)), default=())
    return max([top, *alike(top)], key=lambda names: named.get(names, 0.0))


def _hidden(case: OfCase, likelihood: Likelihood, best: Names) -> frozenset[str]:
    """Return the effects of the likeliest set with names that physics expects and that do not show."""
    expected = case.unknown.expected & set(best)
    if not expected:
        return frozenset()
    return expected - _shown(likelihood, next(each for each in case.sets if each.names == best))


def _shown(likelihood: Likelihood, each: OfSet) -> frozenset[str]:
    """Return the effects of a set whose fit gains more than noise alone gives on average.

    The rest of the set and the priors are kept: without an effect, twice the gain in log likelihood is on
    average the number of parameters that the recording determines (Wilks 1938). An effect counts as at least
    one.
    """
    found, scale = plain(likelihood, each), scales(each, likelihood.learnt)
    z, covariance = found.mode / scale, found.covariance / scale[:, None] / scale[None, :]
    shown, first = set(), 0
    for (name, _), free in zip(each.changes, each.free, strict=True):
        own = slice(first, first + len(free))
        twice = z[own] @ np.linalg.solve(covariance[own, own], z[own])
        if twice > max(len(free) - np.trace(covariance[own, own]), 1.0):
            shown.add(name)
        first += len(free)
    return frozenset(shown)


def _instead(named: Mapping[Names, float], best: Names, name: str, as_good: frozenset[Names]) -> Names:
    """Return the effects that could replace one of a set, the likeliest first."""
    swaps = {other: names for names in named if (other := _in_place(names, best, name)) is not None}
    order = sorted(swaps, key=lambda other: -named[swaps[other]])
    close = [o for o in order if swaps[o] in as_good or named[swaps[o]] > OPEN * named[best]]
    return tuple(close)


def _in_place(names: Names, best: Names, name: str) -> str | None:
    """Return the effect that one set has in place of a name of another set, if that is all they differ in."""
    others = set(best) - {name}
    if len(names) != len(best) or name in names or not others < set(names):
        return None
    return next(iter(set(names) - others))


def _like_in_place(names: Names, best: Names, steady: frozenset[str]) -> tuple[str, str] | None:
    """Return an effect of a set and what looks like it in another set, if that is all they differ in."""
    both = ((name, _in_place(names, best, name)) for name in best)
    return next(((a, b) for a, b in both if b is not None and look_alike(a, b, steady)), None)


def _fit_as_well(case: OfCase, likelihood: Likelihood, best: Names) -> frozenset[Names]:
    """Return the sets with a like effect in place of one, if they fit as well at their best.

    Effects of one family look alike, and those that a channel tells apart which does not vary. An effect with
    more parameters, or with wider priors, has less evidence even if it fits as well: that is what was
    expected of it, not what the recording says. So a wear is not told from a heat that nobody measured, whose
    lag may be anything.
    """
    steady = case.unknown.steady
    like = [
        (each, told_by(*both) in steady)
        for each in case.sets
        if (both := _like_in_place(each.names, best, steady))
    ]
    if not like:
        return frozenset()
    whole = next(each for each in case.sets if each.names == best)
    least = {
        beside: _best_fit(likelihood, whole, beside_unnamed=beside) + np.log(OPEN)
        for beside in {beside for _, beside in like}
    }
    return frozenset(
        each.names
        for each, beside in like
        if _best_fit(likelihood, each, beside_unnamed=beside) > least[beside]
    )


def _best_fit(likelihood: Likelihood, each: OfSet, *, beside_unnamed: bool) -> float:
    """Return the log likelihood of a set at its likeliest parameters, with what the priors say of these.

    What would tell two effects apart may not vary. What is left to tell them is a difference of their forms,
    and something unnamed beside them may be what makes it: a delay of a tire that needs some way to build up
    its force fades with slip as a longer way does.
    """
    hypothesis, own = Hypothesis(each, wide=beside_unnamed), scales(each, likelihood.learnt)
    found = hypothesis.evidence(likelihood, each.products)
    covariance = found.covariance[: own.size, : own.size] / own[:, None] / own[None, :]
    return found.value + each.spread - 0.5 * float(np.linalg.slogdet(covariance)[1])


def _set_of(case: OfCase, probabilities: Mapping[Names, float], names: Names) -> OfSet:
    """Return the set of some names, or the likeliest that holds them and was fitted."""
    wanted = tuple(sorted(names))
    holding = [each for each in case.sets if set(wanted) <= set(each.names)]
    return min(holding, key=lambda each: (len(each.names), -probabilities[each.names]))


def _gains(case: OfCase, evidence: Array) -> dict[str, float]:
    plain = evidence[: len(case.sets)]
    out = {}
    for name in sorted({name for each in case.sets for name in each.names}):
        holds = np.array([name in each.names for each in case.sets])
        out[name] = float(plain[holds].max() - plain[~holds].max())
    return out
