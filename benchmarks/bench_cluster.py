"""Speed-up, overhead and memory with 1 and 2 workers of one thread: Dask and joblib side by side.

Measures tasks that do nothing, reading files (blocks of about 200) and explaining recordings. The work is
done a hundred tasks at a time, and what each hundred took is stored: whatever is interrupted goes on there.
Other work on the same cores spoils the speed-up: the load and the processor time are stored, too.

Run: python benchmarks/bench_cluster.py --all      # 100,000 files, 300 and 5,000 recordings
     python benchmarks/bench_cluster.py [--files 2000] [--recordings 4] [--rows 500] [--out FILE]
     python benchmarks/bench_cluster.py --write    # the table of docs/how-to/cluster.md, nothing measured
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
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import pandas as pd
import psutil
from doc_tables import markdown, write_between

from tire_pipeline.atomic import write_bytes
from tire_pipeline.cluster.dask_map import close, dask_map
from tire_pipeline.cluster.parameters import ClusterParameters
from tire_pipeline.datasets import RecordingFolderDataset, TirFolderDataset
from tire_pipeline.reporting.explained_recordings import ExplainParameters, explain_each
from tire_pipeline.tasks import Map, in_processes
from tire_pipeline.tire_table.read_blocks import blocks_of

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples"
PAGE = ROOT / "docs/how-to/cluster.md"
EMPTY = 300
TOGETHER = 100
WHOLE = [(100_000, 300, 18_000), (0, 5000, 500)]
Found = dict[str, list[dict[str, Any]]]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--all", action="store_true", help="what the issue asks for: many hours")
    parser.add_argument("--write", action="store_true", help="only put the table into the documentation")
    parser.add_argument("--files", type=int, default=2000)
    parser.add_argument("--recordings", type=int, default=4)
    parser.add_argument("--rows", type=int, default=500)
    parser.add_argument("--out", type=Path, default=ROOT / "benchmarks/results/bench_cluster.json")
    asked = parser.parse_args()
    found: Found = json.loads(asked.out.read_text()) if asked.out.exists() else {}
    if asked.write:
        write_between(PAGE, "<!-- bench_cluster -->", table(found))
        return
    wanted = WHOLE if asked.all else [(asked.files, asked.recordings, asked.rows)]
    for files, recordings, rows in wanted:
        with tempfile.TemporaryDirectory() as place:
            measure(Path(place), make_jobs(Path(place), files, recordings, rows), found, asked.out)
    print(table(found))


def measure(place: Path, jobs: dict[str, Any], found: Found, out: Path) -> None:
    """Do what is not there yet, and store what it took."""
    for job, engine, workers in product(jobs, ("dask", "joblib"), (1, 2)):
        done = found.setdefault(f"{job} | {engine} | {workers}", [])
        names = list(jobs[job])[sum(each["tasks"] for each in done) :]
        if not names:
            continue
        with processes(workers, place) if engine == "dask" else no_cluster(workers) as work:
            list(work({f"warm {n}": partial(_imports, 1.0) for n in range(4 * workers)}, "warming up"))
            for start in range(0, len(names), TOGETHER):
                tasks = {name: jobs[job][name] for name in names[start : start + TOGETHER]}
                done.append(measured(work, tasks, job))
                out.parent.mkdir(parents=True, exist_ok=True)
                write_bytes(out, json.dumps(found, indent=1).encode())
                print(job, engine, workers, json.dumps(done[-1]), flush=True)


def table(found: Found) -> str:
    """What is complete, one job a row; a job of which a part is missing says how much there is."""
    jobs = list(dict.fromkeys(key.split(" | ")[0] for key in found))
    rows = []
    for job in jobs:
        per = {key.split(" | ", 1)[1]: each for key, each in found.items() if key.startswith(f"{job} | ")}
        most = max(_sum(each, "tasks") for each in per.values())
        row = [job]
        for engine in ("dask", "joblib"):
            both = [per.get(f"{engine} | {workers}", []) for workers in (1, 2)]
            whole = [_sum(each, "tasks") == most for each in both]
            row += [
                f"{_sum(each, 'seconds'):.3g} s" if ok else f"{_sum(each, 'tasks')} of {most}"
                for each, ok in zip(both, whole, strict=True)
            ]
            row.append(f"{_sum(both[0], 'seconds') / _sum(both[1], 'seconds'):.2f}" if all(whole) else "")
        every = [each for part in per.values() for each in part]
        row.append(f"{max(each['most_memory_mib'] for each in every)} MiB")
        row.append(f"{min(each['load'] for each in every)} to {max(each['load'] for each in every)}")
        rows.append(row)
    head = ["", "Dask, one", "two", "speed-up", "joblib, one", "two", "speed-up", "most memory of a process"]
    return markdown([*head, "load"], rows)


def _sum(parts: list[dict[str, Any]], what: str) -> Any:
    return sum(part[what] for part in parts)


def make_jobs(place: Path, files: int, recordings: int, rows: int) -> dict[str, Any]:
    """Files and recordings that differ from each other, and the tasks on them."""
    text = (EXAMPLE / "tire.tir").read_text()
    for number in range(files):
        path = place / "tir" / "ABCD"[number % 4] / f"{number}.tir"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"$ number {number}\n{text}")
    whole = pd.read_csv(EXAMPLE / "rig_run.csv")
    for number in range(recordings):
        folder = place / "recordings" / f"{number:04d}"
        folder.mkdir(parents=True)
        shutil.copy(EXAMPLE / "tire.tir", folder)
        repeated = pd.concat([whole] * (1 + rows // len(whole)), ignore_index=True).head(rows)
        repeated["time"] = range(len(repeated))
        repeated["time"] *= 0.01
        forces = [name for name in repeated if name in ("fx", "fy", "mz")]
        repeated[forces] *= 1.0 + 0.02 * number / recordings  # still the same tire
        repeated.to_csv(folder / "run.csv", index=False)
    jobs: dict[str, Any] = {
        f"{EMPTY} tasks that do nothing": {str(number): partial(int, number) for number in range(EMPTY)}
    }
    if files:
        jobs[f"read {files} files"] = blocks_of(TirFolderDataset(path=str(place / "tir")).load())
    if recordings:
        found = RecordingFolderDataset(path=str(place / "recordings")).load()
        jobs[f"explain {recordings} recordings of {rows} rows"] = explain_each(found, ExplainParameters())
    return jobs


def measured(work: Map, tasks: dict[str, Any], job: str) -> dict[str, Any]:
    """Seconds, processor seconds, the most memory of one process, and how busy the machine was."""
    watch, before = Watch(), _processor_seconds()
    began = time.perf_counter()
    for done in work(tasks, job):
        done.result()
    seconds = time.perf_counter() - began
    return {
        "tasks": len(tasks),
        "seconds": round(seconds, 3),
        "processor_seconds": round(_processor_seconds() - before, 3),
        "most_memory_mib": round(watch.end()),
        "load": round(os.getloadavg()[0], 1),
        "date": time.strftime("%Y-%m-%d"),
    }


def _processor_seconds() -> float:
    """Of this process and of all below it that are alive."""
    me = psutil.Process()
    total = 0.0
    for process in (me, *me.children(recursive=True)):
        with suppress(psutil.Error):
            times = process.cpu_times()
            total += times.user + times.system
    return total


def _imports(seconds: float) -> None:
    from tire_pipeline.mismatch import explain_recordings  # noqa: F401
    from tire_pipeline.tir import read_tir

    read_tir(EXAMPLE / "tire.tir")
    time.sleep(seconds)


class Watch:
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
                with suppress(psutil.Error):
                    self._most = max(self._most, process.memory_info().rss / 2**20)

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
