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
        Its name reads as a pattern: the versions in it would never be found again.
    """
    data = context.config_loader["globals"].get("data", "data")
    place = Objects(str(data)) if is_remote(data) else Path(context.project_path) / data
    if glob.has_magic(str(place)):
        raise DomainError(
            "the path of the data folder holds *, ? or [, which reads as a pattern for other names",
            where=str(place),
            todo="rename that folder, or set another `data` in conf/local/globals.yml",
        )
    return place
