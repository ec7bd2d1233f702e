"""A folder of texts in an object store, where files change one by one.

The marker says what the folder holds. It is replaced by one that says *being written* before anything else
changes, and by the new one after all else has: what a killed run leaves is never taken for results.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

from tire_pipeline.errors import DomainError
from tire_pipeline.files.objects import Objects
from tire_pipeline.progress import track

MARKER = ".made_by_tire_pipeline"
MARKER_HEAD = "Replaced as a whole on the next run. Made:"
_WRITTEN_TOGETHER = 50
NEVER_DELETED = (".gitkeep", "README.md")
_BROKEN = "Being written. Nothing here counts until that is done. Of this project:"
Content = str | bytes | Callable[[], bytes]


@dataclass(frozen=True, eq=False)
class StoredTexts(Mapping[str, bytes]):
    """Texts by name, each read when it is asked for: they are never in memory together.

    Attributes
    ----------
    read : mapping
        Name -> the function that reads the text.
    """

    read: Mapping[str, Callable[[], bytes]]

    def __getitem__(self, name: str) -> bytes:
        """One text."""
        return self.read[name]()

    def __iter__(self) -> Iterator[str]:
        """The names."""
        return iter(self.read)

    def __len__(self) -> int:
        return len(self.read)


def as_bytes(content: Content) -> bytes:
    """A text, or what the function gives, as bytes."""
    if callable(content):
        return content()
    return content if isinstance(content, bytes) else content.encode("utf-8")


def parted(data: Mapping[str, Content | None], *, keep: bool) -> tuple[dict[str, Content], set[str]]:
    """Texts to write, and names of those to take away.

    Raises
    ------
    TypeError
        A text is None, and none is kept that it could take away.
    """
    gone = {name for name, text in data.items() if text is None}
    if gone and not keep:
        raise TypeError(f"there is nothing to encode for {min(gone)!r}")
    return {name: text for name, text in data.items() if text is not None}, gone


def belongs_to_user(folder: Objects) -> bool:
    """Whether anything lies there that this project did not make."""
    if folder.exists(MARKER):
        return False
    return any(name.rsplit("/", 1)[-1] not in NEVER_DELETED for name in folder.names())


def made_there(folder: Objects) -> set[str]:
    """Names of the objects that this project has put there, whole or not."""
    return set(_marker(folder)[1])


def load(folder: Objects, suffix: str, *, keep: bool = False) -> StoredTexts:
    """Every text with this ending; an absent folder has none.

    With ``keep`` a text may be absent: the user removes those of earlier runs.

    Raises
    ------
    DomainError
        The run that wrote them was killed; or, when it is read, one of them was changed since.
    """
    broken, made = _marker(folder)
    if broken:
        raise DomainError(
            "the run that wrote this folder was stopped before it was done",
            where=str(folder),
            todo="run it again; what lies there is not used",
        )
    there = set(made) & set(folder.names()) if keep else set(made)
    names = (name for name in sorted(there) if name.endswith(suffix))
    return StoredTexts({name: partial(_unchanged, folder, name, made[name]) for name in names})


def _unchanged(folder: Objects, name: str, sha256: str) -> bytes:
    """A text that is as it was written; of a kept one without a hash, whatever is there."""
    content = folder.read(name)
    if sha256 and hashlib.sha256(content).hexdigest() != sha256:
        raise DomainError("this was changed since it was written", where=f"{folder}/{name}", todo="run again")
    return content


def save(folder: Objects, data: Mapping[str, Content], *, gone: set[str], keep: bool) -> None:
    """Write all texts; with ``keep`` those of earlier runs stay, but for what is ``gone``."""
    broken, before = _marker(folder)
    known = {**before, **dict.fromkeys(data, "")}
    folder.write(MARKER, _marker_text(_BROKEN, known))
    kept = before if keep and not broken else {}
    made = {name: digest for name, digest in kept.items() if name not in gone}
    names = list(data)
    some = [names[start : start + _WRITTEN_TOGETHER] for start in range(0, len(names), _WRITTEN_TOGETHER)]
    for part in track(some, f"writing {folder.root.rsplit('/', 1)[-1]}", total=len(some)):
        contents = {name: as_bytes(data[name]) for name in part}
        folder.write_many(contents)
        made |= {name: hashlib.sha256(plain).hexdigest() for name, plain in contents.items()}
    folder.delete(name for name in before if name not in made)
    folder.write(MARKER, _marker_text(MARKER_HEAD, made))


def _marker_text(head: str, made: Mapping[str, str]) -> bytes:
    lines = [f"{name}\t{digest}" for name, digest in sorted(made.items())]
    return "\n".join([head, *lines, ""]).encode()


def _marker(folder: Objects) -> tuple[bool, dict[str, str]]:
    """Whether the last write was not finished; name -> SHA-256 of what it made."""
    try:
        head, *lines = folder.read(MARKER).decode("utf-8", errors="replace").split("\n")
    except FileNotFoundError:
        return False, {}
    parted = (line.partition("\t") for line in lines if line)  # not splitlines: a name may hold U+2028
    return head == _BROKEN, {name: digest for name, _, digest in parted}
