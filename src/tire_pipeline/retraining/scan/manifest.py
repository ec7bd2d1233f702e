"""Which content of which file is in the table: hashes, not names and not dates."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import astuple, dataclass, field, replace
from typing import Any, Self

from tire_pipeline.errors import DomainError
from tire_pipeline.retraining.scan.places import Look

MANIFEST_FORMAT = 1
_BEFORE_ENTRIES = b',"files":{'
_DECODE = json.JSONDecoder().raw_decode
ENTRIES_TOGETHER = 1_000
"""So many entries are written together."""


@dataclass(frozen=True, slots=True)
class ManifestEntry:
    """One file as it was last looked at.

    Attributes
    ----------
    sha256 : str
        Of the content, together with its sidecar's.
    row_sha256 : str
        Of the content that the table's row was read from; empty if the table has no row of this file.
    size, mtime_ns, ctime_ns, stamp
        As in :class:`.places.Look`. If all are as before, the content is taken as unchanged and not read.
    sequence : int
        The store's sequence number when the row was read.
    reason : str
        Why the present content could not be read.
    """

    sha256: str
    row_sha256: str
    size: int
    mtime_ns: int
    ctime_ns: int
    sequence: int
    reason: str = ""
    stamp: str = ""

    @classmethod
    def of(cls, look: Look, sha256: str, row_sha256: str, sequence: int, reason: str = "") -> Self:
        """A file that was looked at, by the fields."""
        seen = (look.size, look.mtime_ns, look.ctime_ns)
        return cls(sha256, row_sha256, *seen, sequence, reason, look.stamp)

    @property
    def look(self) -> Look:
        """What was told of it without reading it."""
        return Look(self.size, self.mtime_ns, self.ctime_ns, self.stamp)

    @property
    def pending(self) -> bool:
        """The present content could not be read; it is tried again when it changes."""
        return self.row_sha256 != self.sha256


@dataclass(frozen=True)
class Manifest:
    """All files that were looked at.

    Attributes
    ----------
    sequence : int
        Grows by one with every change of the table.
    files : mapping
        Path relative to the folder -> :class:`ManifestEntry`.
    revision : int
        Grows by one each time it is stored; tells two runs at once apart.
    """

    sequence: int = 0
    files: Mapping[str, ManifestEntry] = field(default_factory=dict)
    revision: int = 0

    @property
    def digest(self) -> str:
        """One hash for the table's content: equal if and only if the same contents were read."""
        total = hashlib.sha256()
        for name in sorted(self.files):
            if self.files[name].row_sha256:
                total.update(f"{name}\0{self.files[name].row_sha256}\n".encode())
        return total.hexdigest()

    def read_after(self, sequence: int) -> list[str]:
        """Files whose rows were read after the store had this sequence number."""
        return sorted(
            name for name, entry in self.files.items() if entry.row_sha256 and entry.sequence > sequence
        )

    def to_json(self, **more: object) -> bytes:
        """Bytes of the manifest; ``more`` goes beside it."""
        numbers = {"format": MANIFEST_FORMAT, "sequence": self.sequence, "revision": self.revision}
        return b"".join([_compact({**numbers, **more})[:-1], *self._files_in_json(), b"}"])

    def is_in(self, content: bytes) -> bool:
        """Whether :meth:`to_json` of this manifest wrote it, whatever goes beside; no entry is read."""
        at = content.find(_BEFORE_ENTRIES)
        if self.without_files(content) != replace(self, files={}):
            return False
        for piece in self._files_in_json():
            if content[at : at + len(piece)] != piece:
                return False
            at += len(piece)
        return content[at:] == b"}"

    def _files_in_json(self) -> Iterator[bytes]:
        """The entries in pieces, sorted by name."""
        yield _BEFORE_ENTRIES
        names = sorted(self.files)
        for start in range(0, len(names), ENTRIES_TOGETHER):
            some = {name: astuple(self.files[name]) for name in names[start : start + ENTRIES_TOGETHER]}
            yield (b"," if start else b"") + _compact(some)[1:-1]
        yield b"}"

    @classmethod
    def from_json(cls, content: bytes, where: str = "manifest") -> tuple[Manifest, dict[str, object]]:
        """What :meth:`to_json` wrote, and what went beside it.

        Raises
        ------
        DomainError
            It is damaged.
        """
        try:
            data, files = _parted(content)
            return cls(int(data.pop("sequence")), files, int(data.pop("revision"))), data
        except (ValueError, LookupError, TypeError, AttributeError) as error:
            raise DomainError(
                "the manifest of files is damaged",
                where=where,
                todo="delete its folder: the next run reads all files again",
            ) from error

    @classmethod
    def without_files(cls, content: bytes, where: str = "manifest") -> Manifest:
        """The numbers of what :meth:`to_json` wrote, but none of its entries.

        Raises
        ------
        DomainError
            It is damaged, as far as it is read.
        """
        found = content.find(_BEFORE_ENTRIES)
        return cls.from_json(content if found < 0 else content[:found] + _BEFORE_ENTRIES + b"}}", where)[0]


def _parted(content: bytes) -> tuple[dict[str, Any], dict[str, ManifestEntry]]:
    """What stands beside the entries, and the entries, which are read one after the other."""
    text, files = content.decode(), dict[str, ManifestEntry]()
    at = text.find(_BEFORE_ENTRIES.decode())
    if at >= 0:
        data, at = json.loads(text[:at] + "}"), at + len(_BEFORE_ENTRIES)
        while text[at] != "}":
            name, at = _DECODE(text, at)
            if text[at] != ":":
                raise ValueError(name)
            values, at = _DECODE(text, at + 1)
            files[str(name)] = _entry(*values)
            at += text[at] == ","
        if text[at:] != "}}":
            raise ValueError("end")
    else:  # written by another hand
        data = json.loads(text)
        files = {str(name): _entry(*values) for name, values in data.pop("files").items()}
    if data.pop("format") != MANIFEST_FORMAT:
        raise ValueError("format")
    return data, files


def _entry(sha256: str, row_sha256: str, *others: Any) -> ManifestEntry:
    """An entry that holds one text where both hashes are the same."""
    return ManifestEntry(sha256, sha256 if row_sha256 == sha256 else row_sha256, *others)


def _compact(value: Any) -> bytes:
    return json.dumps(value, separators=(",", ":")).encode()
