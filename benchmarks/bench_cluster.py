"""Speed-up, overhead and memory with 1 and 2 workers of one thread: Dask and joblib side by side.

Measures reading files (blocks of 250), explaining recordings, and empty tasks. Each figure is stored when it
is there; another start goes on with the others. The whole is `--files 100000 --recordings 300 --rows 18000`,
then `--recordings 5000 --rows 500`: many hours. The default is a slice of minutes. Other work on the same
cores spoils the speed-up: the load is stored with each figure.

Run: python benchmarks/bench_cluster.py [--files 2000] [--recordings 4] [--rows 500] [--out FILE]
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import pandas as pd
import psutil

from tire_pipeline.atomic import write_bytes
from tire_pipeline.cluster.dask_map import close, dask_map
from tire_pipeline.cluster.parameters import ClusterParameters
from tire_pipeline.datasets import RecordingFolderDataset, TirFolderDataset
from tire_pipeline.reporting.explained_recordings import ExplainParameters, explain_each
from tire_pipeline.tasks import Map, in_processes
from tire_pipeline.tire_table.read_blocks import blocks_of

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples"
EMPTY = 300


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, default=2000)
    parser.add_argument("--recordings", type=int, default=4)
    parser.add_argument("--rows", type=int, default=500)
    parser.add_argument("--out", type=Path, default=ROOT / "benchmarks/results/bench_cluster.json")
    asked = parser.parse_args()
    found = json.loads(asked.out.read_text()) if asked.out.exists() else {}
    with tempfile.TemporaryDirectory() as place:
        jobs = make_jobs(Path(place), asked)
        for job, engine, workers in product(jobs, ("dask", "joblib"), (1, 2)):
            key = f"{job} | {engine} | {workers}"
            if key not in found:
                found[key] = measured(engine, workers, job, jobs[job], Path(place))
                asked.out.parent.mkdir(parents=True, exist_ok=True)
                write_bytes(asked.out, json.dumps(found, indent=1).encode())
            print(key, json.dumps(found[key]), flush=True)
    for job, engine in product(jobs, ("dask", "joblib")):
        one, two = (found[f"{job} | {engine} | {workers}"]["seconds"] for workers in (1, 2))
        print(f"{job} | {engine}: speed-up {one / two:.2f}")


def make_jobs(place: Path, asked: argparse.Namespace) -> dict[str, dict[str, Callable[[], Any]]]:
    """Files and recordings that differ from each other, and the tasks on them."""
    text = (EXAMPLE / "tire.tir").read_text()
    for number in range(asked.files):
        path = place / "tir" / "ABCD"[number % 4] / f"{number}.tir"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"$ number {number}\n{text}")
    whole = pd.read_csv(EXAMPLE / "rig_run.csv")
    for number in range(asked.recordings):
        folder = place / "recordings" / f"{number:04d}"
        folder.mkdir(parents=True)
        shutil.copy(EXAMPLE / "tire.tir", folder)
        repeated = pd.concat([whole] * (1 + asked.rows // len(whole)), ignore_index=True).head(asked.rows)
        repeated["time"] = range(len(repeated))
        repeated["time"] *= 0.01
        forces = [name for name in repeated if name in ("fx", "fy", "mz")]
        repeated[forces] *= 1.0 + 0.01 * number
        repeated.to_csv(folder / "run.csv", index=False)
    jobs: dict[str, Any] = {
        f"{EMPTY} tasks that do nothing": {str(number): partial(int, number) for number in range(EMPTY)}
    }
    if asked.files:
        jobs[f"read {asked.files} files"] = blocks_of(TirFolderDataset(path=str(place / "tir")).load())
    if asked.recordings:
        recordings = RecordingFolderDataset(path=str(place / "recordings")).load()
        name = f"explain {asked.recordings} recordings of {asked.rows} rows"
        jobs[name] = explain_each(recordings, ExplainParameters())
    return jobs


def measured(engine: str, workers: int, job: str, tasks: dict[str, Any], place: Path) -> dict[str, Any]:
    """Seconds in all and a task, the most memory of one process, and how busy the machine was."""
    with processes(workers, place) if engine == "dask" else no_cluster(workers) as work:
        list(work({f"warm {n}": partial(_imports, 1.0) for n in range(4 * workers)}, "warming up"))
        watch = Memory()
        began = time.perf_counter()
        for done in work(tasks, job):
            done.result()
        seconds = time.perf_counter() - began
        return {
            "seconds": round(seconds, 3),
            "milliseconds_a_task": round(1e3 * seconds / len(tasks), 2),
            "most_memory_mib": round(watch.end()),
            "load": round(os.getloadavg()[0], 1),
            "date": time.strftime("%Y-%m-%d"),
        }


def _imports(seconds: float) -> None:
    from tire_pipeline.mismatch import explain_recordings  # noqa: F401
    from tire_pipeline.tir import read_tir

    read_tir(EXAMPLE / "tire.tir")
    time.sleep(seconds)


class Memory:
    """The most resident memory (MiB) of this process or one below it, looked at twice a second."""

    def __init__(self) -> None:
        self._most = 0.0
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._look)
        self._thread.start()

    def _look(self) -> None:
        me = psutil.Process()
        while not self._stop.wait(0.5):
            for process in (me, *me.children(recursive=True)):
                try:
                    self._most = max(self._most, process.memory_info().rss / 2**20)
                except psutil.Error:
                    continue

    def end(self) -> float:
        self._stop.set()
        self._thread.join()
        return self._most


@contextmanager
def no_cluster(workers: int) -> Iterator[Map]:
    yield in_processes(workers)


@contextmanager
def processes(workers: int, place: Path) -> Iterator[Map]:
    """A scheduler and so many workers of one thread as processes of their own, on loopback."""
    with closing(socket.socket()) as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    parts = (
        ("scheduler", "--port", str(port)),
        ("worker", address, "--nworkers", str(workers), "--nthreads", "1"),
    )
    log = (place / "dask.log").open("ab")
    command = [sys.executable, "-m", "dask"]
    started = [
        subprocess.Popen(
            [*command, what, "--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0", *more],
            stdout=log,
            stderr=log,
            cwd=place,
            start_new_session=True,
        )
        for what, *more in parts
    ]
    try:
        yield dask_map(ClusterParameters(scheduler=address, wait_seconds=120))
    finally:
        close()
        for process in started:
            os.killpg(process.pid, signal.SIGTERM)
            process.wait(timeout=30)


if __name__ == "__main__":
    main()
