"""Another simulator's output in place of a tire model: a Magic Formula that stands in for it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.channels import SLIP_AND_LOAD, TANGENTIAL_FORCES
from tire_pipeline.errors import RecordingError
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.mismatch.model.forces import plain_forces

Array = np.ndarray
_MOST_FITTED = 4000


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
            todo="give the tire model, or the other simulator's output",
        )
    inputs = {n: arrays[n] for n in SLIP_AND_LOAD if n in arrays}
    step = max(1, arrays["normal_load"].size // _MOST_FITTED)
    frame = pd.DataFrame({n: a[::step] for n, a in inputs.items()})
    for f in forces:
        frame[f] = arrays[f"simulated_{f}"][::step]
    load = float(np.median(inputs["normal_load"]))
    tire = fit_magic_formula(frame.dropna(), start=_start(frame, load)).model
    zero = np.zeros(arrays["normal_load"].size)
    here = {n: inputs.get(n, zero) for n in SLIP_AND_LOAD}
    own = plain_forces(tire, **here)
    return tire, {f: arrays[f"simulated_{f}"] - own[f] for f in forces}


def _start(frame: pd.DataFrame, load: float) -> TireModel:
    """Typical coefficients, lateral stiffness with the sign that the data have."""
    sign = 1.0
    if "fy" in frame and "slip_angle" in frame:
        sign = 1.0 if float((frame["slip_angle"] * frame["fy"]).sum()) >= 0.0 else -1.0
    typical = {
        "FNOMIN": load,
        "UNLOADED_RADIUS": ASSUMED_RADIUS,
        "PCX1": 1.5,
        "PDX1": 1.0,
        "PKX1": 20.0,
        "PCY1": 1.3,
        "PDY1": 1.0,
        "PEY1": -0.5,
        "PKY1": 15.0 * sign,
        "PKY2": 1.8,
        "RBX1": 10.0,
        "RBX2": 10.0,
        "RCX1": 1.0,
        "RBY1": 10.0,
        "RBY2": 10.0,
        "RCY1": 1.0,
    }
    return TireModel.from_coefficients(typical, version="5.2")
