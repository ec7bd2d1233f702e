"""What is added where a recording does not tell several explanations apart."""

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.mismatch import CorrectedModel
from tire_pipeline.mismatch.corrected.agreed import agreed, share_agreed
from tire_pipeline.mismatch.model.forces import simulate
from tire_pipeline.mismatch.model.nominal import Reference
from tire_pipeline.mismatch.model.residual import partly
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.tir import read_tir

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


def test_the_share_that_is_proved_is_the_share_that_is_added(tire, record):
    data = prepare(tire, record(3)).data
    share = share_agreed(data, GAIN, ((0.5, OFFSET),))["fy"]
    plain, own, other = (simulate(data, changes) for changes in ((), GAIN, OFFSET))
    whole = agreed(plain, [own, other], [1.0, 0.5])["fy"]
    np.testing.assert_allclose(partly(plain["fy"], own["fy"], share), whole, atol=1e-6)
    assert 0.0 <= share.min() < 0.5 < share.max() <= 1.0
    assert share_agreed(data, GAIN, ()) == {}


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


def test_a_part_of_a_change_is_that_part_in_forces_file_and_sidecar(tire, run, tmp_path):
    """What unseen sweeps confirm is in what predicts, and in what is written."""
    slower = {"friction": -0.1, "stiffness": 0.0, "sliding": 0.0, "linear": 0.0}
    changes = (("friction_scale", {"friction": -0.2}), ("speed_dependence", slower))
    whole = CorrectedModel(tire, changes[:1], ("fy",))
    partly = CorrectedModel(tire, changes[:1], ("fy",), part=0.6)
    plain = partly.as_it_came.predict(run)["fy"]
    np.testing.assert_allclose(
        partly.predict(run)["fy"] - plain, 0.6 * (whole.predict(run)["fy"] - plain), rtol=1e-9, atol=1e-9
    )
    written = read_tir(partly.to_tir(tmp_path / "partly.tir"))
    at = {name: run[name].to_numpy() for name in run}
    steady = written.forces(**at, outputs=("fy",), limits="ignore").fy
    np.testing.assert_allclose(steady, partly.predict(run)["fy"], rtol=0.02)
    assert "60% of what was found" in (tmp_path / "partly.tir").read_text(encoding="utf-8")
    _, sidecar = CorrectedModel(tire, changes[1:], ("fy",), part=0.6).tire_model()
    assert sidecar["speed_dependence"]["part"] == 0.6
    assert "part" not in CorrectedModel(tire, changes[1:], ("fy",)).tire_model()[1]["speed_dependence"]
