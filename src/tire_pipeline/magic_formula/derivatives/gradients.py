"""The code of the derivatives: written from the equations when it is first asked for, and kept.

Writing takes hundredths of a second; what is kept beside it is what numba compiles from it, which takes
seconds. Where nothing can be written, the code stays in memory, and each process compiles it again.
"""

from __future__ import annotations

import contextlib
import importlib.util
import os
import sys
import tempfile
import time
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from types import ModuleType

from tire_pipeline.magic_formula.derivatives.derive import module_source, source_stamp

_PACKAGE = Path(__file__).parent
_OLD = 86_400.0
"""Age in seconds at which code of other equations is deleted: no process is still compiling it."""


@lru_cache(maxsize=2)
def gradients_of(family: int) -> ModuleType:
    """Return the module that holds the derivatives of a family of equations.

    Parameters
    ----------
    family : {5, 6}

    Returns
    -------
    module
        ``OVER``: output -> the coefficients that it depends on. For each output a function of that name
        that returns its derivatives, and a loop over points, ``loop_<output>``.

    Notes
    -----
    The file bears :func:`.derive.source_stamp` in its name, so code of other equations is never taken for
    these. It is put in place whole: processes that start at once write the same. Each process deletes code of
    other equations that is over a day old, and what killed processes left half written.
    """
    name = f"gradients_{family}_{source_stamp()}"
    for folder in cache_folders():
        with contextlib.suppress(OSError):
            path = folder / f"{name}.py"
            if not path.is_file():
                _put(path, module_source(family))
            _delete_old(folder, family, name)
            return _imported(name, path)
    return _in_memory(name, module_source(family))


def cache_folders() -> list[Path]:
    """Return the folders that may keep the code, the first choice first: where numba keeps what it compiles.

    ``NUMBA_CACHE_DIR`` where it is set, else ``__pycache__`` beside the equations, else a folder of this
    installation's own in the user's cache.
    """
    own = sha256(str(_PACKAGE).encode()).hexdigest()[:16]
    given = os.environ.get("NUMBA_CACHE_DIR")
    if given:
        return [Path(given) / f"tire_pipeline_{own}"]
    found = [_PACKAGE / "__pycache__"]
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    with contextlib.suppress(RuntimeError):  # a user without a home
        found.append((Path(base) if base else Path.home() / ".cache") / "tire-pipeline" / own)
    return found


def _put(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, part = tempfile.mkstemp(prefix=".", suffix=".part", dir=path.parent)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.replace(part, path)
    finally:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(part)


def _delete_old(folder: Path, family: int, name: str) -> None:
    for pattern in (f"gradients_{family}_*", f"__pycache__/gradients_{family}_*", ".*.part"):
        for path in folder.glob(pattern):
            with contextlib.suppress(OSError):
                if not path.name.startswith(name) and time.time() - path.stat().st_mtime > _OLD:
                    path.unlink()


def _imported(name: str, path: Path) -> ModuleType:
    full = f"{__package__}.{name}"
    spec = importlib.util.spec_from_file_location(full, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    sys.modules[full] = module  # numba looks it up by its name
    return module


def _in_memory(name: str, text: str) -> ModuleType:
    module = ModuleType(f"{__package__}.{name}")
    exec(compile(text, f"<{name}>", "exec"), module.__dict__)
    sys.modules[module.__name__] = module
    return module
