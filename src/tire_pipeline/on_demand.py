"""Import a name only when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
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


def names_on_demand(package: str, module_of: Mapping[str, str]) -> Callable[[str], Any]:
    """Return the ``__getattr__`` of a package.

    Parameters
    ----------
    package : str
        Its name, ``__name__``.
    module_of : mapping of str to str
        Public name -> the module that has it, below the package.
    """

    def __getattr__(name: str) -> Any:
        if name in module_of:
            return getattr(import_module(f"{package}.{module_of[name]}"), name)
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return __getattr__
