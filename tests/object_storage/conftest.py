"""A real S3 interface on loopback: moto's server."""

from __future__ import annotations

import itertools
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from bucket_runs import ROOT
from moto_keys import KEY, SECRET

from tire_pipeline.files.objects import Objects

_NUMBERS = itertools.count()


@pytest.fixture(scope="session")
def server():
    reason = 'the extra is not installed: pip install -e ".[s3]" moto flask flask-cors'
    pytest.importorskip("s3fs", reason=reason)
    moto = pytest.importorskip("moto.server", reason=reason)
    running = moto.ThreadedMotoServer(ip_address="127.0.0.1", port=0, verbose=False)
    running.start()
    host, port = running.get_host_and_port()
    yield f"http://{host}:{port}"
    running.stop()


@pytest.fixture
def bucket(server, monkeypatch):
    """The address of an empty bucket; keys and endpoint are in the environment."""
    import fsspec

    monkeypatch.setenv("AWS_ENDPOINT_URL", server)
    monkeypatch.setenv("AWS_ACCESS_KEY_ID", KEY)
    monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", SECRET)
    monkeypatch.setenv("AWS_DEFAULT_REGION", "us-east-1")
    name = f"bucket{next(_NUMBERS)}"
    fsspec.filesystem("s3", use_listings_cache=False).mkdir(name)
    return f"s3://{name}"


@pytest.fixture
def data(bucket):
    return Objects(f"{bucket}/tires")


@pytest.fixture
def kedro(data, tmp_path):
    """Starts ``kedro run --env small`` with all data in the bucket."""
    conf = tmp_path / "conf"
    shutil.copytree(ROOT / "conf", conf)
    text = f"data: {data}\ntir_folder: {data}/01_raw/tir\n"
    (conf / "small" / "globals.yml").write_text(text)
    said = []

    def start(*arguments: str, program: Sequence[str] = ("-m", "kedro")) -> subprocess.Popen[str]:
        command = [sys.executable, *program, "run", "--env", "small", "--conf-source", str(conf)]
        log = (tmp_path / f"log{len(said)}").open("w+")
        said.append(log)
        here = {**os.environ, "OMP_NUM_THREADS": "1"}
        command += arguments
        process = subprocess.Popen(command, cwd=ROOT, env=here, stdout=log, stderr=log, text=True)
        process.said = lambda: Path(log.name).read_text()
        return process

    yield start
    for log in said:
        text = Path(log.name).read_text()
        assert SECRET not in text
        assert KEY not in text
    assert not (ROOT / "s3:").exists()
