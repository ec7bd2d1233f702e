"""Speed-up, overhead and memory with 1 and 2 workers of one thread: Dask and joblib side by side.

Measures tasks that do nothing, reading files (blocks of about 200) and explaining recordings. A call takes
about ``--minutes`` and stores what it measured; the next one goes on there, until all is measured.
Other work on the same cores spoils the speed-up: the load and the processor time are stored, too.

Run: python benchmarks/bench_cluster.py --all      # 100,000 files, 300 and 5,000 recordings: many calls
     python benchmarks/bench_cluster.py [--files 2000] [--recordings 4] [--rows 500] [--minutes 9] [--again]
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

from tire_pipeline.cluster.dask_map import close, dask_map
from tire_pipeline.cluster.parameters import ClusterParameters
from tire_pipeline.datasets import RecordingFolderDataset, TirFolderDataset
from tire_pipeline.files.atomic import write_bytes
from tire_pipeline.reporting.mismatch.explained_recordings import ExplainParameters, explain_each
from tire_pipeline.tasks import Map, in_processes
from tire_pipeline.tire_table.read_blocks import blocks_of

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples"
PAGE = ROOT / "docs/how-to/cluster.md"
EMPTY = 300
LEAST_SECONDS = 5.0
"""A piece takes so long, if there is so much: in a shorter one its beginning and end weigh too much."""
WHOLE = [(100_000, 0, 0), (0, 300, 18_000), (0, 5000, 500)]
Found = dict[str, list[dict[str, Any]]]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--all", action="store_true", help="what the issue asks for: a day, in many calls")
    parser.add_argument("--write", action="store_true", help="only put the table into the documentation")
    parser.add_argument("--again", action="store_true", help="forget what is stored of these jobs")
    parser.add_argument("--files", type=int, default=2000)
    parser.add_argument("--recordings", type=int, default=4)
    parser.add_argument("--rows", type=int, default=500)
    parser.add_argument("--minutes", type=float, default=9.0, help="how long this call may take, about")
    parser.add_argument("--out", type=Path, default=ROOT / "benchmarks/results/bench_cluster.json")
    asked = parser.parse_args()
    end = time.monotonic() + 60.0 * asked.minutes
    found: Found = json.loads(asked.out.read_text()) if asked.out.exists() else {}
    if asked.write:
        write_between(PAGE, "<!-- bench_cluster -->", table(found))
        return
    wanted = WHOLE if asked.all else [(asked.files, asked.recordings, asked.rows)]
    for files, recordings, rows in wanted:
        if time.monotonic() > end:
            break
        if not asked.again and all(_whole(found, job) for job in titles(files, recordings, rows).values()):
            continue
        with tempfile.TemporaryDirectory() as place:
            jobs = make_jobs(Path(place), files, recordings, rows)
            if asked.again:
                found = {key: each for key, each in found.items() if key.split(" | ")[0] not in jobs}
            measure(Path(place), jobs, found, asked.out, end)
    print(table(found))


def measure(place: Path, jobs: dict[str, Any], found: Found, out: Path, end: float) -> None:
    """Measure a piece of all that is not whole yet, each in its share of the time that is left."""
    every = [
        (job, engine, workers, found.setdefault(f"{job} | {engine} | {workers}", []))
        for job, engine, workers in product(jobs, ("dask", "joblib"), (1, 2))
    ]
    every = [each for each in every if _sum(each[-1], "tasks") < len(jobs[each[0]])]
    for number, (job, engine, workers, done) in enumerate(every):
        last = time.monotonic() + (end - time.monotonic()) / (len(every) - number)
        names = list(jobs[job])
        with processes(workers, place) if engine == "dask" else no_cluster(workers) as work:
            seconds = warm(work, jobs[job][names[0]], workers)
            if done:
                seconds = _sum(done, "seconds") * workers / _sum(done, "tasks")
            first = _sum(done, "tasks")
            turns = max(int(max(last - time.monotonic(), LEAST_SECONDS) / seconds), 1)
            piece = {name: jobs[job][name] for name in names[first : first + workers * turns]}
            done.append(measured(work, piece, job) | {"of": len(names)})
        out.parent.mkdir(parents=True, exist_ok=True)
        write_bytes(out, json.dumps(found, indent=1).encode())
        print(job, engine, workers, json.dumps(done[-1]), flush=True)


def titles(files: int, recordings: int, rows: int) -> dict[str, str]:
    """Names of the jobs."""
    named = {
        "nothing": f"{EMPTY} tasks that do nothing",
        "files": f"read {files} files" if files else "",
        "recordings": f"explain {recordings} recordings of {rows} rows" if recordings else "",
    }
    return {each: title for each, title in named.items() if title}


def _whole(found: Found, job: str) -> bool:
    per = [each for key, each in found.items() if key.startswith(f"{job} | ")]
    return len(per) == 4 and all(each and _sum(each, "tasks") == each[0]["of"] for each in per)


def warm(work: Map, task: Any, workers: int) -> float:
    """Have each worker do the first task, which imports and compiles; seconds of the second time."""
    for _ in range(2):
        began = time.perf_counter()
        for done in work({f"warm {number}": task for number in range(workers)}, "warming up"):
            done.result()
    return time.perf_counter() - began


def table(found: Found) -> str:
    """One job a row. As long as not all of its tasks are measured, seconds are those of one task."""
    jobs = list(dict.fromkeys(key.split(" | ")[0] for key in found))
    rows = []
    for job in jobs:
        per = {key.split(" | ", 1)[1]: each for key, each in found.items() if key.startswith(f"{job} | ")}
        every = [each for part in per.values() for each in part]
        row = [job]
        for engine in ("dask", "joblib"):
            both = [per.get(f"{engine} | {workers}", []) for workers in (1, 2)]
            row += [_seconds(each) for each in both]
            row.append(f"{_rate(both[0]) / _rate(both[1]):.2f}" if all(both) else "")
        row.append(_beside(per.get("dask | 2", [])))
        row.append(f"{max(max(each['most_memory_mib'].values()) for each in every)} MiB")
        row.append(f"{min(each['load'] for each in every)} to {max(each['load'] for each in every)}")
        rows.append(row)
    head = ["", "Dask, one", "two", "speed-up", "joblib, one", "two", "speed-up"]
    return markdown([*head, "beside the workers", "most memory of a process", "load"], rows)


def _seconds(parts: list[dict[str, Any]]) -> str:
    if not parts:
        return ""
    done, of = _sum(parts, "tasks"), parts[0]["of"]
    if done == of:
        return f"{_sum(parts, 'seconds'):.3g} s"
    return f"{_rate(parts):.3g} s a task ({done} of {of})"


def _rate(parts: list[dict[str, Any]]) -> float:
    return float(_sum(parts, "seconds") / _sum(parts, "tasks"))


def _beside(parts: list[dict[str, Any]]) -> str:
    """Processor time of run, scheduler and nannies as a share of that of the workers."""
    total = {who: sum(part["processor_seconds"].get(who, 0.0) for part in parts) for who in ROLES}
    workers = total.pop("workers")
    return f"{sum(total.values()) / workers:.1%}" if workers else ""


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
    titled = titles(files, recordings, rows)
    jobs: dict[str, Any] = {titled["nothing"]: {str(number): partial(int, number) for number in range(EMPTY)}}
    if files:
        jobs[titled["files"]] = blocks_of(TirFolderDataset(path=str(place / "tir")).load())
    if recordings:
        found = RecordingFolderDataset(path=str(place / "recordings")).load()
        jobs[titled["recordings"]] = explain_each(found, ExplainParameters())
    return jobs


def measured(work: Map, tasks: dict[str, Any], job: str) -> dict[str, Any]:
    """Seconds, and by role: processor seconds and the most memory of a process; how busy the machine was."""
    watch, before = Watch(), _processor_seconds()
    began = time.perf_counter()
    for done in work(tasks, job):
        done.result()
    seconds = time.perf_counter() - began
    after = _processor_seconds()
    return {
        "tasks": len(tasks),
        "seconds": round(seconds, 3),
        "processor_seconds": {who: round(after[who] - before.get(who, 0.0), 2) for who in after},
        "most_memory_mib": watch.end(),
        "load": round(os.getloadavg()[0], 1),
        "date": time.strftime("%Y-%m-%d"),
    }


ROLES = ("run", "scheduler", "nannies", "workers")


def _by_role() -> Iterator[tuple[str, psutil.Process]]:
    """This process and those below it that are alive."""
    me = psutil.Process()
    yield "run", me
    for process in me.children(recursive=True):
        with suppress(psutil.Error):
            command = " ".join(process.cmdline())
            if "resource_tracker" not in command:
                parts = (("dask scheduler", "scheduler"), ("dask worker", "nannies"))
                yield next((role for part, role in parts if part in command), "workers"), process


def _processor_seconds() -> dict[str, float]:
    total: dict[str, float] = {}
    for role, process in _by_role():
        with suppress(psutil.Error):
            times = process.cpu_times()
            total[role] = total.get(role, 0.0) + times.user + times.system
    return total


class Watch:
    """The most resident memory (MiB) of one process of each role, looked at twice a second."""

    def __init__(self) -> None:
        self._most: dict[str, int] = {}
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._look)
        self._thread.start()

    def _look(self) -> None:
        while True:
            for role, process in _by_role():
                with suppress(psutil.Error):
                    size = round(process.memory_info().rss / 2**20)
                    self._most[role] = max(self._most.get(role, 0), size)
            if self._stop.wait(0.5):
                return

    def end(self) -> dict[str, int]:
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
    parts = (  # a call that is killed leaves them: they end by themselves, and spoil no later one
        ("scheduler", "--port", str(port), "--idle-timeout", "120"),
        ("worker", address, "--nworkers", str(workers), "--nthreads", "1", "--death-timeout", "60"),
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
