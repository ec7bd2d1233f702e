"""Long recordings: searched in stretches, refitted on all."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from tire_pipeline.mismatch import explain_mismatch
from tire_pipeline.mismatch.inference.search import begin, run
from tire_pipeline.mismatch.inference.thinning import MOST_SAMPLES, portions, refit_on_all, thinned
from tire_pipeline.mismatch.recording.checks import prepare

FILE = Path(__file__).resolve().parents[2] / "benchmarks" / "bench_mismatch.py"


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


@pytest.mark.slow
def test_parameters_are_fitted_to_all_samples(tire, long_recording):
    data = prepare(tire, long_recording).data
    search = begin(thinned(data))
    run(search)
    assert search.fit.names == ["inflation_pressure"]
    row = [name for _, name in search.fit.labels].index("friction")
    first = search.fit
    # A start that is off by three standard errors must come back.
    error = np.sqrt(first.covariance[row, row] * search.inflation)
    search.fit.changes[0][1]["friction"] += 3.0 * error
    fit = refit_on_all(search, data)
    assert abs(fit.changes[0][1]["friction"] + 0.3) < error
    # 60,000 samples instead of 18,000: at most 1.8 times smaller, less where the misfit and not noise limits.
    assert 1.0 < np.sqrt(first.covariance[row, row] / fit.covariance[row, row]) < 1.9


@pytest.mark.slow
def test_the_report_says_what_was_searched_and_what_was_fitted(tire, long_recording):
    report = explain_mismatch(tire, long_recording)
    assert [e.name for e in report.effects] == ["inflation_pressure"]
    value, error, _ = report.effects[0].parameters["friction"]
    assert abs(value + 0.3) < 4.0 * error
    assert any("60,000 samples" in n and "fitted to all" in n for n in report.notes)
