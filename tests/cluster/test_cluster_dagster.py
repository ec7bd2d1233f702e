"""Dagster's runs on a cluster, kept in Postgres."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from postgres_process import Postgres, programs

pytest.importorskip("dagster_postgres", reason='not installed: pip install -e ".[schedule,postgres]"')
pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(programs() is None, reason="Debian's package postgresql is not installed"),
]
ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def postgres():
    running = Postgres()
    yield running
    running.end()


@pytest.fixture
def here(tmp_path, cluster, postgres):
    """The environment of a Dagster whose runs take the cluster; its data in a folder of its own."""
    sys.path.insert(0, str(ROOT / "tests" / "retraining"))
    from retraining_files import put_fleet

    put_fleet(tmp_path / "tir", range(25))
    conf = tmp_path / "conf"
    shutil.copytree(ROOT / "conf", conf)
    (conf / "cluster" / "globals.yml").write_text(f"data: {tmp_path}/data\ntir_folder: {tmp_path}/tir\n")
    home = tmp_path / "home"
    home.mkdir()
    parts = [(ROOT / "conf" / name).read_text() for name in ("dagster.yaml", "dagster_postgres.yaml")]
    (home / "dagster.yaml").write_text("".join(parts))
    return {
        **os.environ,
        "DAGSTER_HOME": str(home),
        "DAGSTER_POSTGRES_URL": postgres.url,
        "DO_NOT_TRACK": "1",
        "KEDRO_ENV": "cluster",
        "TIRE_PIPELINE_CONF": str(conf),
        "TIRE_PIPELINE_ROOT": str(ROOT),
        "TIRE_PIPELINE_SCHEDULER": cluster.address,
        "OMP_NUM_THREADS": "1",
        "PYTHONPATH": os.pathsep.join(sys.path),
    }


def test_a_retraining_by_dagster_takes_the_cluster_and_is_kept_in_postgres(here, tmp_path, postgres):
    import sqlalchemy

    command = [sys.executable, "-m", "dagster", "job", "execute", "-j", "retraining"]
    command += ["-m", "tire_pipeline.schedule.definitions"]
    done = subprocess.run(
        command, cwd=tmp_path, env=here, capture_output=True, text=True, check=False, timeout=500
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    assert "Dask workers at" in said
    assert postgres.url not in said
    engine = sqlalchemy.create_engine(postgres.url)
    with engine.connect() as connection:
        runs = connection.execute(sqlalchemy.text("select pipeline_name, status from runs")).all()
    engine.dispose()
    assert [tuple(run) for run in runs] == [("retraining", "SUCCESS")]
    assert not list((tmp_path / "home").rglob("*.db"))
    assert list((tmp_path / "data").rglob("record.json"))
