"""Steady points whose force is unlike all its neighbours': a wrong sign, digit or row of a table.

Physics that is left out changes neighbouring points alike. One point of thirty with a wrong sign carries more
power than all the others' residuals, and gave up to three causes with 1.0 each.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tire_pipeline.channels import SLIP_AND_LOAD, TANGENTIAL_FORCES
from tire_pipeline.mismatch.model.plain_forces import forces_at
from tire_pipeline.numerics.outliers import unlike_neighbours

Array = np.ndarray


def lone_points(tire: Any, arrays: Mapping[str, Array], rows: Array) -> tuple[dict[str, Array], list[str]]:
    """Return the points that have a force whose residual stands out from those of its neighbours.

    Neighbours are near in slip, camber and load, each over its range. In 155 cases from TYDEX points, with
    all that can be missing from a model, no residual is off its neighbours' median by more than 4.1 times
    what one in ten is.

    Parameters
    ----------
    tire : TireModel
    arrays : mapping of ndarray, shape (n,)
        Channels without time, SI.
    rows : ndarray of int, shape (n,)
        Rows of the recording, for the remarks.

    Returns
    -------
    lone : dict of ndarray of int
        Force -> numbers of its points, from 0 to n - 1; only forces that have some.
    remarks : list of str
        Force, row, recorded and simulated value of each.
    """
    lone: dict[str, Array] = {}
    remarks: list[str] = []
    simulated = forces_at(tire, arrays)
    place = np.column_stack([arrays[n] for n in SLIP_AND_LOAD if n in arrays])
    for name in (n for n in TANGENTIAL_FORCES if n in arrays):
        rest = arrays[name] - simulated[name]
        found = np.flatnonzero(unlike_neighbours(rest, place))
        if found.size:
            lone[name] = found
        remarks += [
            f"{name}: {arrays[name][i]:,.0f} N in row {rows[i]} is unlike the points around it, where the "
            f"model has {simulated[name][i]:,.0f} N (left out)"
            for i in found
        ]
    return lone, remarks
