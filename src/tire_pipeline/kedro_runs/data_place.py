"""Where the run's data lies: a folder, or below an address of an object store."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tire_pipeline.files.objects import Objects, is_remote


def data_place(context: Any) -> Path | Objects:
    """The ``data`` of the configuration.

    Parameters
    ----------
    context : kedro.framework.context.KedroContext
    """
    data = context.config_loader["globals"].get("data", "data")
    return Objects(str(data)) if is_remote(data) else Path(context.project_path) / data
