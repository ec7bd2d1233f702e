"""Which of the user's files are translated: all, or those that were asked for."""

from __future__ import annotations

from collections.abc import Callable
from fnmatch import fnmatch
from itertools import islice

from tire_pipeline.errors import DomainError, did_you_mean
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tire_table.read_blocks import TireFiles
from tire_pipeline.translation.parameters import TranslateParameters


def choose_files(
    files_to_translate: TireFiles, parameters: TranslateParameters
) -> dict[str, Callable[[], TireModel]]:
    """Choose files by their path, one of its folders, or a pattern; none is read.

    Parameters
    ----------
    files_to_translate : mapping
        ``category/.../name.tir`` to the function that reads it.
    parameters : TranslateParameters
        ``only`` holds paths, folders and patterns (none: all files), ``trials`` the most files.

    Raises
    ------
    DomainError
        One of ``only`` matches no file.
    """
    only = parameters.only
    for pattern in only:
        if not any(_matches(file, pattern) for file in files_to_translate):
            folders = sorted({file.rpartition("/")[0] for file in files_to_translate if "/" in file})
            raise DomainError(
                f"only = {pattern!r} matches none of {len(files_to_translate)} files",
                where="translate",
                todo=did_you_mean(
                    pattern, [*folders, *files_to_translate], f"suppliers are {', '.join(folders[:20])}"
                ),
            )
    chosen = (
        (file, load)
        for file, load in files_to_translate.items()
        if not only or any(_matches(file, pattern) for pattern in only)
    )
    return dict(islice(chosen, parameters.trials or None))


def _matches(file: str, pattern: str) -> bool:
    *folders, name = file.split("/")
    return pattern in folders or fnmatch(file, pattern) or fnmatch(name, pattern)
