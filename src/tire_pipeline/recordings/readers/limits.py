"""How much a file may grow when it is read."""

from __future__ import annotations

from pathlib import Path

from tire_pipeline.errors import RecordingError

# A compressed file of constant channels grows a hundredfold in earnest; only what is also large
# is refused.
_MOST_FACTOR = 200.0
_SMALL = float(1 << 26)


def check_expansion(path: Path, size: float) -> None:
    """Refuse a file whose content is far larger than itself.

    Parameters
    ----------
    path : Path
    size : float
        Bytes that the content takes when it is read.

    Raises
    ------
    RecordingError
        More than 64 MiB and more than 200 times the file's size.
    """
    allowed = max(_SMALL, _MOST_FACTOR * path.stat().st_size)
    if not size <= allowed:
        raise RecordingError(
            f"it says that it holds {size / 2**20:.0f} MiB, over {_MOST_FACTOR:.0f} times its size",
            where=str(path),
            todo="the file is damaged, or made to fill the memory",
        )
