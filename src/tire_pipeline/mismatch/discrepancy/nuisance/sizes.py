"""Sizes of the model's own errors: coefficients, the formula's misfit, the response to fast load."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.discrepancy.nuisance.columns import Sizes

Array = np.ndarray

COEFFICIENT_SHARE = 0.0005
"""How far the model may be off along each direction of its coefficients, RMS over largest force."""

COEFFICIENT_PART = 0.05
"""The same as a part of the flexible form's size: a worse fit is also worse along its coefficients."""
COEFFICIENT_MOST = 0.0009
"""The same at most, over the largest force: a fit is what leaves little along its coefficients."""

SHARES = (0.001, 0.002, 0.004, 0.006, 0.009, 0.013, 0.018, 0.025, 0.035, 0.05)
"""Sizes of the flexible form that are tried, over the largest force; the likeliest is taken."""

PATH_SHARES = (0.0002, 0.002, 0.005, 0.01, 0.02, 0.04)
"""Sizes of what a rising slip leaves otherwise than a falling one, over the largest force; the likeliest is
taken. Simulated tires leave next to nothing of it, the real ones of a flat-belt rig about 2%."""

FAST_SHARE = 1.0
"""How far the answer to load that changes faster than half a second is known: from nothing to twice the
steady force, and as much a quarter of a period late, where the relaxation length is of the order of the
wavelength."""


def nuisance_scale(
    sizes: dict[str, Sizes], share: float, path: float, factor: float = 1.0, memory: float | None = None
) -> dict[str, Array]:
    """Prior standard deviations of the nuisance columns for a size of the flexible form.

    Parameters
    ----------
    sizes : dict
        For each output the numbers of columns.
    share : float
        Size of the flexible form, over the largest force.
    path : float
        Size of its dependence on the way to a point, over the largest force.
    factor : float
        On what the coefficients may move.
    memory : float, optional
        How far friction may follow the power of the last seconds; as far as ``path`` if left out.
    """
    part = min(COEFFICIENT_PART * share, COEFFICIENT_MOST)
    move = factor * max(COEFFICIENT_SHARE, part)
    scales = [move, share, path, path if memory is None else memory, FAST_SHARE]
    return {o: np.repeat(scales, size) for o, size in sizes.items()}
