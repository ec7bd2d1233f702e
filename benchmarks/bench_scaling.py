"""Seconds and memory from ingest to evaluation, and of a retraining on ten new files, for growing folders.

The files are those of a small demonstration fleet, repeated with one coefficient changed in each, so that
none is dropped as a double. Every run is a process of its own, as users start it; memory is the largest
sum over it and its workers, looked at twice a second (shared pages are counted once, Linux only).

Run: python benchmarks/bench_scaling.py [1000 10000 100000] [--out folder]
"""

from __future__ import annotations

import argparse
import contextlib
import itertools
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIMIT_GIB = 2.0
VARIED = re.compile(rb"^(\s*PKY1\s*=\s*)([-+0-9.eE]+)", re.M)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", type=int, nargs="*", default=[1000, 10_000, 100_000])
    parser.add_argument("--out", type=Path, help="folder for bench_scaling.json")
    parser.add_argument("--part", choices=["all", "retrain"], default="all")
    options = parser.parse_args()
    rows = []
    for count in options.files:
        with tempfile.TemporaryDirectory() as folder:
            rows.append(measured(Path(folder), count, options.part))
        print(json.dumps(rows[-1]), flush=True)
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        (options.out / "bench_scaling.json").write_text(json.dumps(rows, indent=1))
    for before, after in itertools.pairwise(rows):
        for name in ("ingest_to_evaluate_s", "retrain_first_s"):
            if name in after:
                files, times = after["files"] / before["files"], after[name] / before[name]
                print(f"{after['files']} files: {files:.1f}x the files, {times:.1f}x {name}")
    largest = max(value for row in rows for name, value in row.items() if name.endswith("GiB"))
    print(f"largest memory: {largest:.2f} GiB, limit {LIMIT_GIB} GiB")
    sys.exit(largest > LIMIT_GIB)


def measured(folder: Path, count: int, part: str) -> dict[str, float]:
    """All runs on one folder of ``count`` files."""
    shutil.copytree(ROOT / "conf", folder / "conf")
    data = folder / "data"
    (folder / "conf/small/globals.yml").write_text(f"data: {data}\ntir_folder: {data}/01_raw/tir\n")
    run(folder, "--pipeline", "make_fleet")
    tir = data / "01_raw/tir"
    texts = {path.relative_to(tir): path.read_bytes() for path in sorted(tir.rglob("*.tir"))}
    texts = {name: text for name, text in texts.items() if VARIED.search(text)}
    shutil.rmtree(tir)
    write(tir, texts, range(count))
    row: dict[str, float] = {"files": count}
    if part == "all":
        row |= named("ingest_to_evaluate", run(folder), count)
    row |= named("retrain_first", run(folder, "--pipeline", "retrain"), count)
    write(tir, texts, range(count, count + 10))
    row |= named("retrain_ten_new", run(folder, "--pipeline", "retrain"), 10)
    return row


def write(tir: Path, texts: dict[Path, bytes], numbers: range) -> None:
    """Variants of the fleet's files; each has its own PKY1."""
    names = list(texts)
    for number in numbers:
        name = names[number % len(names)]
        scale = 1.0 + 1e-6 * number
        text = VARIED.sub(lambda m, scale=scale: m[1] + b"%.12g" % (float(m[2]) * scale), texts[name])
        target = tir / name.parent / f"{name.stem}_{number:06d}.tir"
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(text)


def run(folder: Path, *arguments: str) -> tuple[float, float]:
    """Seconds and GiB of one ``kedro run``."""
    command = [sys.executable, "-m", "kedro", "run", "--env", "small", "--conf-source", str(folder / "conf")]
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    start = time.perf_counter()
    with (folder / "log.txt").open("w") as log:
        process = subprocess.Popen(
            [*command, *arguments], cwd=ROOT, env=environment, stdout=log, stderr=subprocess.STDOUT
        )
        memory = Memory(process.pid)
        status = process.wait()
    if status:
        raise SystemExit((folder / "log.txt").read_text()[-3000:])
    return time.perf_counter() - start, memory.peak / 2**20


class Memory(threading.Thread):
    """Largest memory of a process and all that it started, in KiB, while it lives."""

    def __init__(self, pid: int) -> None:
        super().__init__(daemon=True)
        self.pid, self.peak = pid, 0
        self.start()

    def run(self) -> None:
        while Path(f"/proc/{self.pid}/smaps_rollup").exists():
            self.peak = max(self.peak, sum(map(proportional_set, family(self.pid))))
            time.sleep(0.5)


def family(pid: int) -> list[int]:
    """A process and all below it."""
    children: list[str] = []
    with contextlib.suppress(OSError):  # it has just ended
        for thread in Path(f"/proc/{pid}/task").glob("*/children"):
            children += thread.read_text().split()
    return [pid, *(each for child in children for each in family(int(child)))]


def proportional_set(pid: int) -> int:
    """KiB of one process; a page that several share counts as their share of it."""
    try:
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) for line in lines if line.startswith("Pss:")), 0)


def named(name: str, result: tuple[float, float], files: int) -> dict[str, float]:
    """Totals, and per file."""
    seconds, memory = result
    return {
        f"{name}_s": round(seconds, 2),
        f"{name}_GiB": round(memory, 3),
        f"{name}_ms_a_file": round(1e3 * seconds / files, 3),
    }


if __name__ == "__main__":
    main()
