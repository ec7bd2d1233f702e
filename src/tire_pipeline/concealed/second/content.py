"""The content hash by which a later reader sees that nothing was changed after the fact."""

import hashlib
from pathlib import Path


def content_hash(folder: Path | None = None) -> str:
    """SHA-256 over the sources of a folder: name, length and bytes of each `.py` and `.json`, sorted by name.

    Parameters
    ----------
    folder
        This package without it.
    """
    folder = folder or Path(__file__).parent
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*"), key=lambda path: path.relative_to(folder).as_posix()):
        if path.suffix not in (".py", ".json"):
            continue
        content = path.read_bytes().replace(b"\r\n", b"\n")
        digest.update(f"{path.relative_to(folder).as_posix()} {len(content)}\n".encode())
        digest.update(content)
    return digest.hexdigest()
