"""What is added where a recording does not tell several explanations apart."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.mismatch import CorrectedModel
from tire_pipeline.mismatch.corrected.agreed import agreed
from tire_pipeline.mismatch.model.nominal import Reference

GAIN = (("force_gain", {"fy": 0.1, "fx": 0.0}),)
OFFSET = (("force_offset", {"fy": 200.0, "fx": 0.0}),)


@pytest.fixture
def run():
    slip_angle = np.linspace(-0.2, 0.2, 81)
    return pd.DataFrame({"slip_angle": slip_angle, "normal_load": 4000.0})


def test_the_smallest_likely_change_along_the_likeliest_and_none_where_signs_differ():
    plain = {"fy": np.array([100.0, 100.0, 100.0])}
    each = [{"fy": np.array([130.0, 90.0, 80.0])}, {"fy": np.array([110.0, 130.0, 70.0])}]
    assert agreed(plain, each, [1.0, 0.5])["fy"].tolist() == [110.0, 100.0, 80.0]


def test_what_is_unlikely_changes_nothing():
    """Less likely than one standard deviation below: the likeliest explanation counts alone."""
    plain, each = {"fy": np.array([100.0])}, [{"fy": np.array([130.0])}, {"fy": np.array([110.0])}]
    assert agreed(plain, each, [0.9, 0.1])["fy"].tolist() == [130.0]
    assert agreed(plain, each, [0.8, 0.2])["fy"].tolist() == [110.0]


def test_several_unlikely_ones_count_together():
    plain = {"fy": np.array([100.0])}
    each = [{"fy": np.array([100.0 + change])} for change in (30.0, 10.0, 20.0)]
    assert agreed(plain, each, [0.8, 0.1, 0.1])["fy"].tolist() == [120.0]


def test_no_true_explanation_among_them_is_overshot(tire, run):
    """Whichever of them is true, no sample is predicted worse than by the model as it came."""
    both = CorrectedModel(tire, GAIN, ("fy",), instead=((0.5, OFFSET),)).predict(run)["fy"]
    plain = CorrectedModel(tire, (), ("fy",)).predict(run)["fy"]
    assert float(np.abs(both - plain).max()) > 100.0
    for truth in (GAIN, OFFSET):
        recorded = CorrectedModel(tire, truth, ("fy",)).predict(run)["fy"]
        assert (np.abs(recorded - both) <= np.abs(recorded - plain) + 1e-9).all()


def test_one_explanation_alone_is_added_whole(tire, run):
    alone = CorrectedModel(tire, GAIN, ("fy",))
    twice = CorrectedModel(tire, GAIN, ("fy",), instead=((0.5, GAIN),))
    assert np.allclose(alone.predict(run)["fy"], twice.predict(run)["fy"])


def test_one_that_needs_a_channel_which_is_not_there_is_not_counted(tire, run):
    slower = (("speed_dependence", {"friction": -0.5, "stiffness": 0.0}),)
    model = CorrectedModel(tire, GAIN, ("fy",), Reference(speed_nominal=16.7), instead=((0.5, slower),))
    found = model.predict(run)
    assert np.allclose(found["fy"], CorrectedModel(tire, GAIN, ("fy",)).predict(run)["fy"])
    assert any("need a channel" in note for note in found.attrs["notes"])


def test_the_file_says_what_else_it_could_be(tire, tmp_path):
    scale = (("stiffness_scale", {"stiffness": -0.1, "lateral_stiffness": 0.0}),)
    model = CorrectedModel(tire, scale, ("fy",), instead=((0.5, OFFSET),))
    text = model.to_tir(tmp_path / "c.tir").read_text()
    assert "the recording does not tell stiffness_scale from: force_offset" in text
