"""File names as text that can be stored, printed and turned back into the name on the disk."""

from __future__ import annotations

import os
import re

NAMED_ONCE = "file_named_once"
"""Attribute of a record in the log: the file or link that it names, which a run names once."""
_ODD = re.compile(r"[\udc80-\udcff]|[\x00-\x1f\x7f]|\\(?=x[0-9a-f]{2})")
_ASCII_CONTROL = re.compile(r"[\x00-\x1f\x7f]")
_NOT_UTF8 = re.compile(r"[\udc80-\udcff]")
_ESCAPED_BYTE = re.compile(rb"\\x([0-9a-f]{2})")


def shown_name(name: str) -> str:
    r"""Escape what is not UTF-8 in a file's name, and control characters, as ``\xNN``.

    All other names stay as they are. A backslash is escaped only where it would read as an escape.

    Parameters
    ----------
    name : str
        As Python's ``os`` functions give it. Also for messages that quote such a name.

    Returns
    -------
    str
        Can be written as UTF-8. :func:`name_on_disk` turns it back.

    Examples
    --------
    >>> shown_name(os.fsdecode(b"M\xfcnchen.tir"))
    'M\\xfcnchen.tir'
    """
    return _ODD.sub(lambda found: f"\\x{_byte(found[0]):02x}", name)


def name_on_disk(shown: str) -> str:
    r"""What :func:`shown_name` was given.

    Examples
    --------
    >>> os.fsencode(name_on_disk("M\\xfcnchen.tir"))
    b'M\xfcnchen.tir'
    """
    if "\\x" not in shown:
        return shown
    return os.fsdecode(_ESCAPED_BYTE.sub(lambda found: bytes([int(found[1], 16)]), shown.encode()))


def path_of(folder: str | os.PathLike[str], shown: str) -> str:
    """The path of a file below a folder by its shown name; for a million files a ``Path`` takes its time."""
    return os.path.join(folder, name_on_disk(shown))


def printable(text: str) -> str:
    """A text that may quote names as they are on the disk, so that it can be written as UTF-8."""
    return _NOT_UTF8.sub(lambda found: f"\\x{_byte(found[0]):02x}", text)


def printable_name(name: str) -> str:
    r"""A name or place, as it is on the disk or shown already, so that it stays in its line of a message.

    Examples
    --------
    >>> printable_name("a\nerror: b.tir")
    'a\\x0aerror: b.tir'
    """
    return printable(_ASCII_CONTROL.sub(lambda found: f"\\x{ord(found[0]):02x}", name))


def _byte(character: str) -> int:
    code = ord(character)
    return code - 0xDC00 if code >= 0xDC80 else code
