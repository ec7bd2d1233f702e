"""Whether compiled code can be used, and the decorator for functions that interpreter and compiler share."""

from __future__ import annotations

import os
from collections.abc import Callable
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path
from typing import Any

NO_NUMBA_VARIABLE = "TIRE_PIPELINE_NO_NUMBA"
"""Set this environment variable to 1 to force the pure NumPy form."""

OPTIONS: Any = {
    "error_model": "numpy",
    "fastmath": {"contract"},
    "forceinline": True,
}
"""How shared functions are compiled: division as in NumPy, fused multiply-add, all in one loop body."""

try:
    if os.environ.get(NO_NUMBA_VARIABLE, "0") not in ("", "0"):
        raise ImportError(NO_NUMBA_VARIABLE)
    from numba.extending import register_jitable

    HAVE_NUMBA = True
except ImportError:
    HAVE_NUMBA = False

    def register_jitable(**options: Any) -> Callable[..., Any]:  # type: ignore[no-redef]
        """Return a decorator that does nothing: nothing compiles here."""
        return lambda function: function


jitable = register_jitable(**OPTIONS)
"""Mark a function that the interpreter runs on arrays and the compiler runs on scalars."""


_EQUATION_SOURCES = (
    "tire_pipeline.magic_formula.compiled.unpacking",
    "tire_pipeline.magic_formula.compiled.fast_math",
    "tire_pipeline.magic_formula.equations.jit",
    "tire_pipeline.magic_formula.equations.ops",
    "tire_pipeline.magic_formula.equations.shapes",
    "tire_pipeline.magic_formula.equations.equations_52",
    "tire_pipeline.magic_formula.equations.equations_61",
    "tire_pipeline.magic_formula.parameters.coefficients",
)
"""Modules whose text decides what is compiled from the equations."""


def checksum_with_equations(module: str) -> str:
    """Return a mark of the sources of a module and of the equations, which need not be imported for it."""
    text = b""
    for name in (module, *_EQUATION_SOURCES):
        spec = find_spec(name)
        assert spec is not None, name
        text += Path(str(spec.origin)).read_bytes()
    return sha256(text).hexdigest()[:16]


def compiled(function: Callable[..., Any], signature: Any) -> Callable[..., Any]:
    """Return a loop over points, compiled for a signature and kept on disk if there is a place for it."""
    from numba import njit

    from tire_pipeline.progress import under_way

    options: Any = {"nogil": True, "error_model": "numpy", "fastmath": {"contract"}}
    with under_way("compiling the equations (first use only)"):
        try:
            return njit(signature, cache=True, **options)(function)
        except RuntimeError:  # there is no folder that can be written: this process compiles for itself
            return njit(signature, **options)(function)
