"""Loads that only a model car's tire carries, and what says that they are in another unit."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from tire_pipeline.channels import LARGEST_LOAD_OF_MODEL_CARS

_LARGEST_RADIUS_OF_MODEL_CARS = 0.1
"""In m: wheels at a scale of 1:5 have 0.06 to 0.09."""
_METRES = {"mm": 1e-3, "m": 1.0, "cm": 1e-2, "inch": 0.0254}


def in_another_unit_as(recording: pd.DataFrame, load: float, radius: float = np.nan) -> list[str]:
    """Return what says that a load is not in newtons, though a model car could have it.

    A model car's tires are small, and are not inflated; and its load is in newtons only if somebody says so.

    Parameters
    ----------
    recording : DataFrame
        ``attrs["file_units"]`` holds the units that the file or the user stated, by channel.
    load : float
        Its size as it was read, N.
    radius : float
        The unloaded radius (m), if it is known.

    Returns
    -------
    list of str
        Empty for any larger load, and where nothing tells.

    Examples
    --------
    >>> run = pd.DataFrame({"normal_load": [4.0, 5.0], "pressure": 2.2e5})
    >>> in_another_unit_as(run, 5.0)
    ['a pressure was recorded']
    >>> in_another_unit_as(run.drop(columns="pressure"), 5.0)
    []
    """
    if not 0.0 < load < LARGEST_LOAD_OF_MODEL_CARS:
        return []
    found = []
    if _median(recording, "pressure") > 0.0:
        found.append("a pressure was recorded")
    known = (radius, _median(recording, "loaded_radius"), radius_of_file(recording))
    large = [x for x in known if x > _LARGEST_RADIUS_OF_MODEL_CARS]
    if large:
        found.append(f"the wheel has a radius of {large[0]:.3g} m")
    units = recording.attrs.get("file_units", {})
    if "normal_load" in units and not units["normal_load"]:
        found.append("no unit of the load is stated")
    return found


def _median(recording: pd.DataFrame, column: str) -> float:
    """Return the median of a column; NaN where it is missing or holds no number."""
    if column not in recording:
        return float("nan")
    values = pd.to_numeric(recording[column], errors="coerce").to_numpy(dtype=float)
    values = values[np.isfinite(values)]
    return float(np.median(values)) if values.size else float("nan")


def radius_of_file(recording: pd.DataFrame) -> float:
    """Return half of the outer diameter that a TYDEX file states, m; NaN if it states none.

    Parameters
    ----------
    recording : DataFrame
        ``attrs["constants"]`` holds what the file states.
    """
    constants = recording.attrs.get("constants", {})
    entry = constants.get("OVALLDIA") if isinstance(constants, Mapping) else None
    if not isinstance(entry, Mapping) or not isinstance(entry.get("value"), int | float):
        return float("nan")
    return 0.5 * float(entry["value"]) * _METRES.get(str(entry.get("unit")), float("nan"))
