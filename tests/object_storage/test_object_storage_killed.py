"""Runs killed in the middle of any of their writes into a bucket: no later run trusts what they left."""

from __future__ import annotations

import re
import signal
from pathlib import Path

import pytest
from bucket_runs import ROOT, run_here
from kedro.io import DatasetError
from killed_runs import forked_run
from moto_keys import KEY, SECRET

from tire_pipeline.datasets import TextFolderDataset
from tire_pipeline.files.objects import Objects

pytestmark = pytest.mark.long
TIME = re.compile(rb"20\d\d-\d\d-\d\d[T ]\d\d[.:]\d\d([.:]\d\d)?([.:]\d+)?(Z|\+00:00)?")
PDY1 = re.compile(r"(?m)^(PDY1\s*=\s*)(\S+)")
QUICK = {"one_run_at_a_time": {"expiry_seconds": 3}, "cluster": {"processes": 1}}
TRANSLATION = [
    ("06_models/translator.npz", 1),
    ("translated_blocks/", 1),
    ("translated/.made_by", 1),
    ("translated/A/", 5),
    ("translated/.made_by", 2),
    ("translation_report.json/", 2),
    ("source_table.json/", 2),
    ("translation_protocols.parquet/", 1),
    ("translation_outcome.json", 1),
    ("08_reporting/translated_files.html", 1),
    ("08_reporting/index.html", 1),
    (".over", 1),
]
EXPLANATION = [
    ("mismatch_explained/", 1),
    ("mismatch_explained/", 2),
    ("mismatch_explained/index.txt", 1),
    ("mismatch_reports.json/", 1),
    ("mismatch_overview.json/", 2),
    ("08_reporting/mismatch/.made_by", 1),
    ("08_reporting/mismatch/rig/", 1),
    ("corrected/rig/", 1),
    ("corrected/.made_by", 2),
    ("mismatch_rows/", 2),
    ("08_reporting/mismatch.html", 1),
    (".over", 1),
]


def _whole(folder: Objects) -> dict[str, bytes] | None:
    """What another run would load of a folder of texts; None where it is refused."""
    try:
        return dict(TextFolderDataset(path=str(folder)).load())
    except DatasetError as error:
        if "stopped before it was done" in str(error):
            return None
        raise


def _results(data: Objects) -> dict[str, bytes]:
    """The newest of every result by its name without the version."""
    found = {}
    for name in sorted(data.names()):  # versions sort by time
        if name.startswith(("07_", "08_")):
            parts = name.split("/")
            found["/".join(part for part in parts if not part.endswith("Z"))] = data.read(name)
    return found


def _versions(data: Objects) -> set[str]:
    parts = (name.split("/") for name in data.names() if name.startswith(("06_", "07_", "08_")))
    return {part for name in parts for part in name if part.endswith("Z")}


def _kill_at_each(runs: Path, data: Objects, pipeline: str, points, folders, parameters) -> None:
    """Kill a run at each of the points; what others would load stays that of one run, or is refused."""
    loaded = {folder: [_whole(data.below(folder))] for folder in folders}
    for count, point in enumerate(points):
        log = runs / f"log{count}"
        assert forked_run(runs / "conf", log, pipeline, parameters, point) == -signal.SIGKILL, log.read_text()
        for folder, seen in loaded.items():
            now = _whole(data.below(folder))
            if now is not None and now not in seen:
                seen.append(now)
    for seen in loaded.values():
        assert len(seen) <= 2  # the one of before, and the one that was written last
    log = runs / "log"
    assert forked_run(runs / "conf", log, pipeline, parameters, None) == 0, log.read_text()
    assert all(_whole(data.below(folder)) is not None for folder in folders)
    assert "its results are removed" in " ".join(log.read_text().split())
    for each in runs.glob("log*"):
        assert not {word for word in (KEY, SECRET) if word in each.read_text()}


def _undisturbed(data: Objects, before: dict[str, bytes], conf: Path, pipeline: str, **parameters) -> None:
    """As if no run had been killed: the same objects as before, and one run."""
    data.delete(data.names())
    data.write_many(before)
    run_here(conf, pipeline, **parameters)


def _compare(data: Objects, killed: dict[str, bytes]) -> None:
    """All results are the same, but for the times at which they were made; markers have hashes of these."""
    whole = _results(data)
    assert set(killed) == set(whole)
    for name, content in whole.items():
        if not name.endswith("/.made_by_tire_pipeline"):
            assert TIME.sub(b"", killed[name]) == TIME.sub(b"", content), name


def test_a_translation_that_is_killed_at_any_write_leaves_nothing_that_counts(kedro, data, tmp_path):
    conf = tmp_path / "conf"
    run_here(conf, "make_fleet")
    few = {**QUICK, "translate": {"trials": 12}}
    run_here(conf, "ingest_tir", "dedupe_filter", "normalize", "translate", **few)
    first = _versions(data)
    changed, translated = "01_raw/tir/A/A_00003.tir", "07_model_output/translated/A/A_00003.tir"
    text = data.read(changed).decode()
    data.write(changed, PDY1.sub(lambda found: f"{found[1]}{1.01 * float(found[2])}", text).encode())
    before = {name: data.read(name) for name in data.names()}
    _kill_at_each(tmp_path, data, "translate", TRANSLATION, ["07_model_output/translated"], few)
    killed = _results(data)
    assert len(_versions(data) - first) == 1
    _undisturbed(data, before, conf, "translate", **few)
    assert before[translated] != killed[translated]
    _compare(data, killed)


def _recording(start: int, gain: float = 1.0) -> bytes:
    """A hundred rows of the example from ``start`` on; its forces by a factor."""
    head, units, *lines = (ROOT / "examples/rig_run.csv").read_text().splitlines()
    rows = (line.rsplit(",", 1) for line in lines[start : start + 400 : 4])
    return "\n".join([head, units, *(f"{rest},{gain * float(fy):.1f}" for rest, fy in rows), ""]).encode()


def test_an_explanation_that_is_killed_at_any_write_leaves_nothing_that_counts(kedro, data, tmp_path):
    conf = tmp_path / "conf"
    rig = data.below("01_raw/recordings/rig")
    rig.write("model.tir", (ROOT / "examples/tire.tir").read_bytes())
    rig.write("one.csv", _recording(0))
    run_here(conf, "explain_mismatch", **QUICK)
    first = _versions(data)
    rig.write("one.csv", _recording(0, gain=0.8))
    rig.write("two.csv", _recording(500, gain=0.8))
    before = {name: data.read(name) for name in data.names()}
    folders = ["07_model_output/corrected", "08_reporting/mismatch"]
    _kill_at_each(tmp_path, data, "explain_mismatch", EXPLANATION, folders, QUICK)
    killed = _results(data)
    assert any(name.startswith("07_model_output/corrected/rig/two") for name in killed)
    assert len(_versions(data) - first) == 1
    _undisturbed(data, before, conf, "explain_mismatch", **QUICK)
    _compare(data, killed)
