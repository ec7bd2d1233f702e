"""The page of translated files: every file, with its curves when it is clicked; it opens offline."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.resources import files as package_files
from typing import Any

import numpy as np
import pandas as pd
from markupsafe import Markup

from tire_pipeline.pages.drawing import page_style
from tire_pipeline.pages.safe_page import page_environment, policy, visible
from tire_pipeline.progress import track
from tire_pipeline.reporting.embedded import (
    LEVELS,
    data_element,
    packed_bytes,
    packed_json,
    quantised,
)
from tire_pipeline.reporting.page import HOME, Table
from tire_pipeline.reporting.translation.translated_rows import ROW_COLUMNS, by_supplier, rows_of
from tire_pipeline.translation.curves.of_files import DRAWN_OUTPUTS

CURVES_TOGETHER = 40
"""Files whose curves are compressed together, and opened together when one of them is clicked."""

DIGITS = 5


def translated_page(
    title: str,
    lines: Sequence[str],
    report: pd.DataFrame,
    curves: Mapping[str, Any],
    coefficients: pd.DataFrame,
    *,
    own: set[str],
    tires: Mapping[str, str],
    tables: Sequence[Table] = (),
) -> str:
    """Draw the page.

    Parameters
    ----------
    title : str
    lines : sequence of str
        What was done, in sentences.
    report : DataFrame
        ``TranslationResult.report`` with ``supplier``, how the supplier of each file is known.
    curves : mapping
        From :func:`tire_pipeline.translation.curves.of_files.file_curves`.
    coefficients : DataFrame
        ``file, coefficient, from, to``.
    own : set of str
        Files of the user, which come first.
    tires : mapping of str to str
        File -> its physical tire.
    tables : sequence of Table
        Further tables, below the files.

    Returns
    -------
    str
        HTML without any outside reference. Its one script is allowed by its hash.
    """
    rows = rows_of(report, own, tires)
    place = {str(file): i for i, file in enumerate(curves["files"])}
    order = [place.get(row[0], -1) for row in rows]
    data = {
        "columns": list(ROW_COLUMNS),
        "together": CURVES_TOGETHER,
        "levels": LEVELS,
        "loads": [float(load) for load in curves["normal_load"]],
        "slips": [round(float(slip), 6) for slip in curves["slip"]],
        "rows": packed_json([[visible(v) if isinstance(v, str) else v for v in row] for row in rows]),
        "parts": _parts(order, curves, coefficients),
    }
    script, style = _text("translated.js"), page_style() + _text("translated.css")
    environment = page_environment("tire_pipeline.reporting")
    return environment.get_template("translated.html").render(
        title=title,
        pages=[*HOME, ("tables/translation_report.csv", "All files as a table (CSV)")],
        footer="",
        lines=lines,
        suppliers=by_supplier(rows),
        tables=tables,
        policy=policy(style=style, scripts=[script]),
        style=Markup(style),
        script=Markup(script),
        data=Markup(data_element("data", data)),
    )


def _text(name: str) -> str:
    return package_files("tire_pipeline.reporting").joinpath("templates", name).read_text("utf-8")


def _parts(order: list[int], curves: Mapping[str, Any], coefficients: pd.DataFrame) -> list[list[str]]:
    """Compressed curves, and numbers as JSON, of ``CURVES_TOGETHER`` rows each."""
    by_file = dict(tuple(coefficients.groupby("file"))) if len(coefficients) else {}
    parts = []
    for first in track(range(0, len(order), CURVES_TOGETHER), "drawing the translated files"):
        rows = order[first : first + CURVES_TOGETHER]
        forces, numbers = [], []
        for i in rows:
            packed, scales = _forces(curves, i) if i >= 0 else (b"", [None] * len(DRAWN_OUTPUTS))
            forces.append(packed)
            moved = by_file.get(str(curves["files"][i])) if i >= 0 else None
            numbers.append(
                {
                    "scales": scales,
                    "stiffness": _stiffness(curves, i) if i >= 0 else None,
                    "moved": _moved(moved) if moved is not None else [],
                }
            )
        parts.append([packed_bytes(b"".join(forces)), packed_json(numbers)])
    return parts


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
    return [
        [name, *(_digits(value) if np.isfinite(value) else None for value in pair)]
        for name, *pair in rows[["coefficient", "from", "to"]].itertuples(index=False)
    ]


def _digits(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
