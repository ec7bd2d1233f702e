"""The page of translated files: every file, with its curves when it is clicked; it opens offline."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.resources import files as package_files

import pandas as pd
from markupsafe import Markup

from tire_pipeline.pages.drawing import page_style
from tire_pipeline.pages.safe_page import page_environment, policy
from tire_pipeline.pages.visible_text import visible
from tire_pipeline.reporting.embedded import LEVELS, data_element, packed_json
from tire_pipeline.reporting.page_parts import HOME, Table
from tire_pipeline.reporting.translation.drawn_files import CURVES_TOGETHER, DrawnFiles
from tire_pipeline.reporting.translation.translated_rows import ROW_COLUMNS, by_supplier, rows_of


def translated_page(
    title: str,
    lines: Sequence[str],
    report: pd.DataFrame,
    drawn: DrawnFiles,
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
    drawn : DrawnFiles
        Curves and coefficients.
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
    data = {
        "columns": list(ROW_COLUMNS),
        "together": CURVES_TOGETHER,
        "levels": LEVELS,
        "loads": drawn.normal_load,
        "slips": drawn.slip,
        "rows": packed_json([[visible(v) if isinstance(v, str) else v for v in row] for row in rows]),
        "parts": drawn.parts([row[0] for row in rows]),
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
