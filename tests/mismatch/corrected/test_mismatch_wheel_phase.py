"""What comes back once a turn is added where the angle of the wheel is known, and nowhere else."""

import numpy as np
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.mismatch import CorrectedModel
from tire_pipeline.mismatch.corrected.wheel_phase import WheelWay
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.recording.prepare import prepare


def test_a_wave_is_added_in_the_recording_that_was_explained_and_left_out_of_another(tire, record):
    """There it would be added at any angle."""
    recording = record(0)
    data = prepare(tire, recording).data
    wave = {
        **catalogue()["nonuniformity"].zeros(data),
        "cosine_y": 200.0,
        "radius": 0.97 * data.nominal.radius,
    }
    rolled = WheelWay(data.time, recording["speed"].to_numpy(), data.wheel.way)
    corrected = CorrectedModel(tire, (("nonuniformity", wave),), ("fy",), rolled=rolled)
    other = recording.assign(time=recording["time"] + 1000.0)
    found, elsewhere = corrected.predict(recording), corrected.predict(other)
    added = found["fy"] - corrected.as_it_came.predict(recording)["fy"]
    np.testing.assert_allclose(added, 200.0 * np.cos(data.wheel.way / wave["radius"]), atol=1e-6)
    assert "notes" not in found.attrs
    np.testing.assert_allclose(elsewhere["fy"], corrected.as_it_came.predict(other)["fy"])
    assert "angle of the wheel" in elsewhere.attrs["notes"][0]
    with pytest.raises(RecordingError, match="nonuniformity needs the channel speed"):
        corrected.predict(recording.drop(columns="speed"))
