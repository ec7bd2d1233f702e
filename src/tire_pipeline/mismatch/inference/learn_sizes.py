"""Learn the sizes of the posterior from cases whose answer is known, by the log score of the true set."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.evidence.hypotheses import (
    asked,
    hypotheses,
    log_evidence,
    plain,
    position,
)
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.evidence.products import OfCase
from tire_pipeline.mismatch.inference.learnt.sizes import LearntSizes

Array = np.ndarray
Names = tuple[str, ...]
Map = Callable[[Callable[[OfCase], Array], Iterable[OfCase]], Iterable[Array]]
START = LearntSizes(
    background=dict.fromkeys(
        "side scale lag slow speed inclination pressure wheel path unnamed".split(), 0.002
    ),
    form_error=0.15,
    prior=1.0,
    independent=0.3,
    error=0.012,
    spread=0.7,
    wide=0.02,
    effect=-3.5,
    further=-4.0,
    unnamed=-2.0,
    left=(0.006, 0.022),
)
"""Where learning begins: the misfit of a good formula, and odds of one to thirty or so."""
_ROUNDS_OF_LEARNING = 3
_LEARNT_FACTORS = ("independent", "background", "form_error", "prior", "error", "spread", "wide")
_SURPRISES = 0.01
"""Share of cases whose answer is as likely as any other: what the posterior cannot know must not rule it."""


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
    """

    case: OfCase
    source: str
    truth: Names
    right: tuple[Names, ...]
    unnamed: tuple[bool, ...] = (False,)

    def rights(self) -> Array:
        """Return which hypotheses are right, shape (h,)."""
        every = hypotheses(self.case)
        return np.array([each.names in self.right and each.unnamed in self.unnamed for each in every])


def pruned(each: Tuning, most: int = 16) -> Tuning:
    """Return a case with its likeliest sets and those that are right: the rest takes time and no mass."""
    case = each.case
    evidence = log_evidence(case, START)[: len(case.sets)]
    kept = {0, *np.argsort(-evidence)[:most]}
    kept |= {k for k, s in enumerate(case.sets) if s.names in each.right or s.names == each.truth}
    sets = tuple(case.sets[k] for k in sorted(kept))
    return replace(each, case=replace(case, sets=sets))


def log_scores(cases: Sequence[Tuning], sizes: LearntSizes) -> Array:
    """Return the log probability of the right answer of each case, shape (cases,)."""
    return _scores(_weighed(cases, sizes, map), sizes)


def learn(
    cases: Sequence[Tuning],
    start: LearntSizes = START,
    steps: Sequence[float] = (1.6,),
    *,
    mapped: Map = map,
) -> LearntSizes:
    """Return the sizes with the best mean log score, each source of cases counting alike.

    The sizes of the background come first, family by family, from how large it is in cases whose truth is
    known (expectation and maximisation). Then each number is tried larger and smaller, with the odds the
    best for each of them. What fitted models leave comes last: it serves no probability.

    Parameters
    ----------
    cases : sequence of Tuning
    start : LearntSizes
    steps : sequence of float
        Factors by which the numbers are tried larger and smaller; none to leave them as they are.
    mapped : callable
        ``map``, or one that spreads the work.
    """
    sizes = start
    for _ in range(_ROUNDS_OF_LEARNING if steps else 1):
        sizes = replace(sizes, background=learnt_background(cases, sizes))
    best, sizes = _best_odds(cases, sizes, mapped)
    for step in steps:
        for name in _LEARNT_FACTORS:
            for factor in (step, 1.0 / step):
                trial, there = _best_odds(cases, _scaled(sizes, name, factor), mapped)
                if trial > best:
                    best, sizes = trial, there
                    break
    return replace(sizes, left=learnt_left(cases, sizes))


def learnt_background(cases: Sequence[Tuning], sizes: LearntSizes) -> dict[str, float]:
    """Return the size of each family that makes the cases likeliest, given their true sets (one step)."""
    logs: dict[str, list[float]] = {family: [] for family in sizes.background}
    for each in cases:
        index = None if True in each.unnamed else position(each.case, each.truth)
        if index is None:
            continue
        power, families = background_power(each.case, index, sizes), np.array(each.case.unknown.families)
        for family in set(each.case.unknown.families):
            logs[family].append(float(np.log(np.mean(power[families == family]))))
    return {
        f: s * float(np.exp(0.5 * np.mean(logs[f]))) if logs[f] else s for f, s in sizes.background.items()
    }


