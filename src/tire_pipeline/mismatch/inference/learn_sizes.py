"""Learn the sizes of the posterior from cases whose answer is known, by the log score of the true set.

The log evidence of every hypothesis is a smooth function of the sizes. It is worked out at a centre and at a
step to either side along each size, and taken for a parabola in between. The best sizes and odds of these
parabolas are found by gradient, for all sources of cases and without each of them, and are measured.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.evidence.hypotheses import (
    NO_MASS,
    asked,
    hypotheses,
    log_evidence,
    log_prior,
    plain,
    position,
)
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfCase
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes
from tire_pipeline.mismatch.model.simulated import DIFFERENCE

Array = np.ndarray
Names = tuple[str, ...]
Map = Callable[[Callable[["Tuning"], Array], Iterable["Tuning"]], Iterable[Array]]
_TRUSTED = (2.0, 1.0, 0.5)
"""Steps from a centre within which the parabolas are trusted; fewer where they promise too much."""
_SCALED_SIZES = ("independent", "growth", "form_error", "prior", "error", "spread", "wide")
_ODDS = ("effect", "further", "unnamed")
_SURPRISES = 0.01
"""Share of cases whose answer is as likely as any other: cases that nothing can explain must not decide the
sizes."""


@dataclass(frozen=True)
class Tuning:
    """One case whose answer is known.

    Parameters
    ----------
    case : OfCase
    source : str
        Simulator or family of recordings.
    truth : tuple of str
        What it holds, as far as a set of effects can say it.
    right : tuple of tuple of str
        All answers that are right: effects below the formula's misfit may be left out, and what a recording
        cannot tell from the truth may stand in its place.
    unnamed : tuple of bool
        Whether something unnamed has to be beside the names; both where either is right.
    kept : tuple of int, optional
        Numbers of the hypotheses that are weighed; all of them if left out.
    """

    case: OfCase
    source: str
    truth: Names
    right: tuple[Names, ...]
    unnamed: tuple[bool, ...] = (False,)
    kept: tuple[int, ...] | None = None

    def weighed(self, of: Array) -> Array:
        """Return the entries of the hypotheses that are weighed, from those of all, shape (h,)."""
        return of if self.kept is None else of[list(self.kept)]

    def rights(self) -> Array:
        """Return which of the hypotheses that are weighed are right, shape (h,)."""
        every = hypotheses(self.case)
        return self.weighed(np.array([h.names in self.right and h.unnamed in self.unnamed for h in every]))


def pruned(each: Tuning, sizes: LearntSizes) -> Tuning:
    """Return a case with the hypotheses that have mass and those that are right; the rest takes time only."""
    case, every = each.case, hypotheses(each.case)
    value = log_evidence(case, sizes) + log_prior(case, sizes)
    near = (value > value.max() - NO_MASS) | replace(each, kept=None).rights()
    wanted = {(h.names, h.wide, h.form) for h, here in zip(every, near, strict=True) if here}
    holding = {names for names, *_ in wanted} | {(), each.truth}
    smaller = replace(case, sets=tuple(s for s in case.sets if s.names in holding))
    kept = [k for k, h in enumerate(hypotheses(smaller)) if (h.names, h.wide, h.form) in wanted]
    return replace(each, case=smaller, kept=tuple(kept))


@dataclass(frozen=True)
class Learnt:
    """The learnt sizes and their score.

    Parameters
    ----------
    sizes : LearntSizes
    score : float
        Mean log score of the cases it was learnt from, each source counting alike.
    start : float
        The same of the sizes at which learning began, with their own odds.
    curvature : dict of float
        Number -> second derivative of the mean log score, its sign turned, by the logarithm of a size and by
        odds themselves, where the others stay.
    without : dict of LearntSizes
        Source of cases -> the sizes that the others teach.
    """

    sizes: LearntSizes
    score: float
    start: float
    curvature: Mapping[str, float]
    without: Mapping[str, LearntSizes]


def log_scores(
    cases: Sequence[Tuning],
    sizes: LearntSizes,
    mapped: Map = map,
    evidence: Iterable[Array] | None = None,
) -> Array:
    """Return the log probability of the right answer of each case, shape (cases,).

    Parameters
    ----------
    cases : sequence of Tuning
    sizes : LearntSizes
    mapped : callable
        ``map``, or one that spreads the work.
    evidence : iterable of ndarray, optional
        Log evidence of each case's hypotheses by these sizes, where it is at hand.
    """
    weighed = _Weighed(cases)
    known = weighed.evidence(sizes, mapped) if evidence is None else weighed.padded(evidence)
    return weighed.scores(known + weighed.odds(sizes))[0]


def evidence_about(case: Tuning, start: LearntSizes, step: float) -> Array:
    """Return the log evidence of a case's hypotheses at some sizes, and a step to either side of each.

    Parameters
    ----------
    case : Tuning
    start : LearntSizes
    step : float
        Factor by which each size is moved; 1 for the start alone.

    Returns
    -------
    ndarray, shape (1 + 2 k, h)
        At the start; then, for each of the ``k`` sizes, larger and smaller. Each row is below its largest.
    """
    steps: list[dict[str, float]] = [{}]
    steps += [{name: sign} for name in _moved_names(start, step) for sign in (1.0, -1.0)]
    return np.array([_EvidenceBy(moved(start, step, each))(case) for each in steps])


def _moved_names(start: LearntSizes, step: float) -> Names:
    return (*_SCALED_SIZES, *start.background) if step > 1.0 else ()


def learn(
    cases: Sequence[Tuning],
    start: LearntSizes,
    *,
    step: float,
    about: Sequence[Array] | None = None,
    mapped: Map = map,
) -> Learnt:
    """Return the sizes with the best mean log score about a start, each source of cases counting alike.

    Parameters
    ----------
    cases : sequence of Tuning
    start : LearntSizes
        No size goes farther from it than two steps: beyond, learning is begun again where it ended.
    step : float
        Factor by which each size is moved to see what it does; 1 to learn the odds alone.
    about : sequence of ndarray, optional
        :func:`evidence_about` of each case, where it is at hand.
    mapped : callable
        ``map``, or one that spreads the work.
    """
    known = [evidence_about(each, start, step) for each in cases] if about is None else about
    around = _Parabolas(cases, start, step, known)
    best, before, score = _bettered(around, mapped)
    sources = sorted({each.source for each in cases})
    without = {s: _bettered(around, mapped, s)[0] for s in sources if len(sources) > 1}
    sizes = replace(best, left=learnt_left(cases, best))
    return Learnt(sizes, score, before, around.curvature(best), without)


def _bettered(
    around: _Parabolas, mapped: Map, without: str | None = None
) -> tuple[LearntSizes, float, float]:
    """Return the best sizes that keep what the parabolas promise, and the score at the centre and there.

    They are the centre's own where no step betters the score.
    """
    shares = _shares(around.cases, without)
    before = float(shares @ around.scores_at_centre())
    for within in _TRUSTED:
        there = around.best(within, without)
        score = float(shares @ log_scores(around.cases, there, mapped))
        if score > before:
            return there, before, score
    return around.centre, before, before


def _shares(cases: Sequence[Tuning], without: str | None = None) -> Array:
    """Return the weight of each case: each source counts alike, one that is left out not at all."""
    sources = np.array([each.source for each in cases])
    shares = np.array([0.0 if s == without else 1.0 / np.sum(sources == s) for s in sources])
    return np.asarray(shares / shares.sum())


class _Parabolas:
    """The log evidence of all cases about some sizes: a parabola along each of them, for each hypothesis.

    Parameters
    ----------
    cases : sequence of Tuning
    centre : LearntSizes
    step : float
        Factor between the sizes through which the parabolas go.
    about : sequence of ndarray
        :func:`evidence_about` of each case.
    """

    def __init__(
        self, cases: Sequence[Tuning], centre: LearntSizes, step: float, about: Sequence[Array]
    ) -> None:
        self.cases, self.centre, self.step = list(cases), centre, step
        self.names = _moved_names(centre, step)
        self.weighed = _Weighed(self.cases)
        self.counts = self.weighed.counts(centre)
        self.middle, *sides = (self.weighed.padded(each) for each in zip(*about, strict=True))
        pairs = list(zip(sides[::2], sides[1::2], strict=True))
        self.slope = [0.5 * (more - less) for more, less in pairs]
        self.bend = [0.5 * (more + less) - self.middle for more, less in pairs]

    def scores_at_centre(self) -> Array:
        """Return the log probability of what is right in each case at the centre, shape (cases,)."""
        return self.weighed.scores(self.middle + self.weighed.odds(self.centre))[0]

    def best(self, within: float, without: str | None = None) -> LearntSizes:
        """Return the best sizes and odds within some steps of the centre, if the parabolas are right.

        Parameters
        ----------
        within : float
        without : str, optional
            A source whose cases are left out.
        """
        shares = _shares(self.cases, without)

        def loss(x: Array) -> tuple[float, Array]:
            value, slope = self._score(x, shares)
            return -value, -slope

        count = len(self.names)
        bounds = [(-within, within)] * count + [(None, 0.0)] * len(_ODDS)
        begin = np.r_[np.zeros(count), [min(getattr(self.centre, name), 0.0) for name in _ODDS]]
        x = scipy.optimize.minimize(loss, begin, jac=True, method="L-BFGS-B", bounds=bounds).x
        found = moved(self.centre, self.step, dict(zip(self.names, x[:count], strict=True)))
        return _with_odds(found, x[count:])

    def curvature(self, sizes: LearntSizes) -> dict[str, float]:
        """Return :attr:`Learnt.curvature` at the best sizes near the centre."""
        x, shares, out = self._place(sizes), _shares(self.cases), {}
        for k, name in enumerate([*self.names, *_ODDS]):
            unit = np.eye(x.size)[k] * DIFFERENCE
            slopes = [self._score(x + sign * unit, shares)[1][k] for sign in (1.0, -1.0)]
            per = np.log(self.step) if k < len(self.names) else 1.0
            out[name] = float((slopes[1] - slopes[0]) / (2.0 * DIFFERENCE * per**2))
        return out

    def _place(self, sizes: LearntSizes) -> Array:
        steps = [np.log(_size(sizes, n) / _size(self.centre, n)) / np.log(self.step) for n in self.names]
        return np.array([*steps, *(getattr(sizes, name) for name in _ODDS)])

    def _score(self, x: Array, shares: Array) -> tuple[float, Array]:
        """Return the mean log score some steps from the centre, and its derivatives."""
        count = len(self.names)
        along = list(zip(x[:count], self.slope, self.bend, strict=True))
        evidence = self.middle + sum((t * a + t**2 * b for t, a, b in along), 0.0)
        odds = self.weighed.odds(_with_odds(self.centre, x[count:]))
        scores, slopes = self.weighed.scores(evidence + odds)
        by = shares[:, None] * slopes
        sizes = [np.sum(by * (a + 2.0 * t * b)) for t, a, b in along]
        return float(shares @ scores), np.array([*sizes, *(np.sum(by * c) for c in self.counts)])


def _size(sizes: LearntSizes, name: str) -> float:
    return float(sizes.background[name] if name in sizes.background else getattr(sizes, name))


def moved(sizes: LearntSizes, step: float, steps: Mapping[str, float]) -> LearntSizes:
    """Return sizes so many steps away; no part is larger than the whole."""
    factor = {name: float(step**count) for name, count in steps.items()}
    own: dict[str, Any] = {name: getattr(sizes, name) * factor.get(name, 1.0) for name in _SCALED_SIZES}
    own["growth"] = min(own["growth"], 1.0)
    own["background"] = {f: s * factor.get(f, 1.0) for f, s in sizes.background.items()}
    return replace(sizes, **own)


def _with_odds(sizes: LearntSizes, odds: Array) -> LearntSizes:
    effect, further, unnamed = map(float, odds)
    return replace(sizes, effect=effect, further=further, unnamed=unnamed)


class _Weighed:
    """What the odds and the score of many cases need, padded to one length."""

    def __init__(self, cases: Sequence[Tuning]) -> None:
        self.cases, rights = list(cases), [each.rights() for each in cases]
        self.count = np.array([each.size for each in rights])
        shape = (len(cases), int(self.count.max()))
        self.there = np.arange(shape[1]) < self.count[:, None]
        self.right, self.wide = np.zeros(shape, bool), np.zeros(shape, bool)
        self.effects, self.expected, self.forms = (np.zeros(shape, int) for _ in range(3))
        for k, (each, right) in enumerate(zip(cases, rights, strict=True)):
            odds, here = asked(each.case), (k, slice(right.size))
            self.right[here] = right
            self.effects[here], self.expected[here] = each.weighed(odds.effects), each.weighed(odds.expected)
            self.wide[here], self.forms[here] = each.weighed(odds.wide), each.weighed(odds.forms)

    def counts(self, sizes: LearntSizes) -> list[Array]:
        """Return how often each of the odds stands in those of a hypothesis, each of shape (cases, h)."""
        nothing = self.odds(_with_odds(sizes, np.zeros(len(_ODDS))))
        return [self.odds(_with_odds(sizes, unit)) - nothing for unit in np.eye(len(_ODDS))]

    def odds(self, sizes: LearntSizes) -> Array:
        """Return the log odds of each hypothesis, shape (cases, h)."""
        return sizes.log_prior(self.effects, self.expected, unnamed=self.wide, forms=self.forms)

    def evidence(self, sizes: LearntSizes, mapped: Map) -> Array:
        """Return the log evidence of each hypothesis by some sizes, shape (cases, h), below the largest."""
        return self.padded(mapped(_EvidenceBy(sizes), self.cases))

    def padded(self, evidence: Iterable[Array]) -> Array:
        """Return what is said of each case's hypotheses in one array, shape (cases, h)."""
        out = np.zeros(self.right.shape)
        for k, each in enumerate(evidence):
            out[k, : each.size] = each
        return out

    def scores(self, value: Array) -> tuple[Array, Array]:
        """Return the log probability of what is right in each case, and its derivatives by each log odds."""
        mass = scipy.special.softmax(np.where(self.there, value, -np.inf), axis=1)
        right = np.where(self.right, mass, 0.0).sum(axis=1)
        held = (1.0 - _SURPRISES) * right + _SURPRISES / self.count
        slopes = ((1.0 - _SURPRISES) / held)[:, None] * mass * (self.right - right[:, None])
        return np.log(held), slopes


