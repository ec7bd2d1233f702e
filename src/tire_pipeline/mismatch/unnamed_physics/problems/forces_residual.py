"""The residual of the forces, weighed by the engine's noise and misfit, or coarsely."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np

from tire_pipeline.mismatch.discrepancy.gram import System
from tire_pipeline.mismatch.discrepancy.nuisance.sizes import nuisance_scale
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.inference.evidence.likelihood import MISFITS, PATHS
from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.unnamed_physics.language.symbols import table_of
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import Unexplained

Array = np.ndarray

USUAL_MISFIT = 0.01
"""What a formula fitted to a clean tire leaves at most, RMS over largest force: the tuning tires 0.4 to 0.9%,
calspan 2%, DART 3%."""
_A_SWEEP = 8.0
"""Independent values of the formula's misfit along one sweep, about: it bends as the slip does."""


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
    return Unexplained(
        table=table,
        nominal=nominal,
        moves=what_moves(data),
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
        inflation=along_sweeps(problem.block),
        settled=True,
    )


def _beside_effects(analysis: Analysis) -> tuple[System, dict[str, Array]]:
    """The system with the effects' columns as far as their parameters are uncertain, and those sizes."""
    fit, outputs = analysis.fit, analysis.data.outputs
    if not fit.labels:
        return analysis.system, {o: np.zeros(0) for o in outputs}
    errors = fit.errors
    known = {o: errors for o in outputs}
    return analysis.system.extended({o: fit.columns[o] for o in outputs}, known), known


def what_moves(data: Data) -> frozenset[str]:
    """Return the channels that vary, ``time`` if there is a time line, and ``way`` if it is known."""
    moves = {n for n in data.present if data.varies(n)}
    if data.time is not None:
        moves |= {"time", "way"} if "speed" in data.present else {"time"}
    return frozenset(moves)


def along_sweeps(block: Array) -> float:
    """Return how many samples make one independent value of a formula's misfit.

    Parameters
    ----------
    block : ndarray of int, shape (n,)
        Sweep of each sample.
    """
    return max(block.size / (_A_SWEEP * (int(block.max()) + 1)), 1.0)
