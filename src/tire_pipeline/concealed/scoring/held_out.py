"""Errors of a corrected model on the held-out run, for the scorer."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd

from tire_pipeline.concealed.brush_rig.recorded_run import RIG_FORCES
from tire_pipeline.concealed.cases.clean_run import model_forces, rms
from tire_pipeline.concealed.cases.make import Case


def held_out_errors(
    case: Case, predict: Callable[[pd.DataFrame], pd.DataFrame]
) -> dict[str, dict[str, float]]:
    """RMS error on the held-out run before and after the correction, of the forces that were recorded.

    Parameters
    ----------
    case : Case
    predict : callable
        Held-out inputs (no forces) -> DataFrame with ``fx`` and ``fy``, N; as
        ``report.corrected.predict``. A force that it lacks counts as uncorrected.

    Returns
    -------
    dict
        Output -> ``rms_before``, ``rms_after``, N.
    """
    recorded = [force for force in RIG_FORCES if force in case.held_out]
    inputs = case.held_out.drop(columns=recorded)
    before = model_forces(case.tire, inputs)
    after = predict(inputs)
    out = {}
    for force in recorded:
        i = RIG_FORCES.index(force)
        measured = case.held_out[force].to_numpy()
        guess = after[force].to_numpy() if force in after else before[:, i]
        out[force] = {
            "rms_before": rms(measured - before[:, i]),
            "rms_after": rms(measured - guess),
        }
    return out
