"""``kedro run`` with errors that fit in one line, and without a warning for ``--pipeline``."""

from __future__ import annotations

import pkgutil
from collections.abc import Sequence
from typing import Any

import click
from kedro.framework.cli.project import run as kedro_run
from yaml import YAMLError

from tire_pipeline import pipelines
from tire_pipeline.errors import DomainError, did_you_mean
from tire_pipeline.kedro_runs.run_errors import errors_in_one_line, one_line
from tire_pipeline.pages.visible_text import visible


@click.group(name="tire_pipeline")
def cli() -> None:
    """Command line of the project."""


def _run(**options: Any) -> Any:
    if options.get("pipeline") and not options.get("pipelines"):
        options["pipelines"], options["pipeline"] = [options["pipeline"]], None
    with errors_in_one_line():
        _check_names(options.get("pipelines") or ())
        click.echo("starting: loading the pipelines", err=True)
        run_of_kedro: Any = kedro_run.callback
        return run_of_kedro(**options)


def _check_names(asked: Sequence[str]) -> None:
    """A misspelt pipeline is an error of one line, not an import that failed somewhere in Kedro."""
    known = sorted(module.name for module in pkgutil.iter_modules(pipelines.__path__) if module.ispkg)
    for name in asked:
        if name not in (*known, "__default__"):
            all_of_them = f"there are {', '.join(known)}"
            near = did_you_mean(name, known, "")
            raise DomainError(f"there is no pipeline {name!r}", todo=f"{near} {all_of_them}".strip())


class _RunCommand(click.Command):
    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Say in one line, too, that a value of ``--params`` cannot be read."""
        try:
            return super().parse_args(ctx, args)
        except YAMLError as error:
            what = visible(one_line(error) or "")
            raise click.BadParameter(what, ctx=ctx, param_hint="--params") from error


run = _RunCommand("run", params=kedro_run.params, callback=_run, help="Run one pipeline, or all eight.")
cli.add_command(run)
