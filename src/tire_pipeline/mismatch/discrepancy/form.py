"""What an unnamed form adds to the forces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class Form:
    """One form.

    Parameters
    ----------
    label : str
    columns : dict of ndarray, shape (n, k)
        For each output, N.
    less : float
        Log evidence that it must have more than others.
    in_misfit : bool
        Whether a formula may leave it with nothing missing: what rates and the last seconds of inputs do.
    """

    label: str
    columns: dict[str, Array]
    less: float = 0.0
    in_misfit: bool = False
