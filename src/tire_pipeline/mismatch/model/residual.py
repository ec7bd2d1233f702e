"""What the simulation with some changes leaves of the recorded forces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tire_pipeline.mismatch.model.data import Data
from tire_pipeline.mismatch.model.forces import Change, simulate

Array = np.ndarray


def residual(data: Data, changes: Sequence[Change]) -> dict[str, Array]:
    """Recorded minus simulated, N."""
    f = simulate(data, changes)
    return {o: data.recorded[o] - f[o] for o in data.outputs}
