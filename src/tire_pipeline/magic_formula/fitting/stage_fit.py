"""One stage of a fit: which coefficients it frees, from where it starts, and how good it has to be."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, replace

import numpy as np

from tire_pipeline.magic_formula.fitting.least_squares.pressure import PRESSURE_SLACK, nearer
from tire_pipeline.magic_formula.fitting.least_squares.search import (
    SLACK,
    StageFit,
    are_few,
    judged,
    least,
    most_typical,
)
from tire_pipeline.magic_formula.fitting.least_squares.solve import Bounds, Problem
from tire_pipeline.magic_formula.fitting.setup.coverage import (
    ONE_PRESSURE,
    PRESSURE_WITH_LOAD,
    noise_alone,
    open_coefficients,
)
from tire_pipeline.magic_formula.fitting.setup.stage_definitions import Stage
from tire_pipeline.magic_formula.fitting.setup.starts import (
    bounds_of,
    first_values,
    starting_points,
    typical_values,
    values_of,
)
from tire_pipeline.magic_formula.fitting.setup.typical import pull
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.coefficients import INDEX
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS

_EXACT_SHARE = 1e-4
"""A misfit below this share of the largest force does not count."""
_POSITIVE_AT_EVERY_LOAD = 2.0
"""Largest PKY4 with which the cornering stiffness, a sine of PKY4 times an arc tangent of the load, is
positive at every load: rows at a single load do not determine it."""
_TYPICAL_OVER_LEAST = 1.5
"""What must be positive and the recording's ranges cannot determine is at least its typical value over this:
with PKY2 below 1 the cornering stiffness would fall with load."""


@dataclass(frozen=True)
class Options:
    """How to fit.

    Parameters
    ----------
    starts : int
    loss : str
    from_start : bool
        Whether the model holds the values of a tire that the fit starts from.
    rng : Generator
    together : bool
        Whether the stages of an output are fitted at once in the end.
    """

    starts: int
    loss: str
    from_start: bool
    rng: np.random.Generator
    together: bool


@dataclass(frozen=True)
class Outcome:
    """What a stage found.

    Parameters
    ----------
    values : mapping of str to float
        Of the coefficients that were fitted.
    fit : StageFit
    kept : mapping of str to mapping of str to float
        Reason -> coefficients that keep a value, and the value.
    released : mapping of str to list of str
        Reason -> coefficients that the recording's ranges cannot determine, but that the rows need.
    problem, bounds : Problem, pair of ndarray
        What was solved.
    without_pressure : float
        RMS that would be left with typical coefficients of pressure, over the least, minus one: of pressures
        that cannot determine them. 0 if they were not needed.
    """

    values: Mapping[str, float]
    fit: StageFit
    kept: Mapping[str, Mapping[str, float]]
    released: Mapping[str, Sequence[str]]
    problem: Problem
    bounds: Bounds
    without_pressure: float = 0.0


@dataclass(frozen=True)
class _StageSearch:
    """Where a search over some coefficients ended, and the RMS of the residuals that is left there."""

    problem: Problem
    bounds: Bounds
    values: np.ndarray
    left: float


@dataclass(frozen=True)
class _StageProblem:
    """A stage's problem over some of its coefficients, and where its searches start."""

    stage: Stage
    names: Sequence[str]
    model: TireModel
    rows: list[np.ndarray]
    measured: np.ndarray
    typical: Mapping[str, float]
    first: Mapping[str, float]
    known: Set[str]
    seeds: Sequence[TireModel]
    rng: np.random.Generator

    def problem(self, free: Sequence[str]) -> tuple[Problem, Bounds]:
        """Return the problem over these; the other coefficients keep typical values."""
        vector = self.model.packed.copy()
        for name in self.names:
            vector[INDEX[name]] = self.typical[name]
        low, high = bounds_of(list(free), self.first)
        drawn = pull(free, self.typical, (low, high))
        unseen = np.isin(free, sorted(self.known)) & (low > 0.0)
        low = np.where(unseen, np.maximum(low, np.minimum(drawn.centre / _TYPICAL_OVER_LEAST, high)), low)
        untold = np.isin(free, sorted(self.known & {"PKY4"}))
        bounds = low, np.where(untold, np.maximum(drawn.centre, _POSITIVE_AT_EVERY_LOAD), high)
        family, output = self.model.family, self.stage.output
        return Problem(vector, family, output, free, self.rows, self.measured, drawn), bounds

    def starts(self, problem: Problem, bounds: Bounds, number: int) -> list[np.ndarray]:
        """Return where searches start: a number of random points, and the seeds."""
        begin = np.array([self.first[n] for n in problem.names])
        drawn = starting_points(begin, bounds, problem.pull.spread, number, self.rng)
        return [*drawn, *self.simpler(problem, bounds)]

    def simpler(self, problem: Problem, bounds: Bounds) -> list[np.ndarray]:
        """Return the values that the seeds have."""
        return values_of(self.seeds, {n: self.typical[n] for n in problem.names}, bounds)

    def search(self, free: Sequence[str], number: int, begin: Sequence[np.ndarray] = ()) -> _StageSearch:
        """Search over these from random starts, the seeds, and others."""
        problem, bounds = self.problem(free)
        values = least(problem, bounds, [*begin, *self.starts(problem, bounds, number)])
        return _StageSearch(problem, bounds, values, problem.misfit(values))

    def wider_search(self, found: _StageSearch, free: Sequence[str], number: int) -> _StageSearch:
        """Search over more coefficients, from where another search ended, too."""
        ended = dict(zip(found.problem.names, found.values, strict=True))
        return self.search(free, number, [np.array([ended.get(n, self.typical[n]) for n in free])])


