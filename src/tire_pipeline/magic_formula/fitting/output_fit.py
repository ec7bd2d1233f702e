"""All stages of an output together, where one after the other they leave too large a residual."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from tire_pipeline.magic_formula.fitting.least_squares.search import (
    SLACK,
    are_few,
    judged,
    least,
    most_typical,
    part_of,
)
from tire_pipeline.magic_formula.fitting.least_squares.solve import Bounds, Problem
from tire_pipeline.magic_formula.fitting.setup.coverage import noise_alone, open_coefficients
from tire_pipeline.magic_formula.fitting.setup.starts import bounds_of, starting_points, values_of
from tire_pipeline.magic_formula.fitting.setup.typical import Pull, pull
from tire_pipeline.magic_formula.fitting.stage_fit import Options, Outcome
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.magic_formula.parameters.points import POINT_CHANNELS

_STARTS = 12
"""At most; the fit of the stages is the first."""


def fit_together(
    outcomes: Sequence[Outcome],
    model: TireModel,
    points: Mapping[str, np.ndarray],
    measured: np.ndarray,
    options: Options,
    seeds: Sequence[TireModel] = (),
    bar: float = np.inf,
) -> list[Outcome]:
    """Fit all points of an output at once if its stages leave a clearly larger residual.

    A stage at combined slip takes the one at pure slip as it is, and cannot correct its residual.

    Parameters
    ----------
    outcomes : sequence of Outcome
        Of the output's stages.
    model : TireModel
        With these.
    points, measured : mapping of ndarray, ndarray
        All of the output's.
    options : Options
    seeds : sequence of TireModel
        More models to start from.
    bar : float
        RMS that the fit should not leave, of a simpler formula.

    Returns
    -------
    list of Outcome
        As they came, or with other values.
    """
    before, outcomes = list(outcomes), [_widened(outcome, model, points) for outcome in outcomes]
    problem, bounds = _problem(outcomes, model, points, measured)
    if are_few(problem):
        return before
    staged = np.concatenate([list(outcome.values.values()) for outcome in outcomes])
    starts = starting_points(staged, bounds, problem.pull.spread, min(_STARTS, options.starts), options.rng)
    best = least(problem, bounds, [*starts, *values_of(seeds, _typical(problem), bounds)])
    lowest, left = problem.misfit(best), problem.misfit(staged)
    wider = [_released(outcome, model, points) for outcome in outcomes]
    more, limits = _problem(wider, model, points, measured)
    if len(more.names) > len(problem.names) and not are_few(more):
        typical, ended = _typical(more), dict(zip(problem.names, best, strict=True))
        begin = np.array([ended.get(n, typical[n]) for n in more.names])
        drawn = starting_points(begin, limits, more.pull.spread, len(starts), options.rng)
        freest = least(more, limits, [*drawn, *values_of(seeds, typical, limits)])
        if lowest > min((1.0 + SLACK) * more.misfit(freest), bar):
            outcomes, problem, bounds, best = wider, more, limits, freest
            lowest, left = problem.misfit(best), np.inf
    if left <= min((1.0 + 0.5 * SLACK) * lowest, bar):
        return before
    most = max(min((1.0 + SLACK) * lowest, bar), lowest)
    held = np.isin(problem.names, [n for o in outcomes for group in o.released.values() for n in group])
    values = most_typical(problem, bounds, best, options.loss, most, held)
    whole = judged(problem, bounds, values, options.loss)
    found = dict(zip(problem.names, values.tolist(), strict=True))
    return [
        replace(o, values={n: found[n] for n in o.values}, fit=part_of(whole, problem.names, list(o.values)))
        for o in outcomes
    ]


def _typical(problem: Problem) -> dict[str, float]:
    return dict(zip(problem.names, problem.pull.centre, strict=True))


def _kept(outcome: Outcome) -> dict[str, float]:
    """Return the values of what a stage kept, whatever the reason."""
    return {name: value for group in outcome.kept.values() for name, value in group.items()}


def _widened(outcome: Outcome, model: TireModel, points: Mapping[str, np.ndarray]) -> Outcome:
    """Return a stage that also frees what only all points together determine, such as pressure."""
    kept = _kept(outcome)
    closed = open_coefficients(tuple(kept), points, model.value("FNOMIN"))
    more = {n: v for n, v in kept.items() if not any(n in group for group in closed.values())}
    return _freed(outcome, more)


def _released(outcome: Outcome, model: TireModel, points: Mapping[str, np.ndarray]) -> Outcome:
    """Return a stage that also frees what the ranges cannot determine, but the rows may need."""
    kept = _kept(outcome)
    silent = noise_alone(tuple(kept), points, model.value("FNOMIN"))
    more = {n: v for n, v in kept.items() if n not in silent}
    released = {reason: [n for n in group if n in more] for reason, group in outcome.kept.items()}
    freed = _freed(outcome, more)
    return replace(freed, released={**outcome.released, **{r: ns for r, ns in released.items() if ns}})


def _freed(outcome: Outcome, more: Mapping[str, float]) -> Outcome:
    """Return a stage that also frees some of the coefficients that it kept, from these values on."""
    if not more:
        return outcome
    low, high = bounds_of(list(more), more)
    own, drawn = outcome.problem, pull(list(more), more, (low, high))
    return replace(
        outcome,
        values={**outcome.values, **more},
        kept={
            reason: {n: v for n, v in group.items() if n not in more}
            for reason, group in outcome.kept.items()
            if not set(group) <= set(more)
        },
        problem=replace(own, names=[*own.names, *more], pull=_joined([own.pull, drawn])),
        bounds=(np.append(outcome.bounds[0], low), np.append(outcome.bounds[1], high)),
    )


def _joined(pulls: Sequence[Pull]) -> Pull:
    """Return one pull on the coefficients of several."""
    return Pull(*(np.concatenate([getattr(p, n) for p in pulls]) for n in ("centre", "spread", "strength")))


def _problem(
    outcomes: Sequence[Outcome],
    model: TireModel,
    points: Mapping[str, np.ndarray],
    measured: np.ndarray,
) -> tuple[Problem, Bounds]:
    """Return the problem over all coefficients of the stages at all points."""
    parts = [outcome.problem for outcome in outcomes]
    drawn = _joined([part.pull for part in parts])
    low, high = (np.concatenate([outcome.bounds[side] for outcome in outcomes]) for side in (0, 1))
    names = [name for part in parts for name in part.names]
    rows = [np.ascontiguousarray(points[name]) for name in POINT_CHANNELS]
    problem = Problem(model.packed.copy(), model.family, parts[0].output, names, rows, measured, drawn)
    return problem, (low, high)
