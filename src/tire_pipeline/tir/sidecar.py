"""Corrections that a ``.tir`` file cannot hold, kept in a JSON file beside it.

``tire.tir`` has its corrections in ``tire.tir.sidecar.json``::

    {
      "format": "tire-pipeline sidecar",
      "format_version": 1,
      "effects": {"temperature": {"parameters": {"reference": 60.0, "slope": -0.004}}}
    }

``effects`` maps an effect's name to whatever that effect wrote; nothing in it is code, and reading checks
only that it is JSON of that form.
"""

from __future__ import annotations

import errno
import json
import os
from collections.abc import Mapping
from pathlib import Path

from tire_pipeline.errors import TirError, TirSyntaxError
from tire_pipeline.files.atomic import write_bytes
from tire_pipeline.files.regular_file import open_regular

SUFFIX = ".sidecar.json"
SIDECAR_FORMAT = "tire-pipeline sidecar"
FORMAT_VERSION = 1
MOST_SIDECAR_BYTES = 1_000_000
_TODO_FOR_SIDECAR = "write it again, or move it away to read the .tir alone"


def sidecar_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of a ``.tir`` file's sidecar.

    Examples
    --------
    >>> sidecar_path("a/tire.tir").name
    'tire.tir.sidecar.json'
    """
    return Path(os.fspath(path) + SUFFIX)


def read_sidecar(path: str | os.PathLike[str]) -> dict[str, dict[str, object]] | None:
    """Return ``{effect: what it wrote}`` for a ``.tir`` file, or None if it has no sidecar.

    Parameters
    ----------
    path : path
        Of the ``.tir`` file, not of the sidecar.

    Returns
    -------
    dict of str to dict, or None
        Effect -> its equation, source and parameters, SI units.

    Raises
    ------
    TirSyntaxError
        It is larger than 1 MB, not JSON, or of another form.

    See Also
    --------
    write_sidecar : The way there.
    read_tir : Puts it into ``metadata["sidecar"]``.

    Notes
    -----
    The form of the file: docs/reference/tir_format.md.

    Examples
    --------
    >>> _ = write_sidecar("tire.tir", {"wear": {"rate": 1e-9}})
    >>> read_sidecar("tire.tir")
    {'wear': {'rate': 1e-09}}
    """
    file = sidecar_path(path)
    try:
        with open_regular(file) as stream:
            data = stream.read(MOST_SIDECAR_BYTES + 1)
    except FileNotFoundError:
        return None
    except (OSError, ValueError) as error:
        if getattr(error, "errno", None) == errno.ENAMETOOLONG:  # no file can have that name
            return None
        raise TirError(
            f"the sidecar cannot be read: {getattr(error, 'strerror', None) or error}",
            path=str(file),
            todo=_TODO_FOR_SIDECAR,
        ) from error
    if len(data) > MOST_SIDECAR_BYTES:
        raise _wrong(file, "is larger than 1 MB")
    try:
        content = json.loads(data, parse_constant=_no_constant)
    except (ValueError, RecursionError) as error:
        raise _wrong(file, f"is not JSON ({type(error).__name__})") from error
    if not isinstance(content, dict) or content.get("format") != SIDECAR_FORMAT:
        raise _wrong(file, f"is not a {SIDECAR_FORMAT!r}")
    if content.get("format_version") != FORMAT_VERSION:
        raise _wrong(file, f"has a format_version other than {FORMAT_VERSION}")
    effects = content.get("effects")
    if not isinstance(effects, dict) or not all(isinstance(each, dict) for each in effects.values()):
        raise _wrong(file, "has no 'effects' that maps names to objects")
    return effects


def write_sidecar(path: str | os.PathLike[str], effects: Mapping[str, Mapping[str, object]]) -> Path:
    """Write the corrections of a ``.tir`` file beside it, all or nothing; return the sidecar's path.

    Parameters
    ----------
    path : path
        Of the ``.tir`` file.
    effects : mapping
        Effect -> what it needs, as JSON can hold it; numbers finite, in SI units.

    Returns
    -------
    Path
        Of the sidecar.

    Raises
    ------
    TirError
        Something in it is not JSON.

    See Also
    --------
    read_sidecar : The way back.

    Notes
    -----
    The form of the file: docs/reference/tir_format.md.

    Examples
    --------
    >>> write_sidecar("tire.tir", {"wear": {"rate": 1e-9}}).name
    'tire.tir.sidecar.json'
    """
    file = sidecar_path(path)
    content = {"format": SIDECAR_FORMAT, "format_version": FORMAT_VERSION, "effects": effects}
    try:
        text = json.dumps(content, indent=1, allow_nan=False, default=_plain)
    except (TypeError, ValueError, RecursionError) as error:
        raise TirError(f"the corrections do not fit JSON: {error}", path=str(file)) from error
    write_bytes(file, text.encode())
    return file


def _plain(value: object) -> object:
    if isinstance(value, Mapping):
        return dict(value)
    item = getattr(value, "tolist", None)
    if item is None:
        raise TypeError(f"{type(value).__name__} is not a JSON value")
    return item()


def _no_constant(name: str) -> object:
    raise ValueError(f"{name} is not a JSON number")


def _wrong(file: Path, what: str) -> TirSyntaxError:
    return TirSyntaxError(f"the sidecar {what}", path=str(file), todo=_TODO_FOR_SIDECAR)
