"""Learn the sizes of the posterior from cases whose answer is known, by the log score of the true set.

Each size is tried a step larger and a step smaller, with the odds that are best for it, until no step betters
the score. What the cases say at one choice of sizes is worked out once: searches that leave one source out
pass mostly through the same choices.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.evidence.hypotheses import (
    Hypothesis,
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

Array = np.ndarray
Names = tuple[str, ...]
Map = Callable[[Callable[["Tuning"], Array], Iterable["Tuning"]], Iterable[Array]]
_STEP = 1.6
_ROUNDS = 4
_FACTORS = ("independent", "form_error", "prior", "error", "spread", "wide")
_ODDS = ("effect", "further", "unnamed")
_SURPRISES = 0.01
"""Share of cases whose answer is as likely as any other: what the posterior cannot know must not rule it."""
_NEAR = 12.0
"""Log odds to the likeliest hypothesis beyond which one has no mass, nor near these sizes."""
_GAIN = 1e-4
"""Gain in mean log score below which a step is not taken: a hundredth of what a single case in a hundred
gives."""


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

    def weighed(self, of: Sequence[Hypothesis] | Array) -> list[Hypothesis] | Array:
        """Return those of a list over all hypotheses that are weighed."""
        if isinstance(of, np.ndarray):
            return of if self.kept is None else of[list(self.kept)]
        return list(of) if self.kept is None else [of[k] for k in self.kept]

    def rights(self) -> Array:
        """Return which of the hypotheses that are weighed are right, shape (h,)."""
        every = self.weighed(hypotheses(self.case))
        return np.array([each.names in self.right and each.unnamed in self.unnamed for each in every])


def pruned(each: Tuning, sizes: LearntSizes) -> Tuning:
    """Return a case with the hypotheses that have mass and those that are right; the rest takes time only."""
    case, every = each.case, hypotheses(each.case)
    value = log_evidence(case, sizes) + log_prior(case, sizes)
    near = (value > value.max() - _NEAR) | replace(each, kept=None).rights()
    wanted = {(h.names, h.wide, h.form) for h, here in zip(every, near, strict=True) if here}
    holding = {names for names, *_ in wanted} | {(), each.truth}
    smaller = replace(case, sets=tuple(s for s in case.sets if s.names in holding))
    kept = [k for k, h in enumerate(hypotheses(smaller)) if (h.names, h.wide, h.form) in wanted]
    return replace(each, case=smaller, kept=tuple(kept))


class Evidences:
    """Log evidence of the hypotheses of many cases, for each choice of sizes worked out once.

    Parameters
    ----------
    cases : sequence of Tuning
    mapped : callable
        ``map``, or one that spreads the work.
    """

    def __init__(self, cases: Sequence[Tuning], mapped: Map = map) -> None:
        self.cases, self._mapped = tuple(cases), mapped
        self._known: dict[str, list[Array]] = {}

    def at(self, sizes: LearntSizes) -> list[Array]:
        """Return it by some sizes, case by case, each of shape (h,); odds have no part in it."""
        key = repr(replace(sizes, effect=0.0, further=0.0, unnamed=0.0, left=(0.0, 0.0)))
        if key not in self._known:
            self._known[key] = list(self._mapped(_EvidenceBy(sizes), self.cases))
        return self._known[key]


@dataclass(frozen=True)
class Learnt:
    """What was learnt.

    Parameters
    ----------
    sizes : LearntSizes
    score : float
        Mean log score of the cases it was learnt from, each source counting alike.
    start : float
        The same of the sizes at which learning began, with their own odds.
    curvature : dict of float
        Number -> how much mean log score a step from the best costs: half the second derivative, by the
        logarithm of a size and by odds themselves. The odds are the best ones beside each size.
    """

    sizes: LearntSizes
    score: float
    start: float
    curvature: Mapping[str, float] = field(default_factory=dict)


def log_scores(cases: Sequence[Tuning], sizes: LearntSizes) -> Array:
    """Return the log probability of the right answer of each case, shape (cases,)."""
    return _Weighed(cases, Evidences(cases).at(sizes)).scores(sizes)


def learn(
    evidences: Evidences, start: LearntSizes, *, step: float = _STEP, without: str | None = None
) -> Learnt:
    """Return the sizes with the best mean log score, each source of cases counting alike.

    Parameters
    ----------
    evidences : Evidences
    start : LearntSizes
    step : float
        Factor by which each size is tried larger and smaller; 1 to learn the odds alone.
    without : str, optional
        A source whose cases are left out.
    """
    search = _SizeSearch(evidences, start, step, without)
    at: dict[str, int] = {}
    best, sizes = search.best(at)
    names = [*_FACTORS, *start.background] if step > 1.0 else []
    for _ in range(_ROUNDS):
        before = best
        for name in names:
            at, best, sizes = search.along(name, at, best, sizes)
        if best == before:
            break
    sizes = replace(sizes, left=learnt_left(search.cases, sizes))
    return Learnt(sizes, best, search.score(start), search.curvature(names, at, best, sizes))


class _SizeSearch:
    """Sizes on a grid of steps about a start, and how well they do with the odds that are best for them."""

    def __init__(self, evidences: Evidences, start: LearntSizes, step: float, without: str | None) -> None:
        self.evidences, self.start, self.step = evidences, start, step
        self.chosen = [k for k, each in enumerate(evidences.cases) if each.source != without]
        self.cases = [evidences.cases[k] for k in self.chosen]
        sources = [each.source for each in self.cases]
        self.shares = np.array([1.0 / sources.count(s) / len(set(sources)) for s in sources])

    def weighed(self, sizes: LearntSizes) -> _Weighed:
        """Return the cases as they are weighed by some sizes."""
        every = self.evidences.at(sizes)
        return _Weighed(self.cases, [every[k] for k in self.chosen])

    def score(self, sizes: LearntSizes) -> float:
        """Return the mean log score of some sizes with their own odds."""
        return float(self.shares @ self.weighed(sizes).scores(sizes))

    def best(self, at: Mapping[str, int]) -> tuple[float, LearntSizes]:
        """Return the best mean log score so many steps from the start, and the sizes with the odds for it."""
        sizes = _moved(self.start, self.step, at)
        weighed = self.weighed(sizes)
        begin = np.array([getattr(sizes, name) for name in _ODDS])
        found = scipy.optimize.minimize(
            lambda x: -float(self.shares @ weighed.scores(_with_odds(sizes, x))),
            begin,
            method="Nelder-Mead",
            options={"initial_simplex": np.vstack([begin, begin + np.eye(begin.size)]), "fatol": _GAIN / 10},
        )
        return -float(found.fun), _with_odds(sizes, found.x)

    def along(
        self, name: str, at: dict[str, int], best: float, sizes: LearntSizes
    ) -> tuple[dict[str, int], float, LearntSizes]:
        """Go along one size as long as it helps."""
        for sign in (1, -1):
            here = at
            while True:
                trial = {**at, name: at.get(name, 0) + sign}
                tried, there = self.best(trial)
                if tried <= best + _GAIN:
                    break
                at, best, sizes = trial, tried, there
            if at is not here:
                break
        return at, best, sizes

    def curvature(
        self, names: Sequence[str], at: Mapping[str, int], best: float, sizes: LearntSizes
    ) -> dict[str, float]:
        """Return half the second derivative of the score at the best sizes and odds, its sign turned."""
        out = {}
        for name in names:
            beside = [self.best({**at, name: at.get(name, 0) + sign})[0] for sign in (1, -1)]
            out[name] = (best - 0.5 * sum(beside)) / np.log(self.step) ** 2
        weighed = self.weighed(sizes)
        for name in _ODDS:
            moved = [replace(sizes, **{name: getattr(sizes, name) + d}) for d in (1.0, -1.0)]
            out[name] = best - 0.5 * sum(float(self.shares @ weighed.scores(each)) for each in moved)
        return {name: float(value) for name, value in out.items()}


def _moved(start: LearntSizes, step: float, at: Mapping[str, int]) -> LearntSizes:
    """Return the sizes so many steps from a start; no part is larger than the whole."""
    factor = {name: step**count for name, count in at.items()}
    own: dict[str, Any] = {name: getattr(start, name) * factor.get(name, 1.0) for name in _FACTORS}
    own["independent"] = min(own["independent"], 1.0)
    own["background"] = {f: s * factor.get(f, 1.0) for f, s in start.background.items()}
    return replace(start, **own)


def _with_odds(sizes: LearntSizes, odds: Array) -> LearntSizes:
    effect, further, unnamed = map(float, odds)
    return replace(sizes, effect=effect, further=further, unnamed=unnamed)


class _Weighed:
    """The evidence of the hypotheses of many cases, padded to one length, with what their odds need."""

    def __init__(self, cases: Sequence[Tuning], evidences: Sequence[Array]) -> None:
        self.count = np.array([each.size for each in evidences])
        shape = (len(cases), int(self.count.max()))
        self.evidence = np.full(shape, -np.inf)
        self.right, self.wide = np.zeros(shape, bool), np.zeros(shape, bool)
        self.effects, self.expected, self.forms = (np.zeros(shape, int) for _ in range(3))
        for k, (each, found) in enumerate(zip(cases, evidences, strict=True)):
            odds, here = asked(each.case), (k, slice(found.size))
            self.evidence[here], self.right[here] = found, each.rights()
            self.effects[here], self.expected[here] = each.weighed(odds.effects), each.weighed(odds.expected)
            self.wide[here], self.forms[here] = each.weighed(odds.wide), each.weighed(odds.forms)

    def scores(self, sizes: LearntSizes) -> Array:
        """Return the log probability of what is right in each case, shape (cases,)."""
        prior = sizes.log_prior(self.effects, self.expected, unnamed=self.wide, forms=self.forms)
        mass = scipy.special.softmax(self.evidence + prior, axis=1)
        right = np.where(self.right, mass, 0.0).sum(axis=1)
        return np.log((1.0 - _SURPRISES) * right + _SURPRISES / self.count)


@dataclass(frozen=True)
class _EvidenceBy:
    """Log evidence of a case by some sizes; can be sent to another process."""

    sizes: LearntSizes

    def __call__(self, each: Tuning) -> Array:
        return log_evidence(each.case, self.sizes, which=each.kept)


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
