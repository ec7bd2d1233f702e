"""Two effects that do together what one with several parameters does, beside a third."""

from __future__ import annotations

import numpy as np
from weighed import all_but

from tire_pipeline.mismatch import Explainer
from tire_pipeline.mismatch.inference.sets.answer import likeliest_description

CATALOGUE = (
    "temperature",
    "friction_scale",
    "stiffness_scale",
    "force_gain",
    "load_gain",
    "time_delay",
    "relaxation_length",
)


def test_another_tire_beside_a_lag_is_no_temperature(tire, record):
    """Another friction and stiffness were a temperature 40 degC off, 0.99: with the lag they were three."""
    recording = record(3, friction=1.1, stiffness=1.3, delay=0.08)
    warmth = np.cumsum(np.abs(recording["slip_angle"] * recording["fy"]))
    recording["tread_temperature"] = 35.0 + 20.0 * (1.0 - np.exp(-warmth / (0.4 * warmth.iloc[-1])))
    it = Explainer(without=all_but(*CATALOGUE)).weigh(tire, recording)
    fitted = [set(each.names) for each in it.sets.sets]
    scales = ({"friction_scale"}, {"force_gain"}, {"load_gain"})
    assert any({"stiffness_scale", "time_delay", *scale} in fitted for scale in scales)
    named = {name for names, _ in it.answer.sets for name in names}
    assert "temperature" not in {names[0] for names, _ in it.answer.sets}
    assert {"stiffness_scale", "friction_scale", "time_delay"} <= named


def test_a_description_with_several_names_is_likelier_than_each_of_them():
    lag, stiffness = "relaxation_length", "stiffness_scale"
    gains = {(gain, lag, stiffness): 0.2 for gain in ("force_gain", "friction_scale", "load_gain")}
    probabilities = {(): 0.1, (lag, "temperature"): 0.3, **gains}
    assert likeliest_description(probabilities, frozenset()) in gains
    assert likeliest_description({(): 0.1, (lag, "temperature"): 0.9}, frozenset()) == (lag, "temperature")
    assert likeliest_description({(): 1.0}, frozenset()) == ()
