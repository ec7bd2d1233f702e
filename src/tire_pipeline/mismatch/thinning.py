"""Long recordings: the search looks at whole stretches spread over the time line."""

from __future__ import annotations

import numpy as np

from tire_pipeline.mismatch.data import Data

MOST_SAMPLES = 18_000
_STRETCH = 40.0


def thinned(data: Data) -> Data:
    """Return the recording, or stretches of 40 s evenly spread over it if it is long.

    States (temperature, wear, distance) are integrated over the whole recording before.
    """
    if data.size <= MOST_SAMPLES:
        return data
    if data.time is None:
        rows = np.zeros(data.size, bool)
        rows[np.linspace(0, data.size - 1, MOST_SAMPLES).astype(int)] = True
        return data.part(rows)
    stretch = max(int(_STRETCH / max(float(np.median(data.step)), 1e-9)), 200)
    count = max(MOST_SAMPLES // stretch, 2)
    firsts = np.linspace(0, data.size - stretch, count).astype(int)
    rows = np.zeros(data.size, bool)
    for first in firsts:
        rows[first : first + stretch] = True
    return data.part(rows)
