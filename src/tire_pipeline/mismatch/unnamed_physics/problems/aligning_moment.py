"""The residual of the aligning moment, weighed coarsely: no effect of the catalogue acts on it alone."""

from __future__ import annotations

import numpy as np

from tire_pipeline.channels import ALIGNING_MOMENT, SLIP_AND_LOAD
from tire_pipeline.mismatch.discrepancy.nuisance.coefficients import directions
from tire_pipeline.mismatch.discrepancy.nuisance.sizes import COEFFICIENT_PART
from tire_pipeline.mismatch.inference.analysis import Analysis
from tire_pipeline.mismatch.model.channels import largest, white_noise
from tire_pipeline.mismatch.model.forces import Change, simulate_moments
from tire_pipeline.mismatch.model.residual import rms
from tire_pipeline.mismatch.unnamed_physics.language.symbols import table_of
from tire_pipeline.mismatch.unnamed_physics.problems.forces_residual import along_sweeps, what_moves
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import Unexplained

Array = np.ndarray

USUAL_MISFIT_OF_MOMENT = 0.03
"""What a fitted formula leaves of the aligning moment, RMS over the largest: tydex 1%, calspan 6 to 7%."""


def problem_of_moment(
    analysis: Analysis, changes: tuple[Change, ...], *, as_filed: bool
) -> Unexplained | None:
    """Return the residual of the aligning moment, or None where noise and misfit are usually as large.

    The misfit counts as noise that changes along a sweep, as for the forces where they are weighed coarsely,
    and the moment's own coefficients may be off by the same part of it. The noise is that of neighbouring
    samples, and has to be left as much again.

    Parameters
    ----------
    analysis : Analysis
        Of a recording with the moment.
    changes : tuple of (name, parameters)
        Effects in the corrected model.
    as_filed : bool
        Whether they leave the moment as it was.
    """
    data, name = analysis.data, ALIGNING_MOMENT
    table, nominal = table_of(data, changes, moments=(name,))
    rest = data.channels[name] - simulate_moments(data, () if as_filed else changes, (name,))[name]
    size = largest(table.columns[name])
    noise = white_noise(rest) if data.time is not None else 0.0
    if rms(rest) <= max(USUAL_MISFIT_OF_MOMENT * size, np.sqrt(2.0) * noise):
        return None
    order = np.argsort(analysis.block, kind="stable")
    error = float(np.hypot(USUAL_MISFIT_OF_MOMENT * size, noise))
    columns = directions(data, name, {n: data.get(n) for n in SLIP_AND_LOAD}) * size
    move = COEFFICIENT_PART * USUAL_MISFIT_OF_MOMENT
    return Unexplained(
        table=table,
        nominal=nominal,
        moves=what_moves(data),
        rest={name: rest},
        largest={name: size},
        block=analysis.block,
        order=order,
        whiten=lambda _, x: x[order] / error,
        nuisance={name: columns[order] / error},
        sizes=[{name: np.full(columns.shape[1], move)}],
        inflation=along_sweeps(analysis.block),
        settled=True,
    )