def learnt_left(cases: Sequence[Tuning], sizes: LearntSizes) -> tuple[float, float]:
    """Return between which sizes two of three recordings leave an error beside their true sets.

    Over the largest force, with an error of any size as likely beforehand. Each source counts alike, and what
    lies between them is part of the spread: a stranger's rig is one more source.
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


def background_power(case: OfCase, index: int, sizes: LearntSizes) -> Array:
    """Return the expected square of each background coefficient over its variance, given one set.

    Parameters
    ----------
    case : OfCase
    index : int
        Number of the set.
    sizes : LearntSizes

    Returns
    -------
    ndarray, shape (b,)
        Mean of the outputs. 1 if the recording says nothing of it.
    """
    likelihood, each = Likelihood(case.unknown, sizes), case.sets[index]
    products, found = each.plain, plain(likelihood, each)
    count, spread = len(case.unknown.families), sizes.of(case.unknown.families)
    power = np.zeros(count)
    for o, weights in found.weights.items():
        residual = np.r_[-found.mode, 1.0]
        mean = weights.known(products.nuisance[o] @ residual)[-count:]
        open_part = weights.vectors[-count:] ** 2 / (1.0 + weights.precision * weights.values)
        power += (mean**2 + open_part.sum(axis=1)) / spread**2
    return power / len(found.weights)


class _Weighed:
    """The evidence of the hypotheses of one case, with what their odds and the score need."""

    def __init__(self, each: Tuning, evidence: Array, share: float) -> None:
        self.evidence = evidence - evidence.max()
        self.asked, self.right, self.share = asked(each.case), each.rights(), share

    def score(self, sizes: LearntSizes) -> float:
        """Return the log probability of what is right."""
        mass = scipy.special.softmax(self.evidence + self.asked.log_prior(sizes))
        return float(np.log((1.0 - _SURPRISES) * mass[self.right].sum() + _SURPRISES / mass.size))


def _weighed(cases: Sequence[Tuning], sizes: LearntSizes, mapped: Map) -> list[_Weighed]:
    sources = [each.source for each in cases]
    shares = [1.0 / sources.count(source) / len(set(sources)) for source in sources]
    evidences = mapped(_EvidenceBy(sizes), [each.case for each in cases])
    return [_Weighed(each, e, share) for each, e, share in zip(cases, evidences, shares, strict=True)]


@dataclass(frozen=True)
class _EvidenceBy:
    """Log evidence of a case by some sizes; can be sent to another process."""

    sizes: LearntSizes

    def __call__(self, case: OfCase) -> Array:
        return log_evidence(case, self.sizes)


def _scores(cases: Sequence[_Weighed], sizes: LearntSizes) -> Array:
    return np.array([each.score(sizes) for each in cases])


def _best_odds(cases: Sequence[Tuning], sizes: LearntSizes, mapped: Map) -> tuple[float, LearntSizes]:
    """Return the best mean log score, and the sizes with the odds that give it."""
    weighed = _weighed(cases, sizes, mapped)
    shares = np.array([each.share for each in weighed])

    def at(x: Array) -> LearntSizes:
        return replace(sizes, effect=float(x[0]), further=float(x[1]), unnamed=float(x[2]))

    begin = np.array([sizes.effect, sizes.further, sizes.unnamed])
    found = scipy.optimize.minimize(
        lambda x: -float(shares @ _scores(weighed, at(x))),
        begin,
        method="Nelder-Mead",
        options={"initial_simplex": np.vstack([begin, begin + np.eye(begin.size)]), "fatol": 1e-4},
    )
    return -float(found.fun), at(found.x)


def _scaled(sizes: LearntSizes, name: str, factor: float) -> LearntSizes:
    if name == "background":
        return replace(sizes, background={f: s * factor for f, s in sizes.background.items()})
    return replace(sizes, **{name: getattr(sizes, name) * factor})
