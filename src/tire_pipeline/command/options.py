"""Options that several subcommands share."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from tire_pipeline.errors import DomainError, RecordingError, TirError

if TYPE_CHECKING:
    import pandas as pd

F = TypeVar("F", bound=Callable[..., Any])
FILE = click.Path(path_type=Path)


class FiniteRange(click.FloatRange):
    """A number within a range; neither ``nan`` nor ``inf``, which click takes for one."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number."""
        number = float(super().convert(value, param, ctx))
        if not math.isfinite(number):
            self.fail(f"{value!r} is not a finite number.", param, ctx)
        return number


LOAD_OPTION = FiniteRange(0.0, min_open=True)
"""N."""
CAMBER_OPTION = FiniteRange(-90.0, 90.0, min_open=True, max_open=True)
"""deg."""


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
                callback=_page_that_can_be_written,
                help="The page to write. Default: named after file and command, in the current folder.",
            ),
        ):
            function = option(function)
        return function

    return add


def _page_that_can_be_written(_: click.Context, option: click.Parameter, page: Path | None) -> Path | None:
    """Refuse a page that cannot be written, before anything long is computed."""
    if page is not None:
        check_page(page)
        _check_folder(page, " or ".join(option.opts))
    return page


def check_page(page: Path) -> None:
    """Refuse anything but HTML, so that no input is overwritten."""
    if page.suffix.lower() not in (".html", ".htm"):
        raise DomainError("the page is HTML", where=str(page), todo="choose a name that ends in .html")


def _check_folder(path: Path, option: str) -> None:
    if not path.parent.is_dir():
        raise DomainError(
            "there is no such folder", where=str(path.parent), todo=f"make it, or choose another {option}"
        )


def radius_option(function: F) -> F:
    """``--unloaded-radius``: what a .tir file may lack."""
    return click.option(
        "--unloaded-radius",
        "radius",
        type=click.FloatRange(0.0, min_open=True),
        metavar="METRES",
        help="Unloaded radius of the tire, m, where a .tir file states none.",
    )(function)


class _Axes(click.ParamType):
    """``SAE``, or ``run.csv:SAE`` for one of several recordings; ``adapted-SAE`` for Pacejka's system."""

    name = "axes"

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the text with the axes' own name."""
        from tire_pipeline.recordings.conventions.axis_systems import named_axes  # slow to import

        run, colon, axes = value.rpartition(":")
        try:
            return f"{run}{colon}{named_axes(axes)}"
        except RecordingError:
            self.fail(
                f"{value!r} is not ISO, SAE or adapted-SAE, or one of these for one recording: run.csv:SAE",
                param,
                ctx,
            )


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
            help="Which channel a column of the file is, such as --name Kraft_y=fy; can be repeated. A "
            "channel that no column holds may be a number: --name slip_angle=0. Of several recordings, "
            "--axes, --unit and --name hold for all, or for one: --unit run.csv:FY=kN.",
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
            type=_Axes(),
            multiple=True,
            metavar="[ISO|SAE|adapted-SAE]",
            help="Axes of the file, if the names of its channels do not tell. Default: ISO, with a note.",
        ),
    ):
        function = option(function)
    return function


def read_runs(
    paths: Sequence[Path],
    *,
    axes: Sequence[str],
    units: Sequence[str],
    names: Sequence[str],
    format_: str | None,
) -> dict[str, pd.DataFrame]:
    """Read recordings, by file name, or by path where two have one name."""
    from tire_pipeline.recordings import read_recording

    runs, called = {}, names_of(paths)
    for name, path in zip(called, paths, strict=True):
        stated = partial(_of_run, name, called)
        runs[name] = read_recording(
            path,
            format=format_,
            axes=next(iter(reversed(stated(axes, "--axes"))), None),
            units=_pairs(stated(units, "--unit"), "--unit", "COLUMN=UNIT, such as SA=deg"),
            names=_pairs(stated(names, "--name"), "--name", "COLUMN=CHANNEL, such as Kraft_y=fy"),
        )
    return runs


def _of_run(run: str, runs: Sequence[str], texts: Sequence[str], option: str) -> list[str]:
    """What is stated for all recordings, and after it what is stated for one of them."""
    whose = [next((r for r in runs if text.startswith(f"{r}:")), "") for text in texts]
    if option == "--axes" and (
        unknown := [t for t, r in zip(texts, whose, strict=True) if ":" in t and not r]
    ):
        of = unknown[0].rpartition(":")[0]
        raise click.BadParameter(f"no recording is called {of!r}: {', '.join(runs)}", param_hint=option)
    own = [text.removeprefix(f"{run}:") for text, r in zip(texts, whose, strict=True) if r == run]
    return [text for text, r in zip(texts, whose, strict=True) if not r] + own


def same_file(one: Path, two: Path) -> bool:
    """Whether two paths are one file, however each is written."""
    return one == two or (one.exists() and two.exists() and one.samefile(two))


def names_of(paths: Sequence[Path]) -> list[str]:
    """Names of files, or their paths where two have one name.

    Raises
    ------
    DomainError
        A file is given twice.
    """
    twice = [p for number, p in enumerate(paths) if any(same_file(p, other) for other in paths[:number])]
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


def check_target(path: Path, overwrite: bool, *sources: Path, option: str = "-o") -> None:
    """Refuse a file that cannot or must not be written, before anything long is computed.

    Raises
    ------
    TirError
        The file is there and ``overwrite`` is False, or it is one of the files that are read.
    DomainError
        Its folder does not exist.
    """
    _check_folder(path, option)
    if any(path.exists() and source.exists() and path.samefile(source) for source in sources):
        raise TirError(
            "this is the input, which is never changed", path=str(path), todo=f"choose another {option}"
        )
    if path.is_dir():
        raise TirError("this is a folder", path=str(path), todo=f"choose another {option}")
    if path.exists() and not overwrite:
        raise TirError(
            "there is a file of that name",
            path=str(path),
            todo=f"choose another {option}, or add --overwrite",
        )
