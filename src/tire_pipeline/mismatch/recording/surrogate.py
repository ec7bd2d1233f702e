"""Another simulator's output in place of a tire model: a Magic Formula that stands in for it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import SLIP_AND_LOAD, TANGENTIAL_FORCES
from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch.model.channels import ENOUGH_ROWS
from tire_pipeline.mismatch.model.plain_forces import plain_forces

Array = np.ndarray


def stand_in(arrays: Mapping[str, Array]) -> tuple[Any, dict[str, Array]]:
    """Fit a tire model to ``simulated_fx`` and ``simulated_fy``.

    Parameters
    ----------
    arrays : mapping of ndarray, shape (n,)
        Channels, SI.

    Returns
    -------
    tire : TireModel
    beside : dict of ndarray, shape (n,)
        Simulated force less the tire model's, N: added to whatever the tire model gives.

    Raises
    ------
    RecordingError
        If there is neither a tire model nor a simulated force.
    """
    from tire_pipeline.magic_formula import fit_magic_formula  # slow to import, and few recordings need it

    forces = [f for f in TANGENTIAL_FORCES if f"simulated_{f}" in arrays]
    if not forces:
        raise RecordingError(
            "there is neither a tire model nor a column simulated_fy or simulated_fx",
            todo="pass the tire model, or the other simulator's output",
        )
    inputs = {n: arrays[n] for n in SLIP_AND_LOAD if n in arrays}
    step = max(1, arrays["normal_load"].size // ENOUGH_ROWS)
    frame = pd.DataFrame({n: a[::step] for n, a in inputs.items()})
    for f in forces:
        frame[f] = arrays[f"simulated_{f}"][::step]
    tire = fit_magic_formula(frame.dropna()).model
    zero = np.zeros(arrays["normal_load"].size)
    here = {n: inputs.get(n, zero) for n in SLIP_AND_LOAD}
    own = plain_forces(tire, **here)
    return tire, {f: arrays[f"simulated_{f}"] - own[f] for f in forces}
