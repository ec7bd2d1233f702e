"""Curves of each file for the page of translated files, small enough for many thousand files."""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from typing import Any

import numpy as np
import pandas as pd

from tire_pipeline.files.rows_on_disk import RowsOnDisk
from tire_pipeline.progress import track
from tire_pipeline.reporting.embedded import packed_bytes, packed_json, quantised
from tire_pipeline.translation.curves.of_files import DRAWN_OUTPUTS

CURVES_TOGETHER = 40
"""Files whose curves are compressed together, and opened together when one of them is clicked."""

DIGITS = 5
_NO_TIRES: Mapping[str, str] = {}
_NO_CURVES: dict[str, Any] = {"scales": [None] * len(DRAWN_OUTPUTS), "stiffness": None, "moved": []}


class DrawnFiles:
    """Curves, moved coefficients and tires of files, compressed, on the disk: about 1 kB a file."""

    def __init__(self) -> None:
        self.normal_load: list[float] = []
        self.slip: list[float] = []
        self._rows = RowsOnDisk(("file", "tire", "forces", "numbers"))
        self._rows.do("create index by_file on rows (file)")

    def add(
        self, curves: Mapping[str, Any], coefficients: pd.DataFrame, tires: Mapping[str, str] = _NO_TIRES
    ) -> None:
        """Add some files.

        Parameters
        ----------
        curves : mapping
            From :func:`tire_pipeline.translation.curves.of_files.file_curves`.
        coefficients : DataFrame
            ``file, coefficient, from, to``.
        tires : mapping of str to str
            File -> its physical tire.
        """
        self.normal_load = [float(load) for load in curves["normal_load"]]
        self.slip = [round(float(slip), 6) for slip in curves["slip"]]
        by_file = dict(tuple(coefficients.groupby("file"))) if len(coefficients) else {}
        self._rows.add(
            (file, tires.get(file, ""), *_compressed(curves, i, by_file.get(file)))
            for i, file in enumerate(map(str, curves["files"]))
        )

    def tire(self, file: str) -> str:
        """The physical tire of a file; "" if nothing is drawn of it."""
        found = self._rows.do("select tire from rows where file = ?", (file,)).fetchone()
        return found[0] if found else ""

    def parts(self, files: Iterable[str], count: int) -> Iterator[list[str]]:
        """Compressed curves, and numbers as JSON, of ``CURVES_TOGETHER`` files each, in their order.

        Parameters
        ----------
        files : iterable of str
        count : int
            How many they are.
        """
        some = _batched(iter(files), CURVES_TOGETHER)
        for names in track(some, "drawing the translated files", total=-(-count // CURVES_TOGETHER)):
            forces, numbers = [], []
            for file in names:
                found = self._rows.do("select forces, numbers from rows where file = ?", (file,)).fetchone()
                if found:
                    curves, rest = map(zlib.decompress, found)
                    forces.append(curves)
                    numbers.append(json.loads(rest))
                else:
                    numbers.append(_NO_CURVES)
            yield [packed_bytes(b"".join(forces)), packed_json(numbers)]


def _batched(files: Iterator[str], size: int) -> Iterator[list[str]]:
    """So many at a time (``itertools.batched`` of Python 3.12)."""
    while some := list(islice(files, size)):
        yield some


def _compressed(curves: Mapping[str, Any], i: int, moved: pd.DataFrame | None) -> tuple[bytes, bytes]:
    """Curves of the ``i``-th file, and the numbers beside them."""
    forces, scales = _forces(curves, i)
    numbers = {
        "scales": scales,
        "stiffness": _stiffness(curves, i),
        "moved": _moved(moved) if moved is not None else [],
    }
    return zlib.compress(forces, 1), zlib.compress(json.dumps(numbers).encode(), 1)


def _forces(curves: Mapping[str, Any], i: int) -> tuple[bytes, list[list[float | bool] | None]]:
    """Source, middle and half width of each output, and [scale, has source, has band] of each."""
    stacks: list[np.ndarray] = []
    scales: list[np.ndarray] = []
    found: list[list[float | bool] | None] = []
    for name in DRAWN_OUTPUTS:
        source, low, high = (np.asarray(curves[f"{name}_{k}"][i], float) for k in ("source", "low", "high"))
        stack = np.stack([source, (high + low) / 2, (high - low) / 2])
        has = np.isfinite(stack).all(axis=(1, 2))
        if not has.any():
            found.append(None)
            continue
        scale = _digits(float(np.abs(stack[has]).max()))
        found.append([scale, bool(has[0]), bool(has[1])])
        stacks.append(np.where(has[:, None, None], stack, 0.0))
        scales.append(np.full(stack.shape[:2], scale))
    if not stacks:
        return b"", found
    return quantised(np.stack(stacks), np.stack(scales)), found


def _stiffness(curves: Mapping[str, Any], i: int) -> list[list[float | None]]:
    return [
        [_digits(value) if np.isfinite(value) else None for value in curves[f"stiffness_{part}"][i]]
        for part in ("source", "middle", "low", "high")
    ]


def _moved(rows: pd.DataFrame) -> list[list[Any]]:
    """Return the coefficients that moved by what is shown of them, with both values."""
    pairs = [
        [name, *(_digits(value) if np.isfinite(value) else None for value in pair)]
        for name, *pair in rows[["coefficient", "from", "to"]].itertuples(index=False)
    ]
    return [[name, before, after] for name, before, after in pairs if before != after]


def _digits(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
