"""A run's results are the newest, whatever the clock said in an earlier run."""

from __future__ import annotations

import pytest
from kedro.io import DataCatalog
from kedro.pipeline import node, pipeline
from kedro.runner import SequentialRunner

from tire_pipeline.errors import DomainError
from tire_pipeline.kedro_runs.run_version import settle_version

NOW = "2026-11-30T12.00.00.000Z"
AHEAD = "2027-01-01T00.00.00.999Z"
TWO_NODES = pipeline(
    [
        node(lambda: {"run": "this"}, None, "made"),
        node(lambda made: made, "made", "passed_on", name="pass_on"),
    ]
)


def _catalog(folder, version: str = NOW) -> DataCatalog:
    stored = {"type": "json.JSONDataset", "versioned": True}
    names = {name: {**stored, "filepath": f"{folder}/{name}.json"} for name in ("made", "passed_on")}
    return DataCatalog.from_config(names, save_version=version)


def _run(folder, version: str) -> str:
    catalog = _catalog(folder, version)
    settled = settle_version(catalog, TWO_NODES, version)
    SequentialRunner().run(TWO_NODES, catalog)
    return settled


@pytest.mark.parametrize("before", ["2026-11-30T11.59.59.999Z", NOW, AHEAD])
def test_what_a_run_saves_is_what_is_loaded_next(tmp_path, before):
    _catalog(tmp_path, before).save("made", {"run": "an earlier one"})
    settled = _run(tmp_path, NOW)
    assert settled > before
    found = _catalog(tmp_path)
    assert [found.load("made"), found.load("passed_on")] == [{"run": "this"}] * 2
    assert {name: found.get(name).list_versions(full_path=False)[0] for name in ("made", "passed_on")} == {
        "made": settled,
        "passed_on": settled,
    }


def test_a_clock_that_was_right_is_believed(tmp_path, caplog):
    assert _run(tmp_path, NOW) == NOW
    assert caplog.text == ""


def test_a_clock_that_was_ahead_is_told_by_each_run_that_follows(tmp_path, caplog):
    _catalog(tmp_path, AHEAD).save("made", {"run": "an earlier one"})
    assert [_run(tmp_path, NOW) for _ in range(2)] == ["2027-01-01T00.00.01.000Z", "2027-01-01T00.00.01.001Z"]
    assert caplog.text.count("was ahead") == 2


def test_a_copy_that_would_be_loaded_for_ever_is_told(tmp_path):
    _catalog(tmp_path, "my copy").save("made", {"run": "an earlier one"})
    with pytest.raises(DomainError, match=r"made\.json: the folder 'my copy' .* -> move it elsewhere"):
        _run(tmp_path, NOW)
