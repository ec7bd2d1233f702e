"""What a run holds of every file: by how much its most memory grows, from made-up data of two sizes.

Counted is what Python and numpy take at once (tracemalloc).

Run: python benchmarks/bench_memory.py [--files 5000 20000]
     python benchmarks/bench_memory.py --write    # into docs/how-to/cluster.md, nothing measured
"""

from __future__ import annotations

import argparse
import gc
import json
import tempfile
import time
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from doc_tables import markdown, write_between

from tire_pipeline.datasets import IngestStoreDataset
from tire_pipeline.files.atomic import write_bytes
from tire_pipeline.retraining import Manifest, ManifestEntry, Store

ROOT = Path(__file__).resolve().parents[1]
OUT, PAGE = ROOT / "benchmarks/results/bench_memory.json", ROOT / "docs/how-to/cluster.md"
DAY = 86_400_000_000_000
"""In ns."""


def manifest(count: int, place: Path) -> Callable[[], None]:
    """``retrain`` reads the manifest of all files, and stores it with another sequence number."""
    stored = IngestStoreDataset(path=str(place / "ingested"))
    hashes = (f"{number * 2654435761 % 2**256:064x}" for number in range(count))
    entries = {
        f"A/tire_{number:08d}.tir": ManifestEntry(sha, sha, 4000 + number, DAY * number, DAY * number, 1)
        for number, sha in enumerate(hashes)
    }
    stored.save(Store(Manifest(1, entries)))

    def run() -> None:
        known = stored.load()
        stored.save(replace(known, manifest=replace(known.manifest, sequence=2)))

    return run


STEPS = {"manifest": (manifest, "`retrain`: reads and stores its manifest", "file")}


def most_bytes(make: Callable[[int, Path], Callable[[], None]], count: int) -> int:
    """What one step takes at most."""
    with tempfile.TemporaryDirectory() as place:
        run = make(count, Path(place))
        gc.collect()
        tracemalloc.start()
        try:
            run()
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()


def table(found: dict[str, Any]) -> str:
    """The table of the documentation."""
    rows = []
    for step, (_, does, what) in STEPS.items():
        few, many = found[step]["files"]
        less, most = found[step]["most_bytes"]
        grows = f"{max(0.0, most - less) / (many - few) / 1e3:.2f} kB"
        rows.append([does, grows, what, f"{few:,} and {many:,}, {found[step]['date']}"])
    return markdown(["what", "most memory grows by", "for every", "measured on"], rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, nargs=2, default=(5_000, 20_000))
    parser.add_argument("--write", action="store_true", help="only put the table into the documentation")
    asked = parser.parse_args()
    if asked.write:
        write_between(PAGE, "<!-- bench_memory -->", table(json.loads(OUT.read_text())))
        return
    found = {}
    for step, (make, _, _) in STEPS.items():
        sizes = [most_bytes(make, count) for count in asked.files]
        found[step] = {"files": list(asked.files), "most_bytes": sizes, "date": time.strftime("%Y-%m-%d")}
    write_bytes(OUT, json.dumps(found, indent=1).encode())
    print(table(found))


if __name__ == "__main__":
    main()
