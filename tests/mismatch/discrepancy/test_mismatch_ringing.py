"""What a rig that rings adds to a force: nothing where the force is slow, most at its own frequency."""

from __future__ import annotations

import numpy as np
import pytest

from tire_pipeline.mismatch.discrepancy.ringing import ringing_forms, rung
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.model.residual import residual
from tire_pipeline.mismatch.recording.prepare import prepare

STEP, FREQUENCY, DAMPING = 0.002, 6.0, 0.1


@pytest.mark.parametrize("excited", [0.5, 3.0, 6.0, 12.0])
def test_amplitudes_are_those_of_a_mass_on_a_spring_with_a_damper(excited: float):
    time = np.arange(0.0, 20.0, STEP)
    mass, damper = rung(np.sin(2.0 * np.pi * excited * time), FREQUENCY, STEP, DAMPING).T
    s, w = 2j * np.pi * excited, 2.0 * np.pi * FREQUENCY
    below = s**2 + 2.0 * DAMPING * w * s + w**2
    settled = time > 10.0
    assert np.abs(mass[settled]).max() == pytest.approx(abs(s**2 / below), rel=0.02)
    assert np.abs(damper[settled]).max() == pytest.approx(abs(2.0 * DAMPING * w * s / below), rel=0.02)


def test_a_constant_force_does_not_ring():
    assert not np.any(rung(np.full(100, 4000.0), FREQUENCY, STEP, DAMPING))


@pytest.mark.parametrize("hertz", [4.3, 7.1, 11.9])
def test_the_form_explains_what_a_rig_explains_that_rings_as_the_force_does(tire, record, hertz):
    rate, damping = 50.0, 0.05
    recording = record(3, rate=rate, noise=1.0)
    true = rung(recording["fy"].to_numpy(), hertz, 1.0 / rate, damping)
    data = prepare(tire, recording.assign(fy=recording["fy"] + 20.0 * true[:, 0])).data
    (form,) = ringing_forms(data, [])
    left = residual(data, [])["fy"]
    most = explained(rung(simulate(data, [])["fy"], hertz, 1.0 / rate, damping), left)
    assert explained(form["fy"], left) > 0.8 * most > 0.2 * np.mean(left**2)


def explained(columns, rest):
    """What columns explain of the mean square of a residual."""
    fitted = columns @ np.linalg.lstsq(columns, rest, rcond=None)[0]
    return np.mean(rest**2) - np.mean((rest - fitted) ** 2)
