"""``explain_mismatch`` on a recording, as a user starts it."""

from __future__ import annotations

import json
import os
import re
import shutil
from pathlib import Path

import pytest
from conftest_kedro import ROOT, kedro

pytestmark = pytest.mark.slow
EXAMPLES = ROOT.parent / "shared" / "recordings" / "concealed_examples"


@pytest.mark.skipif(not EXAMPLES.exists() and "CI" not in os.environ, reason="../shared is not here")
def test_a_recording_gets_a_report_a_page_and_a_verdict(tmp_path):
    raw = tmp_path / "data" / "01_raw" / "recordings"
    shutil.copytree(EXAMPLES / "example07", raw / "good")
    bad = raw / "bad"
    bad.mkdir(parents=True)
    (bad / "recording.csv").write_text("time,slip_angle\n0,0.01\n")
    shutil.copy(EXAMPLES / "example07" / "model.tir", bad)
    done = kedro(tmp_path, "--pipeline", "explain_mismatch")
    assert done.returncode == 0, done.stdout + done.stderr
    data = tmp_path / "data"
    reports = json.loads(next((data / "07_model_output/mismatch_reports.json").rglob("*.json")).read_text())
    assert list(reports) == ["good/recording.csv"]
    assert reports["good/recording.csv"]["verdict"] in {
        "agrees",
        "explained",
        "ambiguous",
        "partly explained",
    }
    overview = next((data / "07_model_output/mismatch_overview.csv").rglob("*.csv")).read_text()
    assert "bad/recording.csv" in overview
    page = Path(data / "08_reporting/mismatch/good/recording.html").read_text()
    assert "<svg" in page or "<img" in page
    assert not re.search(r"""(src|href)\s*=\s*["'](?!#|data:)""", page.replace("xlink:href", "href"))
