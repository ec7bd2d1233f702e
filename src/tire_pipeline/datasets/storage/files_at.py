"""Whole files by their names, in a folder or below an address of an object store."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from tire_pipeline.files.atomic import check_now, replaced_file
from tire_pipeline.files.objects import Objects, is_remote


@dataclass(frozen=True)
class Files:
    """The files below a local folder, as :class:`tire_pipeline.files.objects.Objects` below an address.

    Attributes
    ----------
    root : Path
    """

    root: Path

    def read(self, name: str) -> bytes:
        """The content of a file."""
        return (self.root / name).read_bytes()

    def read_stamped(self, name: str) -> tuple[bytes, str]:
        """The content, and an empty stamp: a lock keeps others away between reading and :meth:`replace`."""
        return self.read(name), ""

    def replace(self, name: str, content: bytes, stamp: str | None) -> None:
        """Put a file in place of the one that was read, under the lock of the folder."""
        self.write(name, content)

    def write(self, name: str, content: bytes) -> None:
        """Put a file in place in one step."""
        with replaced_file(self.root / name) as temporary:
            temporary.write_bytes(content)

    def exists(self, name: str) -> bool:
        """Whether it is there."""
        return (self.root / name).exists()

    def names(self) -> list[str]:
        """Names of all files; those that are being written are left out."""
        found = (path for path in self.root.rglob("*") if path.suffix != ".part" and path.is_file())
        return sorted(path.relative_to(self.root).as_posix() for path in found)

    def delete(self, names: Iterable[str]) -> None:
        """Take files away, and folders that are empty then."""
        check_now()
        for name in names:
            path = self.root / name
            path.unlink(missing_ok=True)
            while path.parent != self.root and not any(path.parent.iterdir()):
                path = path.parent
                path.rmdir()


def files_at(path: str) -> Files | Objects:
    """The files below a path or an address."""
    return Objects(path) if is_remote(path) else Files(Path(path))
