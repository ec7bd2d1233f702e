"""An environment that is not there, or from which nothing is read, is an error with the nearest name."""

from __future__ import annotations

import glob
from pathlib import Path

from kedro.config import OmegaConfigLoader

from tire_pipeline.errors import DomainError, did_you_mean

_CONFIGURATION_SUFFIXES = {".yml", ".yaml", ".json"}


def check_environment(loader: OmegaConfigLoader) -> None:
    """Refuse ``--env`` (or ``KEDRO_ENV``) of another name than the folders of the configuration have.

    The folder that is read if none is asked for may be empty.

    Raises
    ------
    DomainError
        There is no such folder, or no file in it that is read; it names the nearest one and those there are.
    """
    conf = Path(loader.conf_source)
    if not loader.env or not conf.is_dir():
        return
    there = [each.name for each in sorted(conf.iterdir()) if each.is_dir() and _is_read(loader, each)]
    if loader.env in (*there, loader.default_run_env):
        return
    is_empty = loader.env in {each.name for each in conf.iterdir() if each.is_dir()}
    near = did_you_mean(loader.env, there, "")
    raise DomainError(
        f"the environment {loader.env!r} is empty: no file in it is read"
        if is_empty
        else f"there is no environment {loader.env!r}",
        where=str(conf / loader.env) if is_empty else "--env",
        todo=f"{near} there are {', '.join(there)}".strip(),
    )


def _is_read(loader: OmegaConfigLoader, folder: Path) -> bool:
    """Whether any file below a folder bears a name that the loader looks for."""
    patterns = (pattern for each in loader.config_patterns.values() for pattern in each)
    found = (name for p in patterns for name in glob.iglob(p, root_dir=folder, recursive=True))
    return any(Path(name).suffix in _CONFIGURATION_SUFFIXES for name in found)
