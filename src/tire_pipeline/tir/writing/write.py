"""Write a tire model as a ``.tir`` file."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from tire_pipeline.errors import TirError
from tire_pipeline.files.atomic import write_bytes
from tire_pipeline.magic_formula.changes.convert import to_version
from tire_pipeline.magic_formula.model import TireModel
from tire_pipeline.tir.sidecar import sidecar_path, write_sidecar
from tire_pipeline.tir.text.document import TirFile
from tire_pipeline.tir.writing.edits import edited_source
from tire_pipeline.tir.writing.fresh import fresh_text


def write_tir(
    model: TireModel,
    path: str | os.PathLike[str],
    *,
    comments: str | Iterable[str] | None = None,
    version: str | None = None,
    overwrite: bool = False,
    complete: bool | None = None,
    digits: int | None = None,
) -> Path:
    """Write a model as a tire property file, all or nothing.

    A model that was read from a file keeps that file's order, comments, tables, line ends, units and
    encoding; a value that was not changed keeps its printed digits, and a changed one is written with enough
    digits to reproduce it exactly. A model without a file gets a new one in SI units, with the standard
    sections.

    Parameters
    ----------
    model : TireModel
        Read from a file, fitted or built.
    path : str or path
        Of the file to write.
    comments : str or sequence of str, optional
        Comment lines to add at the top. Control characters, brackets and ``$`` in them are replaced.
    version : str, optional
        Write it as another version (:func:`tire_pipeline.magic_formula.changes.convert.to_version`).
    overwrite : bool
        Replace an existing file, even the model's own source.
    complete : bool, optional
        Whether to write the defaults of coefficients that the model lacks (``defaulted``), each with a
        comment that says so. By default only where there is no source file: other tools expect all keys.
    digits : int, optional
        Significant digits of coefficients that were changed, such as 9 for computed ones.
        By default as many as reproduce the model's value exactly.

    Returns
    -------
    Path
        The file written. Corrections in ``metadata["sidecar"]`` go beside it (:mod:`.sidecar`).

    Raises
    ------
    TirError
        A file of that name, or its sidecar, exists and ``overwrite`` is False.
    TirVersionError
        The model cannot be written as that version.
    OSError
        The folder is absent or may not be written, the disk is full. No part of a file is left then.

    See Also
    --------
    tir_bytes : The content alone.
    read_tir : The way back.

    Notes
    -----
    The form of the file: docs/reference/tir_format.md.

    Examples
    --------
    >>> from tire_pipeline.tir import read_tir
    >>> written = write_tir(read_tir("tire.tir").replace(PDY1=1.05), "softer.tir")
    >>> read_tir(written).value("PDY1")
    1.05
    """
    target = Path(path)
    if version is not None:
        model = to_version(model, version)
    sidecar = model.metadata.get("sidecar")
    beside = sidecar_path(target)
    for file, what in ((beside, "there are corrections for"), (target, "there is")):
        if file.exists() and not overwrite:
            todo = "choose another name, or pass overwrite=True"
            raise TirError(f"{what} a file of that name", path=str(file), todo=todo)
    write_bytes(target, tir_bytes(model, comments=comments, complete=complete, digits=digits))
    if isinstance(sidecar, Mapping) and sidecar:
        write_sidecar(target, sidecar)
    else:
        beside.unlink(missing_ok=True)
    return target


def tir_bytes(
    model: TireModel,
    *,
    comments: str | Iterable[str] | None = None,
    complete: bool | None = None,
    digits: int | None = None,
) -> bytes:
    """Return the content that :func:`write_tir` writes.

    Parameters
    ----------
    model : TireModel
        Read from a file, fitted or built.
    comments, complete, digits
        As for :func:`write_tir`.

    Returns
    -------
    bytes
        In the encoding of the file that the model came from, else UTF-8.

    Raises
    ------
    TirVersionError
        The model cannot be written.

    See Also
    --------
    write_tir : Write it as a file, all or nothing.

    Notes
    -----
    The form of the file: docs/reference/tir_format.md.

    Examples
    --------
    >>> from tire_pipeline.tir import read_tir
    >>> tir_bytes(read_tir("tire.tir")) == open("tire.tir", "rb").read()
    True
    """
    lines = [comments] if isinstance(comments, str) else list(comments or ())
    if isinstance(model.source, TirFile):
        edited = edited_source(model, model.source, lines, complete=bool(complete), digits=digits)
        return edited.to_bytes()
    return fresh_text(model, lines, complete=complete is not False, digits=digits).encode("utf-8")
