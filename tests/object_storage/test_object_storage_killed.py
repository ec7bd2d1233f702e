"""Runs killed in the middle of any of their writes into a bucket: no later run trusts what they left."""

from __future__ import annotations

import re
import signal
from pathlib import Path

import pytest
from bucket_runs import ROOT, run_here
from kedro.io import DatasetError

from tire_pipeline.datasets import TextFolderDataset
from tire_pipeline.files.objects import Objects

pytestmark = pytest.mark.long
KILLED_AT = """
import os, signal, sys
from aiobotocore.client import AioBaseClient
from kedro.framework.cli.cli import main

part, left = sys.argv.pop(1), int(sys.argv.pop(1))
call = AioBaseClient._make_api_call

async def killing(self, operation, parameters):
    global left
    if operation in ("PutObject", "CompleteMultipartUpload") and part in parameters["Key"]:
        left -= 1
        if not left:
            os.kill(os.getpid(), signal.SIGKILL)
    return await call(self, operation, parameters)

AioBaseClient._make_api_call = killing
main()
"""
TIME = re.compile(rb"20\d\d-\d\d-\d\d[T ]\d\d[.:]\d\d([.:]\d\d)?([.:]\d+)?(Z|\+00:00)?")
PDY1 = re.compile(r"(?m)^(PDY1\s*=\s*)(\S+)")
QUICK = "one_run_at_a_time.expiry_seconds=3,cluster.processes=1"
TRANSLATION = [
    ("06_models/translator.npz", 1),
    ("translated_blocks/", 1),
    ("translated/.made_by", 1),
    ("translated/A/", 5),
    ("translated/.made_by", 2),
    ("translation_report.csv/", 1),
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
        return TextFolderDataset(path=str(folder)).load()
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


def _kill_at_each(kedro, data: Objects, pipeline: str, points, folders, params: str) -> None:
    """Kill a run at each of the points; what others would load stays that of one run, or is refused."""
    loaded = {folder: [_whole(data.below(folder))] for folder in folders}
    for part, number in points:
        program = ["-c", KILLED_AT, part, str(number)]
        run = kedro("--pipeline", pipeline, "--params", params, program=program)
        assert run.wait(timeout=500) == -signal.SIGKILL, f"{part}, {number}: {run.said()}"
        for folder, seen in loaded.items():
            now = _whole(data.below(folder))
            if now is not None and now not in seen:
                seen.append(now)
    for seen in loaded.values():
        assert len(seen) <= 2  # the one of before, and the one that was written last
    last = kedro("--pipeline", pipeline, "--params", params)
    assert last.wait(timeout=500) == 0, last.said()
    assert all(_whole(data.below(folder)) is not None for folder in folders)
    assert "its results are removed" in " ".join(last.said().split())


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
    few = {"translate": {"trials": 12}, "cluster": {"processes": 1}}
    run_here(conf, "ingest_tir", "dedupe_filter", "normalize", "translate", **few)
    first = _versions(data)
    changed, translated = "01_raw/tir/A/A_00003.tir", "07_model_output/translated/A/A_00003.tir"
    text = data.read(changed).decode()
    data.write(changed, PDY1.sub(lambda found: f"{found[1]}{1.01 * float(found[2])}", text).encode())
    before = {name: data.read(name) for name in data.names()}
    params = f"{QUICK},translate.trials=12"
    _kill_at_each(kedro, data, "translate", TRANSLATION, ["07_model_output/translated"], params)
    killed = _results(data)
    assert len(_versions(data) - first) == 1
    _undisturbed(data, before, conf, "translate", **few)
    assert before[translated] != killed[translated]
    _compare(data, killed)


def _recording(rows: slice) -> bytes:
    head, *lines = (ROOT / "examples/rig_run.csv").read_text().splitlines()
    return "\n".join([head, *lines[rows], ""]).encode()


def test_an_explanation_that_is_killed_at_any_write_leaves_nothing_that_counts(kedro, data, tmp_path):
    conf = tmp_path / "conf"
    rig = data.below("01_raw/recordings/rig")
    rig.write("model.tir", (ROOT / "examples/tire.tir").read_bytes())
    rig.write("one.csv", _recording(slice(0, 700)))
    run_here(conf, "explain_mismatch", cluster={"processes": 1})
    first = _versions(data)
    rig.write("one.csv", _recording(slice(700, 1400)))
    rig.write("two.csv", _recording(slice(300, 1000)))
    before = {name: data.read(name) for name in data.names()}
    folders = ["07_model_output/corrected", "08_reporting/mismatch"]
    _kill_at_each(kedro, data, "explain_mismatch", EXPLANATION, folders, QUICK)
    killed = _results(data)
    assert len(_versions(data) - first) == 1
    _undisturbed(data, before, conf, "explain_mismatch", cluster={"processes": 1})
    _compare(data, killed)
