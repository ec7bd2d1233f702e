"""The search's input: the residual, and the likelihood in which it was weighed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.discrepancy.nuisance.sizes import nuisance_scale
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.evidence.likelihood import MISFITS, PATHS
from tire_pipeline.mismatch.model.channels import least_spread
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.unnamed_physics.language.grammar import SymbolTable
from tire_pipeline.mismatch.unnamed_physics.language.symbols import CHANNEL, NominalValues, table_of

Array = np.ndarray
Outputs = Mapping[str, Array]


PRIOR_SIZE = 0.05
"""Standard deviation of what a term does, root mean square over the largest force."""
USUAL_MISFIT = 0.01
"""What a formula fitted to a clean tire leaves at most, RMS over largest force: the tuning tires 0.4 to 0.9%,
calspan 2%, DART 3%."""
_HELD_CHANNELS = "gLvp"
"""Symbols of the channels that a schedule holds while it sweeps a slip."""
_A_SWEEP = 8.0
"""Independent values of the formula's misfit along one sweep, about: it bends as the slip does."""


@dataclass(frozen=True)
class Unexplained:
    """The unexplained residual and how it is weighed: the only input of the search for unnamed physics.

    Parameters
    ----------
    table : SymbolTable
        Symbols that an equation may use.
    nominal : NominalValues
    moves : frozenset of str
        Channels that vary, ``time`` if there is a time line, and ``way`` if with it the way rolled is known.
    rest : mapping of ndarray, shape (n,)
        Output -> recorded force without what the model and the named effects give, N.
    largest : mapping of float
        Output -> largest force, N.
    block : ndarray of int, shape (n,)
        Sweep of each sample.
    order : ndarray of int, shape (n,)
        Rows in the order in which ``whiten`` returns them.
    whiten : callable
        Output, columns (n, k) in N -> the same with unit white noise, in ``order``.
    nuisance : mapping of ndarray, shape (n, q)
        Columns of what may be wrong without anything being left out, whitened, in ``order``.
    sizes : sequence of mapping of ndarray, shape (q,)
        Prior standard deviations of their coefficients: alternatives, the engine's own first.
    inflation : float
        Whitened samples that make one independent one.
    settled : bool
        Whether that number stands; else it is learnt beside the best terms.
    together : ndarray of int, shape (n,), optional
        Samples of one number are held out together; sweeps if left out.
    """

    table: SymbolTable
    nominal: NominalValues
    moves: frozenset[str]
    rest: Outputs
    largest: Mapping[str, float]
    block: Array
    order: Array
    whiten: Callable[[str, Array], Array]
    nuisance: Outputs
    sizes: Sequence[Outputs]
    inflation: float
    settled: bool = False
    together: Array | None = None

    @property
    def outputs(self) -> tuple[str, ...]:
        """Forces that were recorded."""
        return tuple(self.rest)


def problem_of(analysis: Analysis) -> Unexplained:
    """Return what the search leaves; the parameters of its effects may move by what they are known to."""
    data, fit = analysis.data, analysis.fit
    system, known = _beside_effects(analysis)
    order = np.argsort(analysis.block, kind="stable")
    sizes = [system.scale]
    for share, path in product(MISFITS, PATHS):  # unnamed physics must not be absorbed as misfit
        scale = nuisance_scale(analysis.sizes, share, path)
        sizes.append({o: np.concatenate([s, known[o]]) for o, s in scale.items()})
    table, nominal = table_of(data, fit.changes)
    moves = {n for n in data.present if data.varies(n)}
    if data.time is not None:
        moves |= {"time", "way"} if "speed" in data.present else {"time"}
    return Unexplained(
        table=table,
        nominal=nominal,
        moves=frozenset(moves),
        rest=residual(data, fit.changes),
        largest=analysis.largest,
        block=analysis.block,
        order=order,
        whiten=lambda o, x: analysis.noise[o].whiten(x, data.start)[order],
        nuisance=system.white,
        sizes=sizes,
        inflation=analysis.inflation,
    )


def coarsely(problem: Unexplained, analysis: Analysis) -> Unexplained:
    """Return the same with the formula's misfit as noise of its usual size, that changes along a sweep.

    The engine's misfit is a flexible form whose size the recording sets. Where fine structure asks for a
    large one, it takes up what a term would do. Here a misfit has ``USUAL_MISFIT`` of the largest force, a
    sweep holds a few independent values of it, and only the coefficients may move: what is large in newtons
    comes first.
    """
    usual = {o: USUAL_MISFIT * problem.largest[o] for o in problem.rest}
    size = {o: np.hypot(usual[o], analysis.noise[o].floor) for o in usual}
    count = {o: analysis.sizes[o].coefficients for o in usual}
    columns = {o: analysis.columns[o][problem.order, : count[o]] / size[o] for o in usual}
    return replace(
        problem,
        whiten=lambda o, x: x[problem.order] / size[o],
        nuisance=columns,
        sizes=[{o: s[: count[o]] for o, s in problem.sizes[0].items()}],
        inflation=max(problem.table.size / (_A_SWEEP * (int(problem.block.max()) + 1)), 1.0),
        settled=True,
    )


def by_condition(problem: Unexplained) -> Unexplained:
    """Return the same with whole operating conditions held out: all sweeps at one load, speed, camber ...

    What fits the sweeps of one condition also predicts its other sweeps, whatever it depends on. Only at a
    condition that was not seen does a false driver show. Where there is one condition only, sweeps are held
    out.
    """
    count = int(problem.block.max()) + 1
    level = np.zeros((count, len(_HELD_CHANNELS)))
    for j, symbol in enumerate(_HELD_CHANNELS):
        if CHANNEL[symbol] in problem.moves:
            x = problem.table.columns[symbol] / least_spread(CHANNEL[symbol], problem.table.columns[symbol])
            level[:, j] = [np.median(x[problem.block == b]) for b in range(count)]
    first: list[int] = []
    condition = np.zeros(count, int)
    for b in range(count):
        near = [k for k, a in enumerate(first) if np.max(np.abs(level[b] - level[a])) < 1.0]
        condition[b] = near[0] if near else len(first)
        first += [] if near else [b]
    return replace(problem, together=condition[problem.block]) if len(first) > 1 else problem


def of_force(problem: Unexplained, output: str) -> Unexplained:
    """Return the same of one force alone."""
    return replace(
        problem,
        rest={output: problem.rest[output]},
        nuisance={output: problem.nuisance[output]},
        sizes=[{output: size[output]} for size in problem.sizes],
    )


def _beside_effects(analysis: Analysis) -> tuple[System, dict[str, Array]]:
    """The system with the effects' columns as far as their parameters are uncertain, and those sizes."""
    fit, outputs = analysis.fit, analysis.data.outputs
    if not fit.labels:
        return analysis.system, {o: np.zeros(0) for o in outputs}
    errors = fit.errors
    known = {o: errors for o in outputs}
    return analysis.system.extended({o: fit.columns[o] for o in outputs}, known), known
