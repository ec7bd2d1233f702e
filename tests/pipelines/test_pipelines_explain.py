"""``explain_mismatch`` on a recording, as a user starts it."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pandas as pd
import pytest
from conftest_kedro import ROOT, kedro_here

from tire_pipeline.datasets.users_files.recording_folder import RecordingFolderDataset
from tire_pipeline.errors import RecordingError
from tire_pipeline.files.rows_on_disk import joined
from tire_pipeline.mismatch.effects import catalogue
from tire_pipeline.reporting.mismatch.explain_task import COLUMNS
from tire_pipeline.reporting.mismatch.explained_recordings import (
    ExplainParameters,
    collect_explained,
    explain_each,
    refuse_none_explained,
)
from tire_pipeline.reporting.mismatch.mismatch_overview import draw_overview

pytestmark = pytest.mark.slow
EXAMPLES = ROOT / "examples"
EARLIER = {"recording": "old.csv", "verdict": "explained", "summary": "Camber is missing."}


def _write_run(path: Path, step: int = 2) -> None:
    """The example without its speed, of which less is looked for, and some of its rows."""
    names, units, *rows = (EXAMPLES / "rig_run.csv").read_text().splitlines()
    kept = [k for k, name in enumerate(names.split(",")) if name != "V"]
    lines = [[line.split(",")[k] for k in kept] for line in (names, units, *rows[::step])]
    path.write_text("".join(",".join(line) + "\n" for line in lines))


def _all_but(*names: str) -> list[str]:
    """Effects that are left out where it takes a few to see what is done with recordings."""
    return sorted(set(catalogue()) - set(names))


def test_a_recording_gets_a_report_a_page_and_a_verdict(tmp_path):
    raw = tmp_path / "data" / "01_raw" / "recordings"
    good, bad = raw / "good", raw / "bad"
    for folder in (good, bad):
        folder.mkdir(parents=True)
        shutil.copy(EXAMPLES / "tire.tir", folder)
    _write_run(good / "recording.csv")
    (bad / "recording.csv").write_text("time,slip_angle\n0,0.01\n")
    without = ";".join(_all_but("inflation_pressure", "friction_scale"))
    parameters = f"explain_mismatch.axes=ISO,explain_mismatch.without={without}"
    done = kedro_here(tmp_path, "--pipeline", "explain_mismatch", "--params", parameters)
    assert done.returncode == 0, done.stdout + done.stderr
    data = tmp_path / "data"
    reports = json.loads(next((data / "07_model_output/mismatch_reports.json").rglob("*.json")).read_text())
    assert list(reports) == ["good/recording.csv"]
    assert reports["good/recording.csv"]["verdict"] == "explained"
    overview = next((data / "07_model_output/mismatch_overview.json").rglob("part-*.parquet"))
    assert list(pd.read_parquet(overview)["recording"]) == ["bad/recording.csv", "good/recording.csv"]
    whole = Path(data / "08_reporting/mismatch.html").read_text()
    assert 'href="mismatch/good/recording.html"' in whole
    assert "2 recordings: 1 " in whole
    assert "1 could not be used" in done.stdout
    assert "bad/recording.csv" in (data / "08_reporting/tables/mismatch_overview.csv").read_text()
    assert "mismatch/good/recording.html" in (data / "08_reporting/index.html").read_text()
    place = data / "08_reporting/mismatch/good/recording.html"
    page = place.read_text()
    assert "<svg" in page
    asked = re.findall(r"""(?:src|href)\s*=\s*["'](?!#|data:)([^"']+)""", page)
    assert asked == ["../../index.html", "../../mismatch.html"]
    assert (place.parent / asked[0]).is_file()


def _explain(loaders, parameters):
    reports, overview, *others = collect_explained(explain_each(loaders, parameters))
    refuse_none_explained(overview, [])
    return reports, overview, *others


def test_a_run_that_could_use_no_recording_says_so_on_its_page(tmp_path):
    """The page of an earlier run stayed, with its recordings as those of the last run."""
    bad, reports = tmp_path / "data" / "01_raw" / "recordings" / "bad", tmp_path / "data" / "08_reporting"
    bad.mkdir(parents=True)
    shutil.copy(EXAMPLES / "tire.tir", bad)
    (bad / "recording.csv").write_text("time,slip_angle\n0,0.01\n")
    reports.mkdir()
    shown, _ = draw_overview([pd.DataFrame([{**dict.fromkeys(COLUMNS, ""), **EARLIER}])], ["old.html"], {})
    (reports / "mismatch.html").write_text(shown)
    (reports / "mismatch").mkdir()
    done = kedro_here(tmp_path, "--pipeline", "explain_mismatch")
    assert done.returncode == 1
    assert "none of 1 recordings could be explained; bad/recording.csv: " in done.stderr
    page, front = ((reports / name).read_text() for name in ("mismatch.html", "index.html"))
    assert "1 recording: 1 could not be used." in page
    assert "bad/recording.csv" in page
    assert "old.csv" not in page
    assert "1 recording: 1 could not be used." in front


@pytest.fixture
def thirds(tmp_path):
    """A folder with the three parts of a recording, one at each inflation pressure, and their tire."""
    folder = tmp_path / "tire"
    folder.mkdir()
    shutil.copy(EXAMPLES / "tire.tir", folder)
    names, units, *rows = (EXAMPLES / "rig_run.csv").read_text().splitlines(keepends=True)
    third = len(rows) // 3
    for number, name in enumerate(("one", "two", "three")):
        part = rows[number * third : (number + 1) * third]
        (folder / f"{name}.csv").write_text("".join([names, units, *part]))
    return tmp_path


def test_recordings_of_one_folder_are_explained_together_and_one_is_held_out(thirds):
    loaders = RecordingFolderDataset(path=str(thirds)).load()
    without = ";".join(_all_but("inflation_pressure", "friction_scale"))
    parameters = ExplainParameters(axes="ISO", together=True, hold_out="two*", without=without)
    reports, overview, pages, _ = _explain(loaders, parameters)
    report = reports["tire/together"]
    (effect,) = report["effects"]
    assert effect["name"] == "inflation_pressure"
    assert report["recordings"] == ["tire/one.csv", "tire/three.csv"]
    error = report["held_out"]["errors"]["fy"]
    assert 0.0 < error["rms_after"] < error["rms_before"]
    assert joined(overview)["held_out"].tolist() == ["tire/two.csv"]
    assert b"Tested on a held-out recording" in pages["tire/together.html"]()


def test_what_cannot_be_explained_together_is_said(thirds):
    loaders = RecordingFolderDataset(path=str(thirds)).load()
    with pytest.raises(RecordingError, match="matches no recording of a folder"):
        _explain(loaders, ExplainParameters(together=True, hold_out="four*"))
    with pytest.raises(RecordingError, match="together to true"):
        _explain(loaders, ExplainParameters(hold_out="two*"))
    shutil.copy(thirds / "tire" / "tire.tir", thirds / "tire" / "two.tir")
    (thirds / "tire" / "tire.tir").rename(thirds / "tire" / "one.tir")
    (thirds / "tire" / "three.csv").unlink()
    with pytest.raises(RecordingError, match="belong to several tires"):
        _explain(RecordingFolderDataset(path=str(thirds)).load(), ExplainParameters(together=True))


def test_why_a_recording_could_not_be_used_stands_without_its_path(tmp_path):
    (tmp_path / "odd").mkdir()
    shutil.copy(EXAMPLES / "rig_run.csv", tmp_path / "odd" / "run.csv")
    loaders = RecordingFolderDataset(path=str(tmp_path)).load()
    with pytest.raises(
        RecordingError, match=r"explained; odd/run.csv: no \.tir file lies beside this"
    ) as raised:
        _explain(loaders, ExplainParameters(axes="ISO"))
    assert str(tmp_path) not in str(raised.value)


def test_effects_that_are_left_out_are_not_looked_for(tmp_path):
    for name in ("rig", "other"):
        (tmp_path / name).mkdir()
        shutil.copy(EXAMPLES / "tire.tir", tmp_path / name)
        _write_run(tmp_path / name / "rig_run.csv", 10)
    tire = tmp_path / "other" / "tire.tir"
    lines = tire.read_text().splitlines(keepends=True)
    tire.write_text("".join(line for line in lines if not line.startswith("UNLOADED_RADIUS")))
    loaders = RecordingFolderDataset(path=str(tmp_path)).load()
    few = _all_but("inflation_pressure", "friction_scale")
    rules = [{"match": "rig", "without": [*few, "inflation_pressure"]}, {"match": "other", "without": few}]
    reports, *_ = _explain(loaders, ExplainParameters(axes="ISO", recordings=rules))
    found = {name: [effect["name"] for effect in report["effects"]] for name, report in reports.items()}
    assert found["other/rig_run.csv"] == ["inflation_pressure"]
    assert "inflation_pressure" not in found["rig/rig_run.csv"]
    lacks = {name: "no UNLOADED_RADIUS" in " ".join(report["assumed"]) for name, report in reports.items()}
    assert lacks == {"other/rig_run.csv": True, "rig/rig_run.csv": False}
    with pytest.raises(RecordingError, match="no effect 'inflation_presure' -> did you mean 'inflation_pre"):
        _explain(loaders, ExplainParameters(without="wear;inflation_presure"))
