"""Noise is taken off an input only where the model is the better for it."""

from __future__ import annotations

import numpy as np
import pytest

from tire_pipeline.mismatch.recording.cleaning import clean


@pytest.mark.parametrize("rate", [100, 50, 25, 10])
def test_cleaning_never_makes_the_model_worse_on_fast_brake_sweeps(braked, rate):
    """From -0.2 to 0.2 in a second, at 25 Hz: a window flattened the sweep, and Fx was off by more."""
    rng = np.random.default_rng(2)
    at, slips = [0.0, 0.5, 1.0, 2.0, 2.5, 2.75], [0.0, 0.0, -0.2, 0.2, 0.0, 0.0]
    one = np.interp(np.arange(0.0, 2.75, 1.0 / rate), at, slips)
    slip_ratio, load = np.tile(one, 12), np.repeat(np.tile([1500.0, 3000.0, 4500.0], 4), one.size)
    start = np.arange(slip_ratio.size) % one.size == 0
    true = {"slip_angle": np.zeros(load.size), "camber": np.zeros(load.size), "normal_load": load}
    fx = braked.forces(**true, slip_ratio=slip_ratio).fx + rng.normal(0.0, 25.0, load.size)
    seen = {**true, "slip_ratio": slip_ratio + rng.normal(0.0, 0.003, load.size)}
    cleaned, _ = clean(braked, seen, {"fx": fx}, start)

    def left(channels):
        return np.sqrt(np.mean((fx - braked.forces(**channels).fx) ** 2))

    assert left(cleaned) <= left(seen)
