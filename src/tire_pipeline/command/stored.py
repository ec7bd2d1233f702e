"""Fitted translators as the pipelines store them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tire_pipeline.errors import DomainError
from tire_pipeline.files.state_files import is_state, unpack_state

NAME = "translator.npz"
"""The translator's name where a folder holds other models, too."""


def stored_state(path: Path) -> tuple[dict[str, Any], Path]:
    """Read a state from a file, a versioned folder or a folder of releases.

    Parameters
    ----------
    path : Path
        ``x.npz``; or ``x.npz/`` with one folder a version, of which the newest is taken; or a folder with
        ``record.json`` and ``models/``, of which the model in use is taken; or a folder with
        ``translator.npz`` or a single ``.npz``.

    Returns
    -------
    state : dict
    file : Path
        The file that was read.

    Raises
    ------
    DomainError
        There is none, it is no model, or it is damaged.
    """
    file = _file(path)
    try:
        content = file.read_bytes()
    except OSError as error:
        raise DomainError(f"the model cannot be read: {error.strerror}", where=str(file)) from error
    if not is_state(content):
        raise DomainError(
            "this is no fitted model", where=str(file), todo=f"give one, such as data/06_models/{NAME}"
        )
    return unpack_state(content, where=str(file)), file


def translator_state(path: Path) -> tuple[Mapping[str, Any], Path]:
    """Read the state of a translator, be it the whole state or a part of it named ``translator``."""
    state, file = stored_state(path)
    inner = state.get("translator")
    if isinstance(inner, str):
        return state, file
    if isinstance(inner, Mapping) and isinstance(inner.get("translator"), str):
        load = {"nominal_load": state["nominal_load"]} if "nominal_load" in state else {}
        return {**inner, **load}, file
    raise DomainError(
        "this model is not a translator", where=str(file), todo="give the folder of a fitted translator"
    )


def no_translator(project: Path) -> DomainError:
    """Return the error of a call without a translator: where one is, or which command makes one.

    Parameters
    ----------
    project : Path
        A folder in which pipelines may have been run.
    """
    places = (f"data/06_models/{NAME}", f"data/*/06_models/{NAME}", "data/06_models/released")
    found = [each for place in places for each in sorted(project.glob(place))]
    if found:
        several = f" (or {', '.join(map(str, found[1:]))})" if len(found) > 1 else ""
        todo = f"add --model {found[0]}{several}"
    else:
        todo = (
            "make one from the files of several suppliers by `kedro run --pipeline translate` in the "
            f"project (docs/tutorials/your_supplier_files.md), then add --model data/06_models/{NAME}"
        )
    return DomainError("no translator is given", todo=todo)


def _file(path: Path) -> Path:
    if path.is_file():
        return path
    if not path.is_dir():
        beside = [path.parent / NAME] if (path.parent / NAME).exists() else sorted(path.parent.glob("*.npz"))
        todo = f"did you mean {beside[0]}?" if beside else "fit one with `kedro run`"
        raise DomainError("there is no such model", where=str(path), todo=todo)
    record = path / "record.json"
    if record.is_file():
        return path / "models" / f"{_current(record)}.npz"
    versions = sorted(each for each in path.glob(f"*/{path.name}") if each.is_file())
    if versions:
        return versions[-1]
    named = path / NAME
    files = [named] if named.exists() else sorted(path.glob("*.npz"))
    if len(files) == 1:
        return _file(files[0])
    names = ", ".join(each.name for each in files)
    raise DomainError(
        f"which model is meant is not clear: {names}" if files else "there is no model in this folder",
        where=str(path),
        todo="give the model's file, or its versioned folder",
    )


def _current(record: Path) -> str:
    try:
        models = json.loads(record.read_text(encoding="utf-8"))["models"]
        name = str(models[-1])
    except (ValueError, KeyError, IndexError, TypeError) as error:
        raise DomainError("no model is in use", where=str(record), todo="release one first") from error
    if Path(name).name != name:
        raise DomainError("the record of released models is damaged", where=str(record))
    return name
