"""Import a class only when it is asked for by its name."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any

from tire_pipeline.errors import DomainError


def class_by_name(classes: Mapping[str, tuple[str, str]], name: str, what: str) -> Any:
    """Import a class.

    Parameters
    ----------
    classes : mapping
        Name -> module and class.
    name : str
    what : str
        What the classes are, in one word, for the error.

    Raises
    ------
    DomainError
        If there is none of that name.
    """
    if name not in classes:
        raise DomainError(f"there is no {what} {name!r}", todo=f"choose one of {', '.join(classes)}")
    module, cls = classes[name]
    return getattr(import_module(module), cls)
