"""Values of this project as JSON has them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from tire_pipeline.file_names import printable


def json_value(value: Any) -> Any:
    """Return JSON types: no arrays, NaN and infinities as null; names of files that can be written as UTF-8.

    Examples
    --------
    >>> json_value({"sizes": np.array([1.0, np.nan]), 2: np.bool_(True)})
    {'sizes': [1.0, None], '2': True}
    """
    if isinstance(value, Mapping):
        return {printable(str(key)): json_value(each) for key, each in value.items()}
    if isinstance(value, np.ndarray):
        return json_value(value.tolist())
    if isinstance(value, list | tuple):
        return [json_value(each) for each in value]
    if isinstance(value, np.generic):
        return json_value(value.item())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return printable(str(value)) if isinstance(value, str | Path) else value
