"""Options that several subcommands share."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from tire_pipeline.errors import DomainError, TirError

if TYPE_CHECKING:
    import pandas as pd

F = TypeVar("F", bound=Callable[..., Any])
FILE = click.Path(path_type=Path)


def output_options(*names: str) -> Callable[[F], F]:
    """``--page``, ``--no-page`` and ``--json``; ``names`` are further names of ``--page``."""

    def add(function: F) -> F:
        for option in (
            click.option("--json", "as_json", is_flag=True, help="Print JSON, and nothing else."),
            click.option("--no-page", is_flag=True, help="Write no page."),
            click.option(
                *names,
                "--page",
                type=FILE,
                help="The page to write. Default: named after file and command, in the current folder.",
            ),
        ):
            function = option(function)
        return function

    return add


def radius_option(function: F) -> F:
    """``--unloaded-radius``: what a .tir file may lack."""
    return click.option(
        "--unloaded-radius",
        "radius",
        type=click.FloatRange(0.0, min_open=True),
        metavar="METRES",
        help="Unloaded radius of the tire, m, where a .tir file states none.",
    )(function)


def reading_options(function: F) -> F:
    """``--axes``, ``--unit``, ``--name`` and ``--format``: how recordings are read."""
    for option in (
        click.option(
            "--format",
            "format_",
            help="TYDEX, CSV, MDF4, MAT or Parquet. Default: by content, then by suffix.",
        ),
        click.option(
            "--name",
            "names",
            multiple=True,
            metavar="COLUMN=CHANNEL",
            help="Which channel a column of the file is, such as --name Querkraft=fy; can be repeated.",
        ),
        click.option(
            "--unit",
            "units",
            multiple=True,
            metavar="COLUMN=UNIT",
            help="The unit of a column of the file, such as --unit SA=deg; can be repeated.",
        ),
        click.option(
            "--axes",
            type=click.Choice(["ISO", "SAE"], case_sensitive=False),
            help="Axes of the file, if the names of its channels do not tell. Default: ISO, with a note.",
        ),
    ):
        function = option(function)
    return function


def read_runs(
    paths: Sequence[Path],
    *,
    axes: str | None,
    units: Sequence[str],
    names: Sequence[str],
    format_: str | None,
) -> dict[str, pd.DataFrame]:
    """Read recordings, by file name, or by path where two have one name."""
    from tire_pipeline.recordings import read_recording

    runs = {}
    for name, path in zip(names_of(paths), paths, strict=True):
        runs[name] = read_recording(
            path,
            format=format_,
            axes=axes,
            units=_pairs(units, "--unit", "COLUMN=UNIT, such as SA=deg"),
            names=_pairs(names, "--name", "COLUMN=CHANNEL, such as Querkraft=fy"),
        )
    return runs


def names_of(paths: Sequence[Path]) -> list[str]:
    """Names of files, or their paths where two have one name.

    Raises
    ------
    DomainError
        A file is given twice.
    """
    twice = [path for number, path in enumerate(paths) if path in paths[:number]]
    if twice:
        raise DomainError("this file is given twice", where=str(twice[0]), todo="give each file once")
    names = [path.name for path in paths]
    return names if len(set(names)) == len(names) else [str(path) for path in paths]


def _pairs(texts: Sequence[str], option: str, form: str) -> dict[str, str]:
    pairs = {}
    for text in texts:
        column, equals, value = text.rpartition("=")
        if not equals or not column or not value:
            raise click.BadParameter(f"{text!r} is not {form}", param_hint=option)
        pairs[column] = value
    return pairs


def check_target(path: Path, overwrite: bool, *sources: Path) -> None:
    """Refuse to write over a file, before anything long is computed.

    Raises
    ------
    TirError
        The file is there and ``overwrite`` is False, or it is one of the files that are read.
    """
    if any(path.exists() and source.exists() and path.samefile(source) for source in sources):
        raise TirError("this is the input, which is never changed", path=str(path), todo="choose another -o")
    if path.exists() and not overwrite:
        raise TirError(
            "there is a file of that name", path=str(path), todo="choose another -o, or add --overwrite"
        )
