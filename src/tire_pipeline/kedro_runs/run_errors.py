"""Turns what can go wrong in a run into one line that says what to do."""

from __future__ import annotations

import contextlib
import re
import sys
from collections.abc import Iterator

import click
from kedro.config import MissingConfigException
from kedro.io import DatasetError
from kedro.validation import ParameterValidationError
from omegaconf.errors import OmegaConfBaseException
from yaml import YAMLError

from tire_pipeline.errors import TirePipelineError, chain, system_advice
from tire_pipeline.pages.visible_text import visible

_NO_PROJECT = "Could not find the project configuration file"
_LINK = re.compile(r"\s*For further information visit https?://\S+")
_ERROR_SECTION = re.compile(
    r"- Parameter '(\w+)': Failed to instantiate .* validation errors? for \w+$", re.MULTILINE
)
_GIVEN = re.compile(r"\s*\[type=(\w+), input_value=(.*), input_type=\w+\]$")


@contextlib.contextmanager
def errors_in_one_line() -> Iterator[None]:
    """End the process with one line on standard error and exit code 1 where one line helps."""
    try:
        yield
    except Exception as error:
        line = one_line(error)
        if line is None:
            raise
        click.secho(f"error: {visible(line)}", fg="red", err=True)
        sys.exit(1)


def one_line(error: BaseException) -> str | None:
    """One line for the user, or None where only the whole traceback helps.

    Parameters
    ----------
    error : BaseException
        What ended the run.

    Returns
    -------
    str or None
        Names the node where it is known, what is wrong, and what to do.
    """
    errors = chain(error)
    notes = [note for each in errors for note in getattr(each, "__notes__", [])]
    prefix = f"{notes[0]}: " if notes else ""
    text: str | None = None
    for each in errors:
        if isinstance(each, TirePipelineError):
            text = str(each)
            break
        if isinstance(each, OSError) and (advice := system_advice(each)):
            text = advice
            break
        if isinstance(each, MissingConfigException):
            todo = "run it in the project's folder, whose path must not hold *, ? or ["
            text = f"{each} -> {todo}; correct --conf-source if you gave one"
            break
        if isinstance(each, YAMLError | OmegaConfBaseException):
            text = f"{each} -> correct it in conf or --params"
            break
        if isinstance(each, ValueError) and str(each).startswith("Pipeline does not contain"):
            text = f"{each} -> `kedro registry describe PIPELINE` lists the nodes of a pipeline"
            break
        if isinstance(each, RuntimeError) and str(each).startswith(_NO_PROJECT):
            text = f"{str(each).partition('. ')[0]} -> run it in the project's folder"
            break
        if isinstance(each, ParameterValidationError):
            text = f"{wrong_parameters(str(each))} -> correct it in conf/base/parameters or --params"
            break
    if text is None:
        outermost = next((each for each in errors if isinstance(each, DatasetError)), None)
        if outermost is None:
            return None
        text = _missing(str(outermost))
    return re.sub(r"\s*\n\s*", " | ", f"{prefix}{text}".strip())


def wrong_parameters(text: str) -> str:
    """Say which parameters are wrong, and how, from what Kedro and pydantic say of their models.

    Examples
    --------
    >>> wrong_parameters(
    ...     "Parameter validation failed:\\n- Parameter 'translate': Failed to instantiate T for parameter "
    ...     "'translate': 1 validation error for T\\nfarthest\\n"
    ...     "  Input should be greater than 0 [type=greater_than, input_value=-1, input_type=int]"
    ... )
    'translate.farthest: Input should be greater than 0 (given: -1)'
    """
    _, *sections = _ERROR_SECTION.split(_LINK.sub("", text))
    if not sections:
        return text
    said = []
    for name, body in zip(sections[::2], sections[1::2], strict=True):
        field = ""
        for line in body.strip("\n").splitlines():
            if not line.startswith(" "):
                field = f".{line}"
                continue
            given = _GIVEN.search(line)
            value = f" (given: {given[2]})" if given and given[1] != "value_error" else ""
            message = _GIVEN.sub("", line).strip().removeprefix("Value error, ")
            said.append(f"{name}{field}: {message}{value}")
    return "; ".join(said)


def _missing(text: str) -> str:
    """Say of a dataset that no run has made yet what to run first; other texts stay as they are."""
    found = re.match(r"(.*)Did not find any versions for .*?filepath=\w+\('([^']+)'\)", text, re.DOTALL)
    if found is None:
        return text
    name, path = found.groups()
    return (
        f"{name}{path} is not there yet -> first run the pipeline that makes it: `kedro run` runs the eight "
        "pipelines in order (use the same --env and --params)"
    )
