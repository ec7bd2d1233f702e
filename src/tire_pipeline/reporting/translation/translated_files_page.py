"""The page of translated files: every file, with its curves when it is clicked; it opens offline."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.resources import files as package_files
from typing import Any

from markupsafe import Markup

from tire_pipeline.files.rows_on_disk import RowsOnDisk
from tire_pipeline.pages.drawing import page_style
from tire_pipeline.pages.page_in_pieces import PageInPieces
from tire_pipeline.pages.safe_page import page_environment, policy
from tire_pipeline.pages.visible_text import visible
from tire_pipeline.reporting.embedded import LEVELS, data_element_in_pieces, json_list, packed_json_list
from tire_pipeline.reporting.page_parts import HOME, Table
from tire_pipeline.reporting.translation.drawn_files import CURVES_TOGETHER, DrawnFiles
from tire_pipeline.reporting.translation.translated_rows import ROW_COLUMNS, by_supplier, in_order
from tire_pipeline.tir.reading.read import NEXT_WARNING


def translated_page(
    title: str,
    lines: Sequence[str],
    rows: RowsOnDisk,
    drawn: DrawnFiles,
    *,
    tables: Sequence[Table] = (),
    notes: Sequence[str] = (),
) -> PageInPieces:
    """Draw the page.

    Parameters
    ----------
    title : str
    lines : sequence of str
        What was done, in sentences.
    rows : RowsOnDisk
        The files (:func:`.translated_rows.listed`).
    drawn : DrawnFiles
        Curves and coefficients.
    tables : sequence of Table
        Further tables, below the files.
    notes : sequence of str
        How it was done, in sentences; at the end of the page.

    Returns
    -------
    PageInPieces
        HTML without any outside reference. Its one script is allowed by its hash.
    """
    script, style = _text("translated.js"), page_style() + _text("translated.css")
    environment = page_environment("tire_pipeline.reporting")
    given = {
        "title": title,
        "pages": [*HOME, ("tables/translation_report.csv", "All files as a table (CSV)")],
        "footer": "",
        "lines": lines,
        "suppliers": by_supplier(rows),
        "tables": tables,
        "notes": notes,
        "policy": policy(style=style, scripts=[script]),
        "style": Markup(style),
        "script": Markup(script),
    }
    template = environment.get_template("translated.html")
    return PageInPieces(lambda: template.generate(**given, data=_data(rows, drawn)))


def _data(rows: RowsOnDisk, drawn: DrawnFiles) -> Iterator[Markup]:
    """The files' data as the page has it, in pieces."""
    (count,) = rows.do("select count(*) from rows").fetchone()
    shown = ([visible(v) if isinstance(v, str) else v for v in row] for row in in_order(rows))
    data: dict[str, Any] = {
        "columns": list(ROW_COLUMNS),
        "between": NEXT_WARNING,
        "together": CURVES_TOGETHER,
        "levels": LEVELS,
        "loads": drawn.normal_load,
        "slips": drawn.slip,
        "rows": packed_json_list(shown),
        "parts": json_list(drawn.parts((row[0] for row in in_order(rows)), count)),
    }
    return map(Markup, data_element_in_pieces("data", data))


def _text(name: str) -> str:
    return package_files("tire_pipeline.reporting").joinpath("templates", name).read_text("utf-8")
