"""The slip ratio of a file that has none, but the wheel's speed, the road's and the effective radius."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tire_pipeline.recordings.conventions.plausible import plausible, size

_SPEEDS_AND_RADIUS = ("wheel_speed", "effective_radius", "speed")


def slip_from_speeds(frame: pd.DataFrame, notes: list[str]) -> pd.DataFrame:
    """Return a recording with the slip ratio that its speeds and the effective radius give.

    Parameters
    ----------
    frame : DataFrame
        Canonical columns, SI.
    notes : list of str
        What was done is added.

    Returns
    -------
    DataFrame
        The same object where there is a slip ratio, or where these channels give none that a wheel has.

    Examples
    --------
    >>> turns = [99.0, 100.0, 80.0]
    >>> frame = pd.DataFrame({"speed": 30.0, "wheel_speed": turns, "effective_radius": 0.3})
    >>> slip_from_speeds(frame, [])["slip_ratio"].round(3).tolist()
    [-0.01, 0.0, -0.2]
    """
    if "slip_ratio" in frame or not set(_SPEEDS_AND_RADIUS) <= set(frame):
        return frame
    turns, radius, road = (np.abs(frame[name].to_numpy(dtype=float)) for name in _SPEEDS_AND_RADIUS)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        slip = turns * radius / road - 1.0
    slip = np.where(np.isfinite(slip), slip, np.nan)
    if not plausible("effective_radius", size(radius)) or not plausible("slip_ratio", size(slip)):
        return frame
    notes.append("slip_ratio: not in the file; computed as wheel_speed x effective_radius / speed - 1")
    at = int(frame.columns.get_loc("slip_angle")) + 1 if "slip_angle" in frame else 0
    frame.insert(at, "slip_ratio", slip)
    return frame
