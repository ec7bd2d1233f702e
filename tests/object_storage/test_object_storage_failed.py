"""A run that fails with data in a bucket leaves a front page that says so."""

from __future__ import annotations

import pytest
from bucket_runs import ROOT, run_here

from tire_pipeline.errors import RecordingError

pytestmark = pytest.mark.slow


def test_a_page_that_was_drawn_before_the_run_failed_is_quoted(kedro, data, tmp_path, capsys):
    """The front page quoted the page of the run before; with data in a folder it was made again."""
    data.write("08_reporting/index.html", b"of an earlier run")
    data.write("01_raw/recordings/rig/tire.tir", (ROOT / "examples" / "tire.tir").read_bytes())
    data.write("01_raw/recordings/rig/run.csv", b"time,slip_angle\n0,0.01\n")
    with pytest.raises(RecordingError, match="none of 1 recordings could be explained"):
        run_here(tmp_path / "conf", "explain_mismatch", cluster={"processes": 1})  # none of another test's
    assert "1 recording: 1 could not be used." in data.read("08_reporting/index.html").decode()
    assert "all reports" not in capsys.readouterr().out
