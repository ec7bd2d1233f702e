"""What the simulation with some changes leaves of the recorded forces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate

Array = np.ndarray


def residual(data: Data, changes: Sequence[Change]) -> dict[str, Array]:
    """Recorded minus simulated, N."""
    f = simulate(data, changes)
    return {o: data.recorded[o] - f[o] for o in data.outputs}


def rms(x: ArrayLike) -> float:
    """Root mean square of what is finite; NaN where nothing is."""
    values = np.asarray(x, float)
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")
