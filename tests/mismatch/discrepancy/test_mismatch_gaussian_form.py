"""The unexplained residual gets a form: a Gaussian process. That noise alone gets none: ``rates``."""

import numpy as np
import pytest
from weighed import without_visible

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.discrepancy.gaussian_form import gaussian_form
from tire_pipeline.mismatch.model.blocks import sweeps
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.words import gaussian


@pytest.fixture(scope="module")
def rig(tire, record):
    data = prepare(tire, record(12)).data
    return data, sweeps(data)


def test_a_form_over_slip_is_found_with_its_length_and_share(rig):
    data, block = rig
    rng = np.random.default_rng(0)
    rest = 200.0 * np.sin(data.get("slip_angle") / 0.03) + rng.normal(0.0, 50.0, data.size)
    form = gaussian_form(data, rest, "fy", block, 50.0)
    assert set(form.lengths) == {"slip_angle"}
    assert 0.01 < form.lengths["slip_angle"] < 0.1
    assert form.noise == pytest.approx(50.0, rel=0.15)
    # 200^2 / 2 of structure and 50^2 of noise.
    assert form.explained == pytest.approx(20000.0 / 22500.0, abs=0.04)
    assert form.recovered > 0.97
    assert "slip angle" in gaussian(form)


@pytest.mark.slow
def test_the_form_is_in_dictionary_and_page_and_has_no_name(tire, record, tmp_path):
    recording = record(9)
    t = recording["time"].to_numpy()
    wave = np.sin(2 * np.pi * (1.3 * t + 0.4 * np.sin(0.7 * t)))
    recording["fy"] += 400.0 * wave * (np.abs(recording["slip_angle"]) > 0.08)
    report = without_visible(explain_mismatch(tire, recording))
    assert report.verdict == "unexplained"
    form = report.to_dict()["remainder"]["gaussian"][0]
    assert form["output"] == "fy"
    assert form["lengths"]
    assert form["explained"] < 0.5  # a wave in time is no function of the channels, and it says so
    page = report.to_html(tmp_path / "r.html").read_text()
    assert "Gaussian process" in page
    assert "in time as well" in page
    assert "Fy over time." in page
    assert "bars at the top" not in page  # no effect, no bars
