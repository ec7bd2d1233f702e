"""Long recordings: searched in stretches, refitted on all."""

import importlib.util
from copy import deepcopy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from weighed import all_but

from tire_pipeline.mismatch import Explainer
from tire_pipeline.mismatch.inference.thinning import MOST_SAMPLES, portions, refit_on_all
from tire_pipeline.mismatch.recording.prepare import prepare
from tire_pipeline.mismatch.report.assemble import assembled

FILE = Path(__file__).resolve().parents[3] / "benchmarks" / "bench_mismatch.py"


@pytest.fixture(scope="module")
def long_recording(tire):
    """60,000 samples as the benchmark makes them; friction falls with pressure."""
    spec = importlib.util.spec_from_file_location("bench_mismatch", FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.recording(tire, 60_000)


def test_portions_hold_every_sample_once(tire, long_recording):
    data = prepare(tire, long_recording).data
    parts = list(portions(data))
    assert all(p.size < 1.3 * MOST_SAMPLES for p in parts)
    stamps = np.concatenate([p.time for p in parts])
    np.testing.assert_array_equal(np.sort(stamps), data.time)
    for p in parts:
        assert np.ptp(p.get("pressure")) > 0.9 * np.ptp(data.get("pressure"))


@pytest.fixture(scope="module")
def weighed(tire, long_recording):
    few = all_but("inflation_pressure", "friction_scale", "stiffness_scale")
    return Explainer(without=few).weigh(tire, long_recording)


@pytest.mark.slow
def test_parameters_are_fitted_to_all_samples(tire, long_recording, weighed):
    data = prepare(tire, long_recording).data
    found = weighed.analysis
    assert found.fit.names == ["inflation_pressure"]
    analysis = replace(found, fit=replace(found.fit, changes=deepcopy(found.fit.changes)))
    row = [name for _, name in analysis.fit.labels].index("friction")
    error = analysis.fit.errors[row]
    # A start that is off by three standard errors must come back.
    analysis.fit.changes[0][1]["friction"] += 3.0 * error
    fit = refit_on_all(analysis, data)
    assert abs(fit.changes[0][1]["friction"] + 0.3) < error


@pytest.mark.slow
def test_the_report_says_what_was_searched_and_what_was_fitted(weighed):
    report = assembled(weighed)
    assert [e.name for e in report.effects] == ["inflation_pressure"]
    value, error, _ = report.effects[0].parameters["friction"]
    assert abs(value + 0.3) < 4.0 * error
    assert any("60,000 samples" in n and "fitted to all" in n for n in report.notes)
