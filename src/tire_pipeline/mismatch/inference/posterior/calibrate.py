"""Learn the sizes of the posterior from cases whose answer is known, by the log score of the true set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from tire_pipeline.mismatch.inference.posterior.evidence import (
    background_power,
    hypotheses,
    log_evidence,
    position,
)
from tire_pipeline.mismatch.inference.posterior.products import OfCase
from tire_pipeline.mismatch.inference.posterior.sizes import LearntSizes

Array = np.ndarray
Names = tuple[str, ...]
START = LearntSizes(
    background=dict.fromkeys(
        "side scale lag slow speed inclination pressure wheel path unnamed".split(), 0.004
    ),
    form_error=0.15,
    tails=3.0,
    wide=5.0,
    prior=1.0,
    exponent=0.05,
    samples=8.0,
    effect=-3.0,
    further=-5.0,
    unnamed=-3.0,
)
"""Where learning begins: the misfit of a good formula, and odds of one to a hundred or so."""
_ROUNDS = 12
_FACTORS = ("background", "form_error", "tails", "wide", "prior")
_SURPRISES = 0.02
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
    unnamed : bool
        Whether what it holds is in no catalogue.
    """

    case: OfCase
    source: str
    truth: Names
    right: tuple[Names, ...]
    unnamed: bool = False

    def rights(self) -> Array:
        """Return which hypotheses are right, shape (h,)."""
        return np.array(
            [
                each.unnamed if self.unnamed else each.names in self.right and not each.unnamed
                for each in hypotheses(self.case)
            ]
        )


def pruned(each: Tuning, most: int = 14) -> Tuning:
    """Return a case with its likeliest sets and those that are right: the rest takes time and no mass."""
    case = each.case
    evidence = log_evidence(case, START)[: len(case.sets)]
    value = START.exponent * evidence - 0.5 * START.samples * np.array([s.power for s in case.sets])
    kept = {0, *np.argsort(-value)[:most], *np.argsort(-evidence)[: most // 2]}
    kept |= {k for k, s in enumerate(case.sets) if s.names in each.right or s.names == each.truth}
    sets = tuple(case.sets[k] for k in sorted(kept))
    return replace(each, case=replace(case, sets=sets))


def log_scores(cases: Sequence[Tuning], sizes: LearntSizes) -> Array:
    """Return the log probability of the right answer of each case, shape (cases,)."""
    return _scores([_Weighed(each, log_evidence(each.case, sizes)) for each in cases], sizes)


def learn(
    cases: Sequence[Tuning], start: LearntSizes = START, steps: Sequence[float] = (2.0,)
) -> LearntSizes:
    """Return the sizes with the best mean log score.

    The sizes of the background come first, family by family, from how large it is in cases whose truth is
    known (expectation and maximisation). Then a common factor on them, the form error, the wide form and the
    factor on the priors are searched one by one, with exponent and odds the best for each of them.

    Parameters
    ----------
    cases : sequence of Tuning
    start : LearntSizes
    steps : sequence of float
        Factors by which the four are tried larger and smaller; none to leave them as they are.
    """
    sizes = replace(start, background=learnt_background(cases, start))
    best, sizes = _best_odds(cases, sizes)
    for step in steps:
        for name in _FACTORS:
            for factor in (step, 1.0 / step):
                trial, there = _best_odds(cases, _scaled(sizes, name, factor))
                if trial > best:
                    best, sizes = trial, there
                    break
    return sizes


def learnt_background(cases: Sequence[Tuning], sizes: LearntSizes) -> dict[str, float]:
    """Return the size of each family that makes the cases likeliest, given their true sets."""
    known = [(each, position(each.case, each.truth)) for each in cases if not each.unnamed]
    pairs = [(each.case, index) for each, index in known if index is not None]
    for _ in range(_ROUNDS):
        logs: dict[str, list[float]] = {family: [] for family in sizes.background}
        for case, index in pairs:
            power, families = background_power(case, index, sizes), np.array(case.families)
            for family in set(case.families):
                logs[family].append(float(np.log(np.mean(power[families == family]))))
        sizes = replace(
            sizes,
            background={
                f: s * float(np.exp(0.5 * np.mean(logs[f]))) if logs[f] else s
                for f, s in sizes.background.items()
            },
        )
    return dict(sizes.background)


class _Weighed:
    """The evidence of the hypotheses of one case, with what their odds and the score need."""

    def __init__(self, each: Tuning, evidence: Array) -> None:
        every = hypotheses(each.case)
        self.evidence = evidence - evidence.max()
        self.power = np.array([h.effects.power for h in every])
        self.count = np.array([len(h.names) for h in every])
        self.unnamed = np.array([h.unnamed for h in every])
        self.right = each.rights()

    def score(self, sizes: LearntSizes) -> float:
        """Return the log probability of what is right."""
        odds = sizes.effect * (self.count > 0) + sizes.further * np.maximum(self.count - 1, 0)
        value = sizes.exponent * self.evidence - 0.5 * sizes.samples * self.power
        mass = scipy.special.softmax(value + odds + sizes.unnamed * self.unnamed)
        return float(np.log((1.0 - _SURPRISES) * mass[self.right].sum() + _SURPRISES / mass.size))


def _scores(cases: Sequence[_Weighed], sizes: LearntSizes) -> Array:
    return np.array([each.score(sizes) for each in cases])


def _best_odds(cases: Sequence[Tuning], sizes: LearntSizes) -> tuple[float, LearntSizes]:
    """Return the best mean log score, and the sizes with exponent and odds that give it."""
    weighed = [_Weighed(each, log_evidence(each.case, sizes)) for each in cases]

    def at(x: Array) -> LearntSizes:
        exponent = float(np.exp(min(x[0], 0.0)))
        moved = replace(sizes, exponent=exponent, samples=float(np.exp(x[4])))
        return replace(moved, effect=float(x[1]), further=float(x[2]), unnamed=float(x[3]))

    begin = np.array(
        [np.log(sizes.exponent), sizes.effect, sizes.further, sizes.unnamed, np.log(sizes.samples)]
    )
    found = scipy.optimize.minimize(
        lambda x: -float(np.mean(_scores(weighed, at(x)))),
        begin,
        method="Nelder-Mead",
        options={"initial_simplex": np.vstack([begin, begin + np.eye(begin.size)]), "fatol": 1e-4},
    )
    return -float(found.fun), at(found.x)


def _scaled(sizes: LearntSizes, name: str, factor: float) -> LearntSizes:
    if name == "background":
        return replace(sizes, background={f: s * factor for f, s in sizes.background.items()})
    return replace(sizes, **{name: getattr(sizes, name) * factor})
