"""What could have been seen in a recording, and what is ruled out."""

import json
import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from recorded_sizes import NOISY, sizes
from weighed import all_but

from tire_pipeline.mismatch import Explainer, explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood


@pytest.fixture(scope="module")
def clean(tire, record):
    return explain_mismatch(tire, record(21, rate=10.0))


def test_every_effect_of_the_catalogue_has_a_row(clean):
    assert {row.name for row in clean.visible} == set(catalogue())


def test_sizes_are_weighed_once_and_go_with_a_copy_of_the_report(tire, record):
    """They take most of the time of an explanation, and not everyone asks for them."""
    report = explain_mismatch(tire, record(21).iloc[:400], without=all_but("friction_scale"))
    times = []
    weighed = report.find_visible
    report.find_visible = lambda: times.append(1) or weighed()
    copied, replaced = pickle.loads(pickle.dumps(report)), replace(report, notes=[])
    assert times == [1]
    assert report.visible
    assert repr(report.visible) == repr(copied.visible) == repr(replaced.visible)
    assert times == [1]


def test_what_was_not_varied_is_said_so(clean):
    rows = {row.name: row for row in clean.visible if not row.parameter}
    assert rows["camber"].text == "camber: camber is not recorded, nothing can be said"
    assert math.isnan(rows["camber"].seen)


def test_sizes_stand_in_the_json_and_on_the_page(clean, tmp_path):
    table = json.loads(clean.to_json(tmp_path / "r.json").read_text())
    assert json.loads(json.dumps(table, allow_nan=False)) == table
    seen = [row["seen"] for row in table["visible"] if row["unit"] == "1" and row["seen"] is not None]
    assert seen
    page = clean.to_html(tmp_path / "r.html").read_text()
    assert "What could have been seen" in page
    assert all(f"{100.0 * size:.2g}%" in page for size in seen)


def test_what_is_named_has_a_row_with_its_interval(tire, record):
    without = all_but("friction_scale", "stiffness_scale", "force_offset")
    report = explain_mismatch(tire, record(22, friction=0.6).iloc[:1500], without=without)
    (row,) = (r for r in report.visible if r.name == "friction_scale")
    ((name, value, interval, _),) = report.effects[0].rows()
    assert row.text.endswith(f"named, {name} {value} ({interval})")
    assert math.isnan(row.seen)


def test_a_test_that_knows_the_form_sees_less_in_more_noise(tire, record):
    """How often the same holds for what is named: ``rates``."""
    calm, noisy = (sizes(tire, record(23, noise=n).iloc[:1500], all_but(*NOISY)) for n in (20.0, 80.0))
    assert all(calm[1][key].told < noisy[1][key].told for key in NOISY.items())


def test_nothing_is_ruled_out_while_something_has_no_name(tire, record):
    recording = record(24).iloc[:3000]
    wave = 400.0 * np.sin(2.0 * np.pi * recording["time"] / 3.1) * (recording["time"] > 60.0)
    without = all_but("friction_scale", "stiffness_scale", "force_offset")
    report = explain_mismatch(tire, recording.assign(fy=recording["fy"] + wave), without=without)
    assert report.remainder.significant
    assert report.visible
    assert all(math.isnan(row.ruled_out) for row in report.visible)


def test_no_size_is_below_what_a_tire_can_have(tire, record):
    without = all_but("relaxation_length", "time_delay", "low_pass", "friction_scale", "stiffness_scale")
    _, found = sizes(tire, record(26, noise=2.0), without)
    sight = found["relaxation_length", "length"]
    assert sight.seen >= 0.1 * tire.coefficients["UNLOADED_RADIUS"]
    assert all(s.told <= s.seen for s in found.values())


def test_an_effect_that_gains_by_itself_takes_few_trials(tire, record, monkeypatch):
    """A cause that is there and not named: halving its size to nothing took a thousand trials."""
    unsaid = Explainer(without=all_but("friction_scale"), level=1.0)
    report = unsaid.explain(tire, record(22, friction=0.6).iloc[:400])
    trials, evidence = [], Likelihood.evidence
    monkeypatch.setattr(
        Likelihood, "evidence", lambda *args, **how: trials.append(1) or evidence(*args, **how)
    )
    (row,) = (r for r in report.visible if r.name == "friction_scale")
    assert not report.effects
    assert math.isfinite(row.seen)
    assert len(trials) < 300


def test_a_lag_that_is_short_beside_the_sampling_has_a_size_too(clean):
    """A filter of a tenth of a sample does nothing, from which no size can be told."""
    rows = {row.name: row for row in clean.visible}
    assert 0.0 < rows["low_pass"].ruled_out < rows["low_pass"].seen < 1.0
