"""What ten million files cost on a hundred machines: by bench_cluster.py, and by what no worker takes over.

Measures the steps of ``ingest_tir`` that the run does itself - looks at the folder, stores what the workers
give, joins it - in processor seconds a file. Where much else runs, they are up to twice as many. Then the
most memory that Python and Arrow take for it at once, for half of the files and for all: what it grows by.

Run: python benchmarks/cluster_estimate.py [--files 32000]
     python benchmarks/cluster_estimate.py --write    # into docs/how-to/cluster.md, nothing measured
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
import tracemalloc
from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pyarrow
from bench_cluster import EMPTY, PAGE, ROOT, make_jobs
from doc_tables import write_between

from tire_pipeline.cluster import ClusterHooks
from tire_pipeline.datasets import (
    ComputedFolderDataset,
    ReportPartsDataset,
    TablePartsDataset,
    TirFolderDataset,
)
from tire_pipeline.files.atomic import write_bytes
from tire_pipeline.tasks import all_done, in_processes
from tire_pipeline.tire_table.in_pieces import PIECE_ROWS
from tire_pipeline.tire_table.read_files import IngestParameters, join_files, read_files

OUT = ROOT / "benchmarks/results/cluster_estimate.json"
CLUSTER = ROOT / "benchmarks/results/bench_cluster.json"
FILES, MACHINES, THREADS = 10_000_000, 100, 2
LOOK, JOIN = "looks at the folder", "stores and joins what the workers give"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, default=32_000)
    parser.add_argument("--write", action="store_true", help="only put the estimate into the documentation")
    asked = parser.parse_args()
    if not asked.write:
        write_bytes(OUT, json.dumps(measured(asked.files), indent=1).encode())
    cluster = json.loads(CLUSTER.read_text())
    alone = json.loads(OUT.read_text())
    text = estimate(cluster, alone)
    if asked.write:
        write_between(PAGE, "<!-- cluster_estimate -->", text)
        write_between(PAGE, "<!-- ingest_memory -->", memory(alone))
    print(text)


def measured(files: int) -> dict[str, Any]:
    """Processor seconds a file of each step that is this process's own, and the most memory of two sizes."""
    one_process = SimpleNamespace(config_loader={"parameters": {"cluster": {"processes": 1}}})
    ClusterHooks().after_context_created(one_process)
    most_memory = {}
    for some in (files // 2, files):
        with tempfile.TemporaryDirectory() as place:
            make_jobs(Path(place), some, 0, 0)
            blocks = read_files(TirFolderDataset(path=f"{place}/tir").load())
            parts = {n: done.result() for n, done in all_done(in_processes(2), blocks, "reading").items()}
            del blocks
            spent = _run_alone(Path(place) / "timed", Path(place), parts)
            most_memory[some] = _most_memory(Path(place), parts)
    return {
        "files": files,
        "processor_seconds_a_file": {step: seconds / files for step, seconds in spent.items()},
        "most_bytes": most_memory,
        "date": time.strftime("%Y-%m-%d"),
    }


def _run_alone(out: Path, place: Path, parts: Mapping[str, bytes]) -> dict[str, float]:
    """All steps of a run but those of its workers; it holds what a run holds while they work."""
    began = time.process_time()
    files = TirFolderDataset(path=str(place / "tir")).load()
    blocks = read_files(files)
    looked = time.process_time()
    stored = ComputedFolderDataset(path=str(out / "blocks"))
    stored.save({name: _Given(part) for name, part in parts.items()})
    del files, blocks
    table, report, _ = join_files(stored.load(), IngestParameters())
    TablePartsDataset(filepath=str(out / "raw.json")).save(table)
    stored_report = ReportPartsDataset(filepath=str(out / "report.json"))
    stored_report.save(report)
    with open(out / "report.csv", "w", encoding="utf-8", newline="") as stream:
        stored_report.write_plain(stream)
    return {LOOK: looked - began, JOIN: time.process_time() - looked}


def _most_memory(place: Path, parts: Mapping[str, bytes]) -> int:
    """Bytes of Python's and numpy's objects, and of Arrow's tables and texts, each where it is largest."""
    usual, watched = pyarrow.default_memory_pool(), pyarrow.proxy_memory_pool(pyarrow.default_memory_pool())
    pyarrow.set_memory_pool(watched)
    tracemalloc.start()
    try:
        _run_alone(place / "watched", place, parts)
        return tracemalloc.get_traced_memory()[1] + watched.max_memory()
    finally:
        tracemalloc.stop()
        pyarrow.set_memory_pool(usual)


class _Given:
    """A task whose result is there."""

    label = ""

    def __init__(self, part: bytes) -> None:
        self._part = part

    def __call__(self) -> bytes:
        return self._part


def _bytes_a_file(alone: dict[str, Any]) -> float:
    """What the most memory grows by."""
    (fewer, less), (more, most) = ((int(count), size) for count, size in alone["most_bytes"].items())
    return (most - less) / (more - fewer)


def memory(alone: dict[str, Any]) -> str:
    """What the run of ``ingest_tir`` holds."""
    fewer, more = map(int, alone["most_bytes"])
    return (
        "`ingest_tir` holds name, reader and place in a block of every file: "
        f"{_bytes_a_file(alone) / 1e3:.2g} kB a file, measured on {fewer:,} and {more:,} files "
        "with names such as `A/123.tir`."
    )


def estimate(cluster: dict[str, list[dict[str, Any]]], alone: dict[str, Any]) -> str:
    """The sentences of the documentation."""
    a_file_holds = _bytes_a_file(alone)
    files, reading = _largest(cluster)
    blocks = 1
    while blocks * 250 < FILES:
        blocks *= 2
    empty = cluster[f"{EMPTY} tasks that do nothing | dask | 2"]
    a_task = sum(each["seconds"] for each in empty) / sum(each["tasks"] for each in empty)
    a_file = alone["processor_seconds_a_file"]
    read = FILES * reading / (MACHINES * THREADS)
    own = {step: FILES * seconds for step, seconds in a_file.items()}
    own["hands over the blocks"] = blocks * a_task
    in_order = sorted(own.items(), key=lambda each: -each[1])
    steps = "; ".join(f"{step}: {_round(seconds)}" for step, seconds in in_order)
    whole = sum(own.values())
    slower = "The run takes" if whole > read else "The workers take"
    sentences = [
        f"A task that does nothing costs {1e3 * a_task:.2g} ms with Dask and two workers.\n\n"
        f"**An estimate for {FILES:,} files on {MACHINES} machines** of {THREADS} threads.",
        f"The workers read them in {_round(read)}: {1e3 * reading:.2g} ms a file with one thread, measured",
        f"on {files:,} files. The run itself takes {_round(whole)} of processor time, however many machines",
        f"there are ({steps}), measured on {alone['files']:,} files. {slower}",
        f"{max(whole, read) / min(whole, read):.0f} times as long.",
        "What breaks first is the run's memory, unless its machine has more:",
        f"it grows by {a_file_holds / 1e3:.2g} kB a file (see below), to",
        f"{FILES * a_file_holds / 1e9:.2g} GB. Next is the file server, which has to open",
        f"{_round_number(FILES / read)} files a second, or the workers wait for it. None of this was",
        f"tried.\n\nThere are {blocks:,} blocks of about {FILES / blocks:.0f} files (a power of two). What a",
        "block gives passes through the run's process three times: it is stored, its report is read, and its",
        f"rows are written into {FILES / PIECE_ROWS:,.0f} parts of the table.",
    ]
    return " ".join(sentences)


def _largest(cluster: dict[str, list[dict[str, Any]]]) -> tuple[int, float]:
    """The largest number of files that was read by Dask with one worker, and seconds a file."""
    found = {}
    for key, parts in cluster.items():
        job, engine, workers = key.split(" | ")
        if job.startswith("read ") and (engine, workers) == ("dask", "1") and parts:
            files = int(job.split()[1])
            share = sum(each["tasks"] for each in parts) / parts[0]["of"]
            found[files] = sum(each["seconds"] for each in parts) / (share * files)
    files = max(found)
    return files, found[files]


def _round(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 120.0 else f"{seconds / 60.0:.2g} min"


def _round_number(value: float) -> str:
    return f"{float(f'{value:.2g}'):,.0f}"


if __name__ == "__main__":
    main()
