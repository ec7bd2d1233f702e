"""How large the model's own errors are: its coefficients, the formula's misfit, the answer to fast load."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.discrepancy.nuisance.columns import Sizes

Array = np.ndarray

COEFFICIENT_SHARE = 0.0005
"""How far the model may be off along each direction of its coefficients, RMS over largest force."""

SHARES = (0.002, 0.006, 0.02)
"""Sizes of the flexible form that are tried, over the largest force; the likeliest is taken."""

PATH_SHARES = (0.0005, 0.008)
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
    scales = [factor * COEFFICIENT_SHARE, share, path, path if memory is None else memory, FAST_SHARE]
    return {o: np.repeat(scales, size) for o, size in sizes.items()}
