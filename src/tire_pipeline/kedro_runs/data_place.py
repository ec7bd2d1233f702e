"""Where the run's data lies: a folder, or below an address of an object store."""

from __future__ import annotations

import glob
from pathlib import Path
from typing import Any

from tire_pipeline.errors import DomainError
from tire_pipeline.files.objects import Objects, is_remote


def data_place(context: Any) -> Path | Objects:
    """The ``data`` of the configuration.

    Parameters
    ----------
    context : kedro.framework.context.KedroContext

    Raises
    ------
    DomainError
        It is no text, or its name reads as a pattern: the versions in it would never be found again.
    """
    data = context.config_loader["globals"].get("data", "data")
    if not isinstance(data, str):
        raise DomainError(
            f"`data` is {data!r}, which is no path",
            where="conf/*/globals.yml",
            todo="write a folder or an address, in quotes if it is a number",
        )
    place = Objects(data) if is_remote(data) else Path(context.project_path) / data
    if glob.has_magic(str(place)):
        raise DomainError(
            "the path of the data folder holds *, ? or [, which reads as a pattern for other names",
            where=str(place),
            todo="rename that folder, or set another `data` in conf/local/globals.yml",
        )
    return place
