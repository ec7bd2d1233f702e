"""A file that ends the process that reads it is set aside by name: the run reads all others and goes on."""

from __future__ import annotations

import os
import sys

import pytest
from conftest_kedro import ROOT, kedro

sys.path.insert(0, str(ROOT / "tests" / "retraining"))
from retraining_files import put, put_fleet, tir_text

pytestmark = pytest.mark.slow
IN_EVERY_PROCESS = """
import os, signal
import tire_pipeline.tir.reading.read as reading

interpret = reading.interpret

def dies(file):
    if "killer" in str(file.path):
        os.kill(os.getpid(), signal.SIGKILL)
    return interpret(file)

reading.interpret = dies
"""


@pytest.mark.parametrize("pipeline", ["ingest_tir", pytest.param("retrain", marks=pytest.mark.long)])
def test_a_file_that_ends_its_process_stops_no_other(tmp_path, pipeline):
    """A retraining is run in ``long``: ``test_cluster_map.py`` has what it does with processes."""
    (tmp_path / "sitecustomize.py").write_text(IN_EVERY_PROCESS)
    tir = tmp_path / "data" / "01_raw" / "tir"
    put_fleet(tir, range(10))
    put(tir, "A/killer.tir", tir_text(99, "A"))
    paths = os.pathsep.join([str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])])
    few = "dedupe_filter.minimum_per_category=5"
    done = kedro(tmp_path, "--pipeline", pipeline, "--params", few, PYTHONPATH=paths)
    assert done.returncode == 0, done.stdout + done.stderr
    name = "retraining_files.csv" if pipeline == "retrain" else "ingest_report.csv"
    rows = (tmp_path / "data/08_reporting/tables" / name).read_text().splitlines()
    assert sum(",read," in row for row in rows) == 30
    (aside,) = [row for row in rows if "died three times" in row]
    assert aside.startswith("A/killer.tir,A,")
