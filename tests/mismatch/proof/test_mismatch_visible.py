"""What could have been seen in a recording, and what is ruled out."""

import json
import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from real_at_rates import points

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.mismatch.explain import Explainer
from tire_pipeline.mismatch.proof.trial import put_in
from tire_pipeline.mismatch.proof.visible import sights


@pytest.fixture(scope="module")
def clean(tire, record):
    return explain_mismatch(tire, record(21))


def _but(*names):
    """All of the catalogue but some effects: what is left out is not weighed."""
    return set(catalogue()) - set(names)


def _sizes(tire, recording, without=()):
    """(effect, parameter) -> what the recording shows of it."""
    it = Explainer(without=without).weigh(tire, recording)
    found = sights(it.analysis, it.sets, it.answer.named)
    return it.analysis, {(s.variant.name, s.parameter.name): s for s in found}


def test_every_effect_of_the_catalogue_has_a_row(clean):
    assert {row.name for row in clean.visible} == set(catalogue())


def test_sizes_are_weighed_once_and_go_with_a_copy_of_the_report(tire, record):
    """They take most of the time of an explanation, and not everyone asks for them."""
    report = explain_mismatch(tire, record(21).iloc[:400])
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
    written = table["visible"]
    row = next(r for r in written if r["name"] == "friction_scale")
    assert 0.0 < row["ruled_out"] < row["seen"] < 0.2
    page = clean.to_html(tmp_path / "r.html").read_text()
    assert "What could have been seen" in page
    assert f"{100.0 * row['seen']:.2g}%" in page


def test_what_is_named_has_a_row_with_its_interval(tire, record):
    without = _but("friction_scale", "stiffness_scale", "force_offset")
    report = explain_mismatch(tire, record(22, friction=0.9), without=without)
    (row,) = (r for r in report.visible if r.name == "friction_scale")
    value, error, _ = report.effects[0].parameters["friction"]
    assert row.text.endswith(f"named, friction {100.0 * value:.2g}% ± {196.0 * error:.2g}%")
    assert math.isnan(row.seen)


def test_more_noise_hides_more(tire, record):
    keys = (("force_offset", "fy"), ("sensor_drift", "fy"), ("time_delay", "delay"))
    without = _but(*(name for name, _ in keys), "low_pass", "relaxation_length", "nonuniformity")
    calm, noisy = (_sizes(tire, record(23, noise=noise, rate=50.0), without)[1] for noise in (20.0, 80.0))
    for key in keys:
        assert calm[key].seen < noisy[key].seen


def test_nothing_is_ruled_out_while_something_has_no_name(tire, record):
    recording = record(24)
    wave = 400.0 * np.sin(2.0 * np.pi * recording["time"] / 3.1) * (recording["time"] > 60.0)
    without = _but("friction_scale", "stiffness_scale", "force_offset")
    report = explain_mismatch(tire, recording.assign(fy=recording["fy"] + wave), without=without)
    assert report.remainder.significant
    assert report.visible
    assert all(math.isnan(row.ruled_out) for row in report.visible)


def _named_at_their_sizes(tire, recording, seed):
    """(effect, parameter) -> whether it is named, put in by its mechanism at the size that is seen."""
    analysis, found = _sizes(tire, recording)
    rng = np.random.default_rng(seed)
    named = {}
    for (name, parameter), sight in found.items():
        if not np.isfinite(sight.seen):
            continue
        sign = 1.0 if sight.parameter.one_sided else rng.choice([-1.0, 1.0])
        values = sight.values(analysis.data, sign * sight.seen)
        report = explain_mismatch(tire, put_in(tire, recording, name, values))
        named[name, parameter] = any(name in (e.name, *e.alternatives) for e in report.effects)
    return named


@pytest.mark.long
def test_what_is_said_to_be_seen_is_named(tire, record):
    named = _named_at_their_sizes(tire, record(25), 25)
    assert len(named) >= 15
    assert np.mean(list(named.values())) >= 0.9, [k for k, ok in named.items() if not ok]


@pytest.mark.long
def test_what_is_said_to_be_seen_in_real_points_is_named():
    """The TYDEX points without camber, and a fit to them; rates: ``benchmarks/visible_sizes.py``."""
    tire, table, _ = points()
    named = _named_at_their_sizes(tire, table[table["camber"].abs() < 0.002].reset_index(drop=True), 0)
    assert len(named) >= 10
    assert np.mean(list(named.values())) >= 0.9, [k for k, ok in named.items() if not ok]


def test_no_size_is_below_what_a_tire_can_have(tire, record):
    without = _but("relaxation_length", "time_delay", "low_pass", "friction_scale", "stiffness_scale")
    _, found = _sizes(tire, record(26, noise=2.0), without)
    sight = found["relaxation_length", "length"]
    assert sight.seen >= 0.1 * tire.coefficients["UNLOADED_RADIUS"]
    assert all(s.told <= s.seen for s in found.values())
