"""What a subcommand found: printed for people or machines, and written as a page."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import click
import numpy as np

from tire_pipeline.files.atomic import write_bytes
from tire_pipeline.files.json_values import json_value
from tire_pipeline.pages.numbers_in_words import in_digits
from tire_pipeline.pages.percentage import is_percentage
from tire_pipeline.pages.visible_text import visible

_WIDTH_OF_A_FILE = 1000
NO_UNIT = "-"
"""In a column of units: a ratio, or no unit is known."""


@dataclass(frozen=True)
class Grid:
    """A small table.

    Attributes
    ----------
    header : sequence of str
    rows : sequence of sequence
        Texts and numbers.
    title : str
    """

    header: Sequence[str]
    rows: Sequence[Sequence[Any]]
    title: str = ""


@dataclass(frozen=True)
class CommandOutcome:
    """What a subcommand found.

    Attributes
    ----------
    title : str
    lines : sequence of str
        The result in sentences; the first one matters most.
    data : mapping
        The same for machines.
    page : callable
        Gives the page as HTML; called only if a page is wanted.
    grids : sequence of Grid
        Tables for the terminal.
    notes : sequence of str
        What else to know, printed last.
    written : sequence of Path
        Files that were written beside the page.
    """

    title: str
    lines: Sequence[str]
    data: Mapping[str, Any]
    page: Callable[[], str]
    grids: Sequence[Grid] = ()
    notes: Sequence[str] = ()
    written: Sequence[Path] = field(default_factory=tuple)


def finish(outcome: CommandOutcome, name: str, *, page: Path | None, no_page: bool, as_json: bool) -> None:
    """Write the page, then print the result; a page that cannot be written costs no result.

    Parameters
    ----------
    outcome : CommandOutcome
    name : str
        Name of the page, without its suffix, if ``page`` does not give it.
    page : Path, optional
    no_page, as_json : bool
    """
    written, refusal = [str(path) for path in outcome.written], None
    if not no_page:
        target = page or Path(f"{name}.html")
        content = outcome.page().encode()
        try:
            write_bytes(target, content)
            written.append(str(target))
        except OSError as error:
            refusal = error
    if as_json:
        click.echo(json.dumps(json_value({**outcome.data, "written": written}), ensure_ascii=False, indent=1))
    else:
        _print(outcome, written)
    if refusal is not None:
        raise refusal


def _print(outcome: CommandOutcome, written: Sequence[str]) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    console = Console(highlight=False)
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _WIDTH_OF_A_FILE  # a file or a pipe: what reads it wraps lines itself
    console.print(_line(outcome.title, style="bold"))
    for line in outcome.lines:
        console.print(_line(line))
    for grid in outcome.grids:
        table = Table(box=None, pad_edge=False)
        numbers = [any(_right_aligned(row[k]) for row in grid.rows) for k in range(len(grid.header))]
        for heading, number in zip(grid.header, numbers, strict=True):
            table.add_column(Text(visible(heading)), justify="right" if number else "left", overflow="fold")
        for row in grid.rows:
            table.add_row(*(Text(visible(digits(cell))) for cell in row))
        console.print()
        if grid.title:
            console.print(_line(grid.title, style="italic"))
        console.print(table)
    if outcome.notes:
        console.print()
    for note in outcome.notes:
        console.print(_line(f"note: {note}"))
    if written:
        console.print()
        console.print(_line(f"written: {', '.join(written)}"))


def _line(text: str, style: str = "") -> Any:
    """Return a text as one line, whatever a file's name holds."""
    from rich.text import Text

    return Text(visible(text).replace("\n", "⟨U+000A⟩"), style=style)


def _right_aligned(value: Any) -> bool:
    number = isinstance(value, int | float | np.number) and not isinstance(value, bool)
    return number or is_percentage(value)


def digits(value: Any) -> str:
    """Return a cell's text: numbers with the digits that matter, a dash for nothing."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if isinstance(value, float):
        return in_digits(value, 4)
    return str(value)


def three_digits(value: float) -> float:
    """Return a value rounded to the digits that a force, a stiffness or a friction has for a reader.

    Examples
    --------
    >>> three_digits(128062.0), three_digits(0.9273)
    (128000.0, 0.927)
    """
    return float(f"{value:.3g}")


def percent(share: float) -> str:
    """Return a share with two digits that matter, and no exponent.

    Examples
    --------
    >>> percent(0.0773), percent(0.0049), percent(1.23)
    ('7.7%', '0.49%', '123%')
    """
    value = 100.0 * share
    return f"{value:,.0f}%" if value >= 10.0 else f"{value:.2g}%"
