"""Look for days at which a category changed how it measures.

What the mixed model leaves of every tire is laid out by date. A change shows as a step in one category that
the other categories' tires of the same days do not show: tires that become better over the years are no
change of protocol. The evidence for a step of unknown size on an unknown day is weighed against none; either
way all categories' tires may have changed, too.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from tire_pipeline.translation.population.protocols.of_files import Change

PRIOR = 0.01
"""Probability that a category changed its protocol, before the files are looked at."""

CLEAR = 0.95
"""Probability from which a change is taken for one."""

_SHUFFLES = 399
"""How often the tires' days are shuffled."""

RARE = 0.005
"""Share of shuffles with as much evidence (that of the true order counted) from which on a change may be
chance: 3% for six categories. Of a dozen tires spreads and covariances are not known well enough for the odds
alone: of fleets of 11 to 20 tires a category, nothing but noise, a fifth had a change."""

_CHANGE_SIZES = np.array([0.01, 0.03, 0.1, 0.3, 1.0])  # variance of a step in units of the tires' own
_TRENDS = np.array([0.0, *_CHANGE_SIZES])  # the same of what all categories' tires have changed by
_FEWEST_TIRES = 5  # tires on either side of the day
_FEWEST_SHARE = 0.1  # of the category's dated tires on either side
_MOST_SPREADS = 4.0  # robust standard deviations beyond which a tire counts no more
_RANGE = 0.05, 0.95


@dataclass(frozen=True)
class Dated:
    """What is left of every cell (tire in a category), and when its files were measured.

    Attributes
    ----------
    gap : ndarray, shape (c, p)
        Scores less their expectation.
    category : ndarray of str, shape (c,)
    day : ndarray of datetime64[D], shape (n,)
        Of every file; NaT where it has no date.
    cell : ndarray of int, shape (n,)
        The cell of every file.
    """

    gap: np.ndarray
    category: np.ndarray
    day: np.ndarray
    cell: np.ndarray


def find_changes(
    found: Dated, parts: Mapping[str, slice], *, most_by_chance: float = RARE
) -> tuple[Change, ...]:
    """Find each category's change of protocol, the clearest first; at most one a category.

    Parameters
    ----------
    found : Dated
    parts : mapping
        The scores of ``gap`` that change together, by name. A change need not show in all parts.
    most_by_chance : float
        Share of shuffles of the days that may give as much evidence as their true order.

    Returns
    -------
    tuple of Change
    """
    day = _first_days(found)
    values = _values(found, day, parts)
    changes: list[Change] = []
    left = [str(name) for name in np.unique(found.category)]
    while left:
        looked = {
            name: look for name in left if (look := _look(found.category, day, values, name)) is not None
        }
        best = max(looked, key=lambda name: looked[name].evidence, default=None)
        if best is None or looked[best].probability < CLEAR:
            break
        left.remove(best)
        if not _rare(found, day, parts, best, looked[best].evidence, most_by_chance):
            continue
        changes.append(looked[best].change(best))
        _remove_step(found.category, day, values, best, looked[best])
    return tuple(changes)


@dataclass(frozen=True)
class _DayEvidence:
    """What was found of one category: evidence by day, logarithms of the odds against no change."""

    days: np.ndarray
    odds: np.ndarray
    tires: np.ndarray

    @property
    def evidence(self) -> float:
        """Logarithm of the odds of a change on any day."""
        return float(logsumexp(self.odds) - np.log(self.odds.size))

    @property
    def probability(self) -> float:
        """Of a change."""
        return float(1.0 / (1.0 + (1.0 - PRIOR) / PRIOR * np.exp(-self.evidence)))

    @property
    def day(self) -> np.datetime64:
        """The most probable day."""
        return np.datetime64(self.days[int(self.odds.argmax())], "D")

    def change(self, category: str) -> Change:
        """Put it in days and numbers of tires."""
        cumulated = np.cumsum(np.exp(self.odds - logsumexp(self.odds)))
        places = np.minimum(np.searchsorted(cumulated, _RANGE), self.days.size - 1)
        earliest, latest = self.days[places]
        after = int((self.tires >= self.day).sum())
        ends = (str(self.day), str(earliest), str(latest))
        return Change(category, *ends, self.probability, self.tires.size - after, after)


def _whitened(gap: np.ndarray, category: np.ndarray, day: np.ndarray) -> np.ndarray:
    """Scores of one part about each category's middle, uncorrelated and of variance 1; far ones drawn in.

    Spread and covariance are those of tires that follow each other in time: steps and trends do not widen
    them. Without a date: 0.
    """
    scaled, apart = np.zeros_like(gap), []
    for name in np.unique(category):
        own = np.flatnonzero((category == name) & ~np.isnat(day))
        own = own[np.argsort(day[own], kind="stable")]
        if own.size < 3:
            continue
        middle = np.median(gap[own], axis=0)
        spread = 1.4826 * np.median(np.abs(np.diff(gap[own], axis=0)), axis=0) / np.sqrt(2.0)
        scaled[own] = np.clip((gap[own] - middle) / np.maximum(spread, 1e-9), -_MOST_SPREADS, _MOST_SPREADS)
        apart.append(np.diff(scaled[own], axis=0))
    if not apart:
        return scaled
    steps = np.concatenate(apart)
    covariance = steps.T @ steps / (2.0 * len(steps)) + 1e-6 * np.eye(gap.shape[1])
    return np.asarray(np.linalg.solve(np.linalg.cholesky(covariance), scaled.T).T)