def _typical_and_first(
    stage: Stage,
    names: Sequence[str],
    model: TireModel,
    here: Mapping[str, np.ndarray],
    measured: np.ndarray,
    from_start: bool,
) -> tuple[dict[str, float], dict[str, float]]:
    """Values that a tire has if the points say nothing, and those that they suggest."""
    typical = typical_values(list(names), model, from_start)
    first = dict(typical) if from_start else first_values(stage, typical, here, measured)
    typical.update({n: first[n] for n in ("PKY1", "PKX1", "QDZ1") if n in first})
    for name in ("PDY1", "PDX1"):
        if name in typical:
            typical[name] = max(typical[name], first[name])
    return typical, first


def fit_stage(
    stage: Stage,
    names: Sequence[str],
    model: TireModel,
    here: Mapping[str, np.ndarray],
    measured: np.ndarray,
    ranges: Mapping[str, np.ndarray],
    options: Options,
    seeds: Sequence[TireModel] = (),
    bar: float = np.inf,
) -> Outcome:
    """Fit a stage.

    Levels are always free. Coefficients of load, camber, pressure or the slip's sign are free if the
    recording's ranges can determine them. Otherwise they keep typical values, and are freed only if the rows
    cannot be fitted without them.

    Parameters
    ----------
    stage : Stage
    names : sequence of str
        Its coefficients.
    model : TireModel
        Everything that is known before.
    here, measured : mapping of ndarray, ndarray
        The stage's points.
    ranges : mapping of ndarray
        Points that show what the recording can determine.
    options : Options
    seeds : sequence of TireModel
        More models to start from.
    bar : float
        RMS that the fit should not leave, of a simpler formula.

    Returns
    -------
    Outcome
    """
    closed = open_coefficients(tuple(names), ranges, model.value("FNOMIN"))
    typical, first = _typical_and_first(stage, names, model, here, measured, options.from_start)
    silent = noise_alone(tuple(names), ranges, model.value("FNOMIN"))
    known = {n for group in closed.values() for n in group}
    rows = [np.ascontiguousarray(here[name]) for name in POINT_CHANNELS]
    setup = _StageProblem(stage, names, model, rows, measured, typical, first, known, seeds, options.rng)
    found = setup.search([name for name in names if name not in known], options.starts)
    lowest = found.left
    exact = _EXACT_SHARE * float(np.abs(measured).max())
    released: dict[str, list[str]] = {}
    by_pressure = [n for why in (ONE_PRESSURE, PRESSURE_WITH_LOAD) for n in closed.get(why, ())]
    ripple, without_pressure = set(by_pressure) - silent, 0.0
    for later, slack in ((ripple, 0.5 * SLACK), (set[str](), SLACK))[: 2 if ripple else 1]:
        every = [name for name in names if name not in silent | later]
        if set(every) <= set(found.problem.names) or found.left <= exact or are_few(found.problem):
            continue
        wider = setup.wider_search(found, every, -(-options.starts // 4))
        lowest = min(lowest, wider.left)
        if found.left > (1.0 + slack) * lowest or found.left > bar:
            released = {reason: [n for n in group if n in every] for reason, group in closed.items()}
            without_pressure = found.left / lowest - 1.0
            found = replace(wider, left=lowest)
    problem, bounds, free = found.problem, found.bounds, list(found.problem.names)
    most = max(min((1.0 + SLACK) * lowest, bar), found.left, exact)
    held = np.isin(free, sorted(known))
    simpler = setup.simpler(problem, bounds) if by_pressure else []  # the richer one knows no more
    values = most_typical(problem, bounds, found.values, options.loss, most, held, simpler)
    pressure = np.isin(free, by_pressure)
    if pressure.any() and not are_few(problem):
        most = max(min((1.0 + PRESSURE_SLACK) * lowest, bar), found.left, exact)
        values = nearer(problem, bounds, values, options.loss, most, pressure)
    kept = {
        reason: {n: typical[n] for n in group if n not in free}
        for reason, group in closed.items()
        if any(n not in free for n in group)
    }
    found_values = dict(zip(free, values.tolist(), strict=True))
    return Outcome(
        found_values,
        judged(problem, bounds, values, options.loss),
        kept,
        {reason: group for reason, group in released.items() if group},
        problem,
        bounds,
        without_pressure if pressure.any() else 0.0,
    )
