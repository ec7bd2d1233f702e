"""What a form without a name adds to the forces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class Form:
    """Columns of one form, shape (n, k) for each output, N; nats that it must have more than others."""

    label: str
    columns: dict[str, Array]
    less: float = 0.0
