"""Many tire models as one table, one row a file."""

from __future__ import annotations

from array import array
from collections.abc import Iterable

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.magic_formula import COEFFICIENT_NAMES, TireModel
from tire_pipeline.tir.format.layout import LAYOUT
from tire_pipeline.tire_table.physical_tire import physical_tire_ids

METADATA = {
    "WIDTH": "DIMENSION.WIDTH",
    "ASPECT_RATIO": "DIMENSION.ASPECT_RATIO",
    "RIM_RADIUS": "DIMENSION.RIM_RADIUS",
    "RIM_WIDTH": "DIMENSION.RIM_WIDTH",
    "MASS": "INERTIA.MASS",
}
"""Column -> metadata of the model. ``UNLOADED_RADIUS``, ``NOMPRES`` and ``FNOMIN`` are coefficients
already."""

ALWAYS = ("UNLOADED_RADIUS", *METADATA, "NOMPRES", "FNOMIN")
"""Number columns that every table has."""

_NOT_COEFFICIENTS = {"MODEL", "DIMENSION", "INERTIA"}
TEXTS = ("file", "category", "version", "date")
"""Text columns that every table has before the numbers; ``tire_id`` comes last."""

KNOWN_COEFFICIENTS = tuple(
    dict.fromkeys(
        [
            *COEFFICIENT_NAMES,
            *(key for name, keys in LAYOUT.items() if name not in _NOT_COEFFICIENTS for key in keys),
        ]
    )
)
"""Coefficients that get a column, in column order; others stay in the models only."""


def from_models(models: Iterable[tuple[str, str, TireModel]]) -> pd.DataFrame:
    """Collect models into a tire table.

    The models are taken one by one and not kept, so that a generator that reads files needs little more
    memory than the table: about 8 bytes a coefficient and file.

    Parameters
    ----------
    models : iterable of (file, category, TireModel)
        ``file`` is the path relative to the folder and is unique.

    Returns
    -------
    DataFrame
        Sorted by ``file``, with a new index. ``file``, ``category``, ``version``, ``date`` (text; the day of
        the measurement as ``YYYY-MM-DD``, empty where the file does not tell); the coefficients
        (float64, SI; NaN where the file has none, also where another value stands in for it); the metadata
        ``WIDTH, ASPECT_RATIO, RIM_RADIUS, RIM_WIDTH, MASS`` (float64, SI); ``tire_id`` (text,
        :func:`physical_tire_ids`). Without any model the same columns, empty.

    Raises
    ------
    DomainError
        Two models have the same ``file``.
    """
    texts: list[tuple[str, str, str, str]] = []
    # Files of one origin have the same keys: rows are collected by their keys, as bare numbers.
    groups: dict[tuple[str, ...], tuple[array[int], array[float]]] = {}
    known = frozenset(KNOWN_COEFFICIENTS)
    for row, (file, category, model) in enumerate(models):
        texts.append((file, category, model.version, str(model.metadata.get("date", ""))))
        values = {k: v for k, v in model.coefficients.items() if k in known}
        for column, name in METADATA.items():
            value = model.metadata.get(name)
            if isinstance(value, int | float):
                values[column] = float(value)
        rows, numbers = groups.setdefault(tuple(values), (array("q"), array("d")))
        rows.append(row)
        numbers.extend(values.values())
    columns = _column_order(groups)
    names = pd.DataFrame(texts, columns=list(TEXTS), dtype="str")
    if names["file"].duplicated().any():
        twice = names.loc[names["file"].duplicated(), "file"].iloc[0]
        raise DomainError("a file occurs twice among the models", where=twice, todo="give each path once")
    table = pd.DataFrame(_matrix(groups, columns, len(texts)), columns=columns, copy=False)
    for place, name in enumerate(names.columns):
        table.insert(place, name, names[name])
    table["tire_id"] = physical_tire_ids(table)
    if table["file"].is_monotonic_increasing:
        return table
    return table.sort_values("file", ignore_index=True)


def join_tables(parts: Iterable[pd.DataFrame]) -> pd.DataFrame:
    """Tables of different files as one: as if :func:`from_models` had been given all their models at once.

    Parameters
    ----------
    parts : iterable of DataFrame

    Raises
    ------
    DomainError
        A file is in two of them.
    """
    some = [part.drop(columns="tire_id") for part in parts if len(part)]
    if not some:
        return from_models([])
    columns = [*TEXTS, *_column_order(tuple(part.columns[len(TEXTS) :]) for part in some)]
    table = pd.concat([part.reindex(columns=columns) for part in some], ignore_index=True)
    if table["file"].duplicated().any():
        twice = table.loc[table["file"].duplicated(), "file"].iloc[0]
        raise DomainError("a file is in two tables", where=twice, todo="give each file once")
    table["tire_id"] = physical_tire_ids(table)
    return table.sort_values("file", ignore_index=True)


def as_in_whole(part: pd.DataFrame, numbers: Iterable[str]) -> pd.DataFrame:
    """Rows of a table as they stand in the whole: all its columns, and ``tire_id`` made of them.

    Parameters
    ----------
    part : DataFrame
        A tire table.
    numbers : iterable of str
        Number columns of the whole.
    """
    columns = [*TEXTS, *_column_order([tuple(numbers)])]
    whole = part.reindex(columns=columns).copy()  # in one piece: pandas warns of columns put in one by one
    whole["date"] = whole["date"].fillna("").astype("str")  # a table of before there were dates has none
    whole["tire_id"] = physical_tire_ids(whole)
    return whole


def _column_order(groups: Iterable[tuple[str, ...]]) -> list[str]:
    found = {*ALWAYS}.union(*groups)
    first = [name for name in KNOWN_COEFFICIENTS if name in found]
    return [*first, *(name for name in ALWAYS if name not in first)]


def _matrix(
    groups: dict[tuple[str, ...], tuple[array[int], array[float]]], columns: list[str], count: int
) -> np.ndarray:
    place = {name: i for i, name in enumerate(columns)}
    matrix = np.full((len(columns), count), np.nan)
    while groups:
        names, (rows, numbers) = groups.popitem()
        if not names:
            continue
        at = np.frombuffer(rows, dtype=np.int64)
        block = np.frombuffer(numbers).reshape(len(at), len(names))
        for i, name in enumerate(names):
            matrix[place[name], at] = block[:, i]
    return matrix.T
