"""Whole runs from a bucket to the same bucket."""

from __future__ import annotations

import json
import signal
import sys
import time

import pytest
from bucket_runs import ROOT, run_here
from moto_keys import KEY, SECRET

from tire_pipeline.files.objects import Objects

sys.path.insert(0, str(ROOT / "tests" / "retraining"))
from retraining_files import tir_text

pytestmark = pytest.mark.long
QUICK = "one_run_at_a_time.expiry_seconds=3"


def _done(process) -> str:
    assert process.wait(timeout=500) == 0, process.said()
    return process.said()


def _put(data: Objects, tires: range) -> None:
    """All organisations' files of some tires."""
    texts = {f"{name}/T{tire:04d}.tir": tir_text(tire, name) for tire in tires for name in "ABD"}
    data.below("01_raw/tir").write_many({name: text.encode() for name, text in texts.items()})


def test_files_and_recordings_go_from_bucket_to_bucket(kedro, data, tmp_path, capsys):
    conf = tmp_path / "conf"
    run_here(conf, "make_fleet")
    run_here(conf, "ingest_tir", "dedupe_filter", "normalize", "translate", translate={"trials": 12})
    for name, source in (("model.tir", "tire.tir"), ("recording.csv", "rig_run.csv")):
        data.write(f"01_raw/recordings/rig/{name}", (ROOT / "examples" / source).read_bytes())
    run_here(conf, "explain_mismatch")
    said = capsys.readouterr()
    assert SECRET not in said.out + said.err
    names = data.names()
    front = data.read("08_reporting/index.html").decode()
    for wanted in (
        "08_reporting/translated_files.html",
        "08_reporting/mismatch.html",
        "08_reporting/mismatch/rig/recording.html",
        "08_reporting/tables/translation_report.csv",
    ):
        assert wanted in names
        assert wanted.removeprefix("08_reporting/") in front
    assert any(name.startswith("07_model_output/translated/") and name.endswith(".tir") for name in names)
    assert any(name.startswith("06_models/translator.npz/") for name in names)
    for name in names:
        content = data.read(name)
        assert SECRET.encode() not in content
        assert KEY.encode() not in content


def test_a_model_is_released_in_a_bucket_and_taken_back(kedro, data, tmp_path, capsys):
    """Files arrive in the bucket, store and models lie there; one bad file and nothing on this disk."""
    conf = tmp_path / "conf"
    few = {"dedupe_filter": {"minimum_per_category": 5}}
    _put(data, range(30))
    data.write("01_raw/tir/A/bad.tir", b"no tire")
    run_here(conf, "retrain", **few)
    _put(data, range(100, 110))
    data.write("01_raw/tir/A/bad.tir", tir_text(200, "A").encode())
    run_here(conf, "retrain", **few)
    run_here(conf, "retrain", **few)
    record = json.loads(data.read("06_models/released/record.json"))
    assert [event["event"] for event in record["history"]] == ["released", "released"]
    run_here(conf, "rollback")
    record = json.loads(data.read("06_models/released/record.json"))
    assert record["models"] == [record["history"][0]["model"]]
    names = data.names()
    assert "08_reporting/retraining.html" in names
    assert sum(name.startswith("02_intermediate/ingested/") for name in names) == 2
    said = capsys.readouterr()
    for secret in (SECRET, KEY):
        assert secret not in said.out + said.err
        assert not any(secret.encode() in data.read(name) for name in names)


def test_what_a_killed_run_wrote_is_taken_back(kedro, data):
    _put(data, range(30))
    more = "dedupe_filter,normalize,represent,bin,train_classifier"  # it is killed long before its end
    first = kedro("--pipelines", f"ingest_tir,{more}", "--params", QUICK)
    while not any("tire_table_raw" in name for name in data.names("02_intermediate")):
        assert first.poll() is None, first.said()
        time.sleep(0.05)
    first.send_signal(signal.SIGKILL)
    first.wait()
    half = {name for name in data.names("02_intermediate") if "tire_table_raw" in name}
    assert half
    said = _done(kedro("--pipeline", "ingest_tir", "--params", QUICK))
    assert "its results are removed" in " ".join(said.split())
    left = {name for name in data.names("02_intermediate") if "tire_table_raw" in name}
    assert len({name.split("/")[2] for name in left}) == 1  # one version: its part and its index
    assert not left & half


def test_a_bucket_that_is_not_there_is_one_line(kedro, tmp_path):
    conf = tmp_path / "conf" / "small" / "globals.yml"
    conf.write_text("data: s3://no-such-bucket/x\ntir_folder: s3://no-such-bucket/x\n")
    process = kedro("--pipeline", "ingest_tir")
    assert process.wait(timeout=300) == 1
    assert "Traceback" not in process.said()
    assert "s3://no-such-bucket" in process.said()
