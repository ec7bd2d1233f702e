"""What of a cause is drawn beside its size."""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Draw:
    """What of a cause is drawn beside its size."""

    sign: float
    channel: int  # of fx, fy, mz
    constant: bool  # the same all along, or after `levels`
    levels: np.ndarray = field(repr=False)  # (n,), -1 to 1, a level a section
    scales: np.ndarray = field(repr=False)  # (3,), RMS of fx, fy, mz: N, N, N m
