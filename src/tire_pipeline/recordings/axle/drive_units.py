"""A drive's channels in SI: a file that was read keeps the units of those that no tire has."""

from __future__ import annotations

import pandas as pd

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings.conventions.drive_columns import DRIVE_CHANNELS
from tire_pipeline.recordings.conventions.units import find_unit


def drive_in_si(drive: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """Bring channels to SI whose unit ``attrs["units"]`` states, as that of a recording that was read does.

    Returns
    -------
    drive : DataFrame
        A copy where anything was converted. Its ``attrs["units"]`` names the converted ones no more.
    notes : list of str
        What was converted.

    Raises
    ------
    RecordingError
        A channel holds text.
    """
    text = [str(name) for name in drive if not pd.api.types.is_numeric_dtype(drive[name])]
    if wrong := [name for name in text if name in DRIVE_CHANNELS]:
        raise RecordingError(f"{', '.join(wrong)} of the drive holds text", todo="enter numbers")
    units = {name: find_unit(text) for name, text in drive.attrs.get("units", {}).items()}
    other = {n: u for n, u in units.items() if u and n in drive and (u.factor, u.offset) != (1.0, 0.0)}
    if not other:
        return drive, []
    left = {name: text for name, text in drive.attrs["units"].items() if name not in other}
    notes = [f"{name} converted from {drive.attrs['units'][name]} to SI" for name in other]
    values = {name: drive[name] * unit.factor + unit.offset for name, unit in other.items()}
    converted = drive.assign(**values)
    converted.attrs = drive.attrs | {"units": left}
    return converted, notes