@dataclass(frozen=True)
class _EvidenceBy:
    """Log evidence of a case by some sizes, below the largest; can be sent to another process."""

    sizes: LearntSizes

    def __call__(self, each: Tuning) -> Array:
        found = log_evidence(each.case, self.sizes, which=each.kept)
        return np.asarray(found - found.max())


def learnt_left(cases: Sequence[Tuning], sizes: LearntSizes) -> tuple[float, float]:
    """Return between which sizes two of three recordings leave an error beside their true sets.

    Over the largest force, with an error of any size as likely beforehand. Each source counts alike, and what
    lies between them is part of the spread: a stranger's rig is one more source. It serves no probability.
    """
    logs: dict[str, list[float]] = {}
    for each in cases:
        index = None if True in each.unnamed else position(each.case, each.truth)
        if index is None:
            continue
        own, likelihood = each.case.sets[index], Likelihood(each.case.unknown, sizes)
        found = plain(likelihood, own, wide=True)
        logs.setdefault(each.source, []).extend(np.log(list(found.errors.values())))
    if not logs:
        return sizes.left
    means, within = np.array([(np.mean(x), np.var(x)) for x in logs.values()]).T
    apart = float(np.sqrt(means.var() + within.mean()))
    return float(np.exp(means.mean() - apart)), float(np.exp(means.mean() + apart))
