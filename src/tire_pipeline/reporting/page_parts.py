"""Self-contained pages from a title and a list of parts; all text is escaped, and none of it runs."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import repeat
from typing import TYPE_CHECKING
from urllib.parse import quote

import pandas as pd
from markupsafe import Markup
from pandas.api.types import is_bool_dtype, is_numeric_dtype

from tire_pipeline.pages.drawing import inline_svg, page_style
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.pages.percentage import is_percentage
from tire_pipeline.pages.safe_page import page_environment, policy

if TYPE_CHECKING:
    from matplotlib.figure import Figure as MplFigure


@dataclass(frozen=True)
class Text:
    """Paragraphs under an optional heading.

    Attributes
    ----------
    paragraphs : sequence of str
    heading : str
    emphasis : bool
        Show as the page's main message.
    """

    paragraphs: Sequence[str]
    heading: str = ""
    emphasis: bool = False
    kind: str = field(default="text", init=False)


@dataclass(frozen=True)
class Table:
    """A table with a caption.

    Attributes
    ----------
    frame : pandas.DataFrame
        Shown without its index.
    caption : str
    heading : str
    digits : int
        Significant digits of numbers. A column has the same decimals in each row, unless a small value
        would lose by it.
    decimals : int, optional
        Of all floats, small ones too: for shares of one or of a hundred.
    unlike : bool
        A column holds quantities of different kinds, such as coefficients: each number has its own digits.
    most_rows : int
        Further rows are counted, not shown.
    further : int
        Rows that are not in the frame, to be counted with those.
    below : str
        A column of long texts, each shown below its row, over the whole width.
    """

    frame: pd.DataFrame
    caption: str = ""
    heading: str = ""
    digits: int = 3
    decimals: int | None = None
    unlike: bool = False
    most_rows: int = 200
    further: int = 0
    below: str = ""
    kind: str = field(default="table", init=False)

    @property
    def columns(self) -> list[str]:
        """Columns that stand beside each other."""
        return [name for name in self.frame.columns if name != self.below]

    @property
    def rows(self) -> list[tuple[list[tuple[str, bool]], str]]:
        """Cells as (text, is a number), and the text below."""
        shown = self.frame.head(self.most_rows)
        decimals = [self._decimals_of(shown[name]) for name in self.columns]
        heads = self.heads
        cells = [
            [
                (text, number or column)
                for (text, number), (_, column) in zip(
                    map(_cell, row, repeat(self.digits), decimals), heads, strict=True
                )
            ]
            for row in shown[self.columns].itertuples(index=False)
        ]
        below = (
            [_cell(value, self.digits)[0] for value in shown[self.below]] if self.below else [""] * len(cells)
        )
        return list(zip(cells, below, strict=True))

    def _decimals_of(self, column: pd.Series) -> int | None:
        if self.unlike or self.decimals is not None:
            return self.decimals
        return _decimals(column.tolist(), self.digits)

    @property
    def heads(self) -> list[tuple[str, bool]]:
        """Names of the columns, and whether numbers stand below."""
        return [
            (str(name), bool(len(self.frame)) and _holds_numbers(self.frame[name])) for name in self.columns
        ]

    @property
    def left_out(self) -> int:
        """How many rows are not shown."""
        return max(0, len(self.frame) - self.most_rows) + self.further


@dataclass(frozen=True)
class Drawing:
    """A figure that has been drawn, for whoever shows it in several places.

    Attributes
    ----------
    svg : str
        An SVG element.
    tall : bool
        Whether it is higher than wide: printed, it may fill a page.
    """

    svg: Markup
    tall: bool = False

    @classmethod
    def of(cls, figure: MplFigure) -> Drawing:
        """Draw a figure; that takes about half a second."""
        width, height = figure.get_size_inches()
        return cls(inline_svg(figure), bool(height > width))


@dataclass(frozen=True)
class Figure:
    """A figure with a caption, drawn as inline SVG.

    Attributes
    ----------
    figure : matplotlib.figure.Figure or Drawing
    caption : str
    heading : str
    """

    figure: MplFigure | Drawing
    caption: str = ""
    heading: str = ""
    kind: str = field(default="figure", init=False)

    @cached_property
    def drawing(self) -> Drawing:
        """The figure, drawn when a page shows it."""
        return self.figure if isinstance(self.figure, Drawing) else Drawing.of(self.figure)


@dataclass(frozen=True)
class Links:
    """Links to other pages in the same folder or below it.

    Attributes
    ----------
    items : sequence of (str, str, str)
        Path relative to the page, what it is called, and one sentence about it. Without a path it is
        named but not linked.
    heading : str
    """

    items: Sequence[tuple[str, str, str]]
    heading: str = ""
    kind: str = field(default="links", init=False)

    @property
    def escaped(self) -> list[tuple[str, str, str]]:
        """The same, with paths as they stand in an address."""
        return [(quote(path), name, text) for path, name, text in self.items]


HOME = (("index.html", "All reports"),)
"""The way back to the front page, for pages that lie beside it."""


@dataclass(frozen=True)
class Picture:
    """A picture that lies beside the page.

    Attributes
    ----------
    path : str
        Relative to the page.
    caption : str
    heading : str
    """

    path: str
    caption: str = ""
    heading: str = ""
    kind: str = field(default="picture", init=False)

    @property
    def escaped(self) -> str:
        """The path as it stands in an address."""
        return quote(self.path)


Part = Text | Table | Figure | Links | Picture
"""What a page is made of."""


def render_page(
    title: str,
    parts: Sequence[Part],
    *,
    pages: Sequence[tuple[str, str]] = (),
    footer: str = "",
) -> str:
    """One HTML page without any outside reference.

    Parameters
    ----------
    title : str
    parts : sequence of Text, Table, Figure, Links and Picture
    pages : sequence of (str, str)
        Other pages for the top of this one: path relative to it, and what it is called.
    footer : str
        For example which run made the page.

    Returns
    -------
    str

    Examples
    --------
    >>> "&lt;b&gt;" in render_page("<b>", [Text(["plain"])])
    True
    """
    style = page_style()
    kinds = {part.kind for part in parts}
    return (
        page_environment("tire_pipeline.reporting")
        .get_template("page.html")
        .render(
            title=title,
            parts=parts,
            pages=[(quote(path), name) for path, name in pages],
            footer=footer,
            style=Markup(style),
            policy=policy(style=style, figures="figure" in kinds, pictures="picture" in kinds),
        )
    )


def without_empty_columns(table: pd.DataFrame, always: Sequence[str] = ()) -> pd.DataFrame:
    """Return a table of texts without its empty columns.

    Parameters
    ----------
    table : DataFrame
    always : sequence of str
        Columns that stay, empty or not.
    """
    return table.loc[:, [name in always or bool((table[name] != "").any()) for name in table.columns]]


def _holds_numbers(column: pd.Series) -> bool:
    if is_numeric_dtype(column):
        return not is_bool_dtype(column)
    return any(map(_reads_as_number, column)) and all(
        _reads_as_number(each) or each in ("–", "") for each in column
    )


_WITH_SPREAD = re.compile(r"[+-]?\d[\d,]*\.\d+( ± <?\d[\d,]*\.?\d*)?")


def _reads_as_number(value: object) -> bool:
    """Whether a text is a percentage, or a number with decimals, with or without its spread.

    Examples
    --------
    >>> _reads_as_number("0.170 ± 0.005"), _reads_as_number("2.13"), _reads_as_number("4 ± the rest")
    (True, True, False)
    """
    return is_percentage(value) or (isinstance(value, str) and bool(_WITH_SPREAD.fullmatch(value)))


_LOSS = 0.05
"""Share of a value that may be lost where a column is given the decimals of its largest value."""


def _decimals(values: Sequence[object], digits: int) -> int | None:
    """Decimals that suit a whole column of floats; None if its values are of too different sizes.

    Examples
    --------
    >>> _decimals([0.1304, 0.143], 3), _decimals([1.0, 0.926], 3), _decimals([250.0, 0.02], 3)
    (3, 2, None)
    """
    sizes = [abs(value) for value in values if isinstance(value, float) and math.isfinite(value)]
    largest = max(sizes, default=0.0)
    if not largest or all(size.is_integer() for size in sizes):
        return None
    decimals = min(max(digits - 1 - math.floor(math.log10(largest)), 0), digits)
    lost = any(abs(round(size, decimals) - size) > _LOSS * size for size in sizes)
    return None if lost else decimals


def _cell(value: object, digits: int, decimals: int | None = None) -> tuple[str, bool]:
    if isinstance(value, bool):
        return ("yes" if value else "no", False)
    if value is None:
        return ("–", False)
    if isinstance(value, float):
        if value != value:
            return ("–", True)
        if decimals is not None and math.isfinite(value):
            return (f"{value:,.{decimals}f}", True)
        return (in_digits(value, digits), True)
    if isinstance(value, int):
        return (f"{value:,}", True)
    return (str(value), False)
