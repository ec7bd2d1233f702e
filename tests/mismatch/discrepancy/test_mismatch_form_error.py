"""The error of an effect's form."""

import numpy as np

from tire_pipeline.mismatch.discrepancy.form_error import shape_columns
from tire_pipeline.mismatch.recording.prepare import prepare


def test_a_state_without_its_channel_may_lag_otherwise(tire, record):
    """What another lag would do is within the form's error; with a channel there is no lag to get wrong."""
    recording = record(5)
    values = {"friction": -0.1, "curvature": 0.0, "stiffness": 0.0, "reference": 0.0, "lag": 20.0}
    data = prepare(tire, recording).data
    blind = shape_columns(data, [("temperature", values)], 0)["fy"]
    seen = prepare(tire, recording.assign(tread_temperature=50.0 + 20.0 * data.states.heat(20.0))).data
    known = shape_columns(seen, [("temperature", {**values, "reference": 50.0})], 0)["fy"]
    assert blind.shape[1] == known.shape[1] + 2
    assert np.ptp(blind[:, -1]) > 0.1 * np.ptp(blind[:, 4])