def _first_days(found: Dated) -> np.ndarray:
    """First day of each cell's files, (c,); NaT where none has a date."""
    known = ~np.isnat(found.day)
    first = np.full(len(found.gap), np.iinfo(np.int64).max)
    np.minimum.at(first, found.cell[known], found.day[known].astype(np.int64))
    days = np.where(first == np.iinfo(np.int64).max, 0, first).astype("datetime64[D]")
    days[first == np.iinfo(np.int64).max] = np.datetime64("NaT")
    return days


def _steps(
    values: np.ndarray, day: np.ndarray, group: np.ndarray, days: np.ndarray
) -> tuple[np.ndarray, ...]:
    """Mean difference after less before each of ``days``, (days, p), within groups, and what it weighs."""
    after = (day[None, :] >= days[:, None]).astype(float)
    for name in np.unique(group):
        own = group == name
        after[:, own] -= after[:, own].mean(axis=1, keepdims=True)
    weight = (after**2).sum(axis=1)
    return after @ values / np.maximum(weight, 1e-9)[:, None], weight


def _look(
    organisation: np.ndarray, day: np.ndarray, values: Mapping[str, np.ndarray], category: str
) -> _DayEvidence | None:
    """Weigh a step of ``category`` against none; None if too few dated tires tell."""
    own = (organisation == category) & ~np.isnat(day)
    others = (organisation != category) & ~np.isnat(day)
    fewest = max(_FEWEST_TIRES, _FEWEST_SHARE * own.sum())
    days = np.unique(day[own])
    after = np.array([(day[own] >= one).sum() for one in days])
    days = days[(after >= fewest) & (own.sum() - after >= fewest)]
    if not days.size:
        return None
    odds = np.zeros(days.size)
    for part in values.values():
        step, weight = _steps(part[own], day[own], organisation[own], days)
        there, known = _steps(part[others], day[others], organisation[others], days)
        odds += np.logaddexp(0.0, _log_odds(step, there, 1.0 / weight, 1.0 / np.maximum(known, 1e-9)))
        odds -= np.log(2.0)
    return _DayEvidence(days, odds, day[own])


def _rare(
    found: Dated, day: np.ndarray, parts: Mapping[str, slice], category: str, evidence: float, share: float
) -> bool:
    """Whether at most this share of shuffles of each category's days gives as much evidence."""
    rng, most = np.random.default_rng(0), share * (_SHUFFLES + 1) - 1
    dated = np.flatnonzero(~np.isnat(day))
    groups = [dated[found.category[dated] == name] for name in np.unique(found.category)]
    for _ in range(_SHUFFLES):
        shuffled = day.copy()
        for own in groups:
            shuffled[own] = day[rng.permutation(own)]
        look = _look(found.category, shuffled, _values(found, shuffled, parts), category)
        most -= look is not None and look.evidence >= evidence
        if most < 0:
            return False
    return True


def _values(found: Dated, day: np.ndarray, parts: Mapping[str, slice]) -> dict[str, np.ndarray]:
    """Scores of each part, whitened."""
    return {name: _whitened(found.gap[:, place], found.category, day) for name, place in parts.items()}


def _log_odds(own: np.ndarray, others: np.ndarray, noise: np.ndarray, theirs: np.ndarray) -> np.ndarray:
    """Log odds, (d,), of a change of this category's alone: from steps (d, p) and their variances (d,)."""

    def density(size: np.ndarray) -> np.ndarray:
        """Mean density over step sizes and trends, logarithm, (d,)."""
        step, trend = (values.ravel() for values in np.meshgrid(size, _TRENDS))
        here, there = noise[:, None] + step + trend, theirs[:, None] + trend
        determinant = here * there - trend**2
        squares = [(a * b).sum(axis=1)[:, None] for a, b in ((own, own), (own, others), (others, others))]
        form = (there * squares[0] - 2.0 * trend * squares[1] + here * squares[2]) / determinant
        each = -0.5 * (own.shape[1] * np.log(determinant) + form)
        return np.asarray(logsumexp(each, axis=1) - np.log(step.size))

    return density(_CHANGE_SIZES) - density(np.zeros(1))


def _remove_step(
    organisation: np.ndarray,
    day: np.ndarray,
    values: Mapping[str, np.ndarray],
    category: str,
    look: _DayEvidence,
) -> None:
    """Take a change that was found out of the values, so that it does not show in the others' comparison."""
    own = (organisation == category) & ~np.isnat(day)
    for part in values.values():
        for late in (True, False):
            side = own & ((day >= look.day) == late)
            part[side] -= part[side].mean(axis=0)
