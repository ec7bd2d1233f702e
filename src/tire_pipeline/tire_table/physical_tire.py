"""Which files are measurements of one physical tire, or may be."""

from __future__ import annotations

import hashlib

import numpy as np
import pandas as pd

SIZE_KEYS = ("WIDTH", "ASPECT_RATIO", "RIM_RADIUS", "UNLOADED_RADIUS", "MASS")
"""Metadata that belongs to the tire and not to who measured it. ``FNOMIN`` and the pressures are the
measurer's choice, ``RIM_WIDTH`` the rim of the rig."""

_ROUNDED_TO = np.array([1e-6, 1e-5, 1e-6, 1e-6, 1e-4])


def physical_tire_ids(table: pd.DataFrame) -> pd.Series:
    """Name the physical tire of each row by its size and mass.

    Two rows get the same name if ``SIZE_KEYS`` agree to 1 micrometre, 0.00001 and 0.1 g: that is the same
    metadata after a change of units, not nearly the same. Files and folders play no part. Real files of one
    tire may state another mass or radius; then they count as two tires.

    Parameters
    ----------
    table : DataFrame
        Has the columns ``SIZE_KEYS`` (SI; NaN where not known).

    Returns
    -------
    Series of str
        For example ``"205/55 rim 203.2 radius 316.2 mm 9.83 kg"``, ``?`` for what is not known. A row where
        all five are unknown is named by its own numbers, so it is one tire with rows of the same
        coefficients only.

    Examples
    --------
    >>> row = {"WIDTH": 0.205, "ASPECT_RATIO": 0.55, "RIM_RADIUS": 0.2032}
    >>> physical_tire_ids(pd.DataFrame([{**row, "UNLOADED_RADIUS": 0.3162, "MASS": 9.83}]))[0]
    '205/55 rim 203.2 radius 316.2 mm 9.83 kg'
    """
    values = table[list(SIZE_KEYS)].to_numpy(dtype=float)
    known = np.isfinite(values)
    steps = np.where(known, np.round(np.where(known, values, 0.0) / _ROUNDED_TO), -1.0)
    unique, place = np.unique(steps, axis=0, return_inverse=True)
    names = np.array([_name(row) for row in unique], dtype=object)[place.ravel()]
    nameless = ~known.any(axis=1)
    if nameless.any():
        names[nameless] = _names_by_numbers(table.loc[nameless])
    return pd.Series(names, index=table.index, dtype="str", name="tire_id")


def told_tires(table: pd.DataFrame) -> np.ndarray:
    """Name the physical tire of each row as far as its file tells it, shape (n,).

    ``tire_id`` keeps files apart that may be of one tire: splits need that. Whoever takes files of one name
    for measurements of one tire needs the opposite. A file that does not state its mass may be of any tire of
    its size, so it is a tire of its own here.

    Parameters
    ----------
    table : DataFrame
        Has ``tire_id``, and ``file`` where it has the column ``MASS``.
    """
    names = table["tire_id"].astype(str).to_numpy(dtype=str)
    if "MASS" not in table:
        return names
    return np.where(table["MASS"].isna(), table["file"].astype(str) + " alone", names).astype(str)


def _name(steps: np.ndarray) -> str:
    shown = zip(steps, (1e-3, 1e-3, 1e-3, 1e-3, 1e-4), strict=True)
    width, aspect, rim, radius, mass = ("?" if step < 0 else step * scale for step, scale in shown)
    return f"{_short(width)}/{_short(aspect)} rim {_short(rim)} radius {_short(radius)} mm {_short(mass)} kg"


def _short(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:.4f}".rstrip("0").rstrip(".")


def _names_by_numbers(rows: pd.DataFrame) -> list[str]:
    numbers = rows.select_dtypes("number")
    numbers = numbers[sorted(numbers.columns)].to_numpy(dtype=float)
    return [
        "unknown " + hashlib.sha256(row.tobytes()).hexdigest()[:12] for row in np.ascontiguousarray(numbers)
    ]
