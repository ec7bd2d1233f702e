"""The command ``tire``: its subcommands are imported when one is called, errors fit in a line."""

from __future__ import annotations

import difflib
import sys
import warnings
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from tire_pipeline.errors import TirePipelineError, system_advice
from tire_pipeline.pages.visible_text import visible

WRONG_INPUT = 2
"""Exit code for what the user can put right; click uses it for wrong options, too."""

COMMANDS = {
    "show": "What a .tir file holds: version, ranges, key figures, what is missing.",
    "compare": "Two .tir files beside each other: key figures, forces, coefficients.",
    "fit": "Fit a tire model to recordings and write it as a .tir file.",
    "explain": "Where a .tir file and recordings of the tire differ, and why.",
    "convert": "Write a .tir file as another version of the Magic Formula.",
    "translate": "Write a .tir file as another organisation would have measured the tire.",
    "check": "What a recording holds, and what is wrong with it.",
}
"""Subcommand -> its line in the help. Each is ``command`` in the module of that name."""


class OnDemand(click.Group):
    """A group that knows its subcommands' names and imports the one that is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import a subcommand."""
        if cmd_name not in COMMANDS:
            return None
        command: click.Command = import_module(f"tire_pipeline.command.{cmd_name}").command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Say which subcommand may have been meant."""
        near = difflib.get_close_matches(args[0], COMMANDS, n=1)
        if args[0] not in COMMANDS and not args[0].startswith("-"):
            meant = f" Did you mean {near[0]!r}?" if near else f" Use one of {', '.join(COMMANDS)}."
            ctx.fail(f"No such command {args[0]!r}.{meant}")
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the subcommands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def invoke(self, ctx: click.Context) -> Any:
        """Run a subcommand; what the user can put right is one line and exit code 2."""
        from tire_pipeline.progress import under_way  # not needed by the help

        given = list(ctx.args)
        try:
            with warnings.catch_warnings(), under_way("tire", lambda: ctx.invoked_subcommand or ""):
                warnings.showwarning = WarningsInOneLine()
                return super().invoke(ctx)
        except TirePipelineError as error:
            _fail(str(error))
        except OSError as error:
            advice = system_advice(error) or (error.filename and f"{error.filename}: {error.strerror}")
            if not advice:
                raise
            _fail(advice)
        except click.NoSuchOption as error:
            files = [each for each in given if each.startswith("-") and Path(each).exists()]
            if not files:
                raise
            said = f"{error.message} A file whose name begins with - is given as ./{files[0]}"
            raise click.UsageError(said, ctx=error.ctx) from error


def _fail(text: str) -> None:
    click.secho(f"error: {_one_line(text)}", fg="red", err=True)
    sys.exit(WRONG_INPUT)


def _one_line(text: str) -> str:
    return " | ".join(visible(text).split("\n"))


class WarningsInOneLine:
    """Shows each warning once, as a line on standard error."""

    def __init__(self) -> None:
        self._shown: set[str] = set()

    def __call__(self, message: Warning | str, *_: Any, **__: Any) -> None:
        """Show a warning, in place of ``warnings.showwarning``."""
        if str(message) not in self._shown:
            self._shown.add(str(message))
            click.echo(f"warning: {_one_line(str(message))}", err=True)


@click.group(name="tire", cls=OnDemand, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="tire-pipeline", message="tire-pipeline %(version)s")
def tire() -> None:
    """Ask about one tire file or recording.

    Every command prints a short result and writes a page (HTML, opens without a network). With --json it
    prints JSON instead. Input files are never changed.
    """


def main() -> None:
    """Run the command line."""
    tire(prog_name="tire")
