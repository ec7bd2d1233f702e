"""A folder of files that are computed one by one; what is there already is not computed again."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from joblib import Parallel, delayed
from kedro.io.core import AbstractDataset

from tire_pipeline.atomic import replaced_file
from tire_pipeline.datasets.text_folder import _inside
from tire_pipeline.errors import DomainError
from tire_pipeline.progress import track

Compute = Callable[[], bytes]


class ComputedFolderDataset(AbstractDataset[Mapping[str, Compute], dict[str, Compute]]):
    """Saves ``{name: function that gives bytes}``: each file whole, several at a time, resumable.

    A file that exists is right, because its name must say all that it depends on (seed, settings,
    version of the code): put :func:`.code_hash.code_hash` into them. So a long computation that was
    interrupted, or killed, goes on where it stopped. Files of other names are left alone on saving and on
    loading: only those of the last save are loaded.

    Parameters
    ----------
    path : str
        The folder.
    processes : int
        How many files are computed at the same time.
    share : str, optional
        ``k/n``: compute the k-th of n shares of the files only, and do not count the folder as saved. So
        n machines work side by side; a run without a share then finds all files there, and goes on.
    metadata : dict, optional
        For kedro-viz.

    Raises
    ------
    DomainError
        ``share`` is not of that form.
    """

    _INDEX = "index.txt"

    def __init__(
        self,
        *,
        path: str,
        processes: int = 2,
        share: str | None = None,
        metadata: dict[str, Any] | None = None,
    ) -> None:
        self._path = path
        self._processes = processes
        self._share = None if share is None else _share(share)
        self.metadata = metadata

    def save(self, data: Mapping[str, Compute]) -> None:
        """Compute and write what is not there yet."""
        folder = Path(self._path)
        paths = {name: folder / _inside(name) for name in data}
        if self._share is None:
            (folder / self._INDEX).unlink(missing_ok=True)
        else:
            paths = dict(list(paths.items())[self._share])
        missing = [name for name, path in paths.items() if not path.exists()]
        work = (delayed(_write)(data[name], paths[name]) for name in missing)
        done = Parallel(n_jobs=self._processes, return_as="generator_unordered")(work)
        what = f"computing {folder.name}"
        if len(missing) < len(paths):
            what += f" ({len(paths) - len(missing)} of {len(paths)} are there already)"
        for _ in track(done, what, total=len(missing)):
            pass
        if self._share is None:
            with replaced_file(folder / self._INDEX) as temporary:
                temporary.write_text("\n".join(data), encoding="utf-8")

    def load(self) -> dict[str, Compute]:
        """Name to the function that reads the file, for the files of the last save."""
        folder = Path(self._path)
        names = (folder / self._INDEX).read_text(encoding="utf-8").splitlines()
        return {name: (folder / _inside(name)).read_bytes for name in names}

    def _exists(self) -> bool:
        return (Path(self._path) / self._INDEX).exists()

    def _describe(self) -> dict[str, Any]:
        return {"path": self._path, "processes": self._processes}


def _share(text: str) -> slice:
    """``2/3`` is every third name from the second on."""
    found = re.fullmatch(r"([1-9]\d{0,5})/([1-9]\d{0,5})", str(text))
    number, count = map(int, found.groups()) if found else (1, 0)
    if number > count:
        raise DomainError(
            f"share={text!r} is no share", todo="give k/n with k from 1 to n, for example 3/400"
        )
    return slice(number - 1, None, count)


def _write(compute: Compute, path: Path) -> None:
    content = compute()
    with replaced_file(path) as temporary:
        temporary.write_bytes(content)
