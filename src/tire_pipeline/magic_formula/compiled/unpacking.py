"""A packed vector's numbers under their names, for compiled code and for the interpreter."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tire_pipeline.magic_formula.equations.jit import jitable
from tire_pipeline.magic_formula.parameters.coefficients import COEFFICIENT_NAMES, Coefficients


def _unpacker() -> Callable[..., Any]:
    # written out item by item: numba's own conversion of an array to a tuple takes 40 microseconds
    items = ", ".join(f"c[{i}]" for i in range(len(COEFFICIENT_NAMES)))
    scope: dict[str, Any] = {"Coefficients": Coefficients}
    exec(f"def unpack(c):\n    return Coefficients({items})", scope)
    return jitable(scope["unpack"])


unpack = _unpacker()
"""Return :class:`Coefficients` from a packed vector."""
