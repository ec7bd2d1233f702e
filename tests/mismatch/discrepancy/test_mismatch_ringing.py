"""What a rig that rings adds to a force: nothing where the force is slow, most at its own frequency."""

from __future__ import annotations

import numpy as np
import pytest

from tire_pipeline.mismatch.discrepancy.ringing import rung

STEP, FREQUENCY = 0.002, 6.0


@pytest.mark.parametrize("excited", [0.5, 3.0, 6.0, 12.0])
def test_amplitude_is_that_of_a_mass_on_a_spring(excited: float):
    time = np.arange(0.0, 20.0, STEP)
    added = rung(np.sin(2.0 * np.pi * excited * time), FREQUENCY, STEP)
    s, w = 2j * np.pi * excited, 2.0 * np.pi * FREQUENCY
    wanted = abs(-(s**2) / (s**2 + 2.0 * 0.1 * w * s + w**2))
    assert np.abs(added[time > 10.0]).max() == pytest.approx(wanted, rel=0.02)


def test_a_constant_force_does_not_ring():
    assert not np.any(rung(np.full(100, 4000.0), FREQUENCY, STEP))
