"""Whether compiled code can be used, and the decorator for functions that both worlds share."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

NO_NUMBA_VARIABLE = "TIRE_PIPELINE_NO_NUMBA"
"""Set this environment variable to 1 to force the pure NumPy form."""

try:
    if os.environ.get(NO_NUMBA_VARIABLE, "0") not in ("", "0"):
        raise ImportError(NO_NUMBA_VARIABLE)
    from numba.extending import register_jitable

    HAVE_NUMBA = True
except ImportError:
    HAVE_NUMBA = False

    def register_jitable(function: Callable[..., Any]) -> Callable[..., Any]:
        """Return the function as it is: nothing compiles here."""
        return function


jitable = register_jitable
"""Mark a function that the interpreter runs on arrays and the compiler runs on scalars."""
