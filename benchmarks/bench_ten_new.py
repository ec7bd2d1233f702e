"""Seconds to take ten new files in beside many that are known: look, compare, read, store (no training).

The known files are empty and their entries and rows made up, as they are not read: that is the point.

Run: python benchmarks/bench_ten_new.py [100000]
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from pathlib import Path

import numpy as np
import pandas as pd

from tire_pipeline.datasets import IngestStoreDataset
from tire_pipeline.retraining import Manifest, ManifestEntry, Store, difference, ingest, look_at
from tire_pipeline.retraining.stored_table.partition import Partition
from tire_pipeline.tire_table import KNOWN_COEFFICIENTS, SIZE_KEYS, physical_tire_ids

NEW = "[MODEL]\nFITTYP = 6\n[VERTICAL]\nFNOMIN = 4000\n"
NEW += "[LATERAL_COEFFICIENTS]\nPCY1 = 1.3\nPDY1 = 0.9{}\nPKY1 = -20\n"
COLUMNS = list(dict.fromkeys([*KNOWN_COEFFICIENTS[:140], *SIZE_KEYS, "RIM_WIDTH", "NOMPRES", "FNOMIN"]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("known", type=int, nargs="?", default=100_000)
    known = parser.parse_args().known
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "tir"
        dataset = IngestStoreDataset(path=str(Path(place) / "ingested"))
        dataset.save(made_up(folder, known))
        for number in range(10):
            (folder / f"A/new{number}.tir").write_text(NEW.format(number))
        wall, processor = time.perf_counter(), time.process_time()
        store = dataset.load()
        found = difference(folder, store.manifest, settle_seconds=0.0)
        dataset.save(ingest(store, folder, found)[0])
        taken = {"seconds": time.perf_counter() - wall, "processor_seconds": time.process_time() - processor}
        rows = len(dataset.load().table)
    print(json.dumps({"known": known, "new": len(found.added), "rows": rows, **taken}))


def made_up(folder: Path, known: int) -> Store:
    """A store that says all these files were read."""
    for number in range(known):
        path = folder / "ABCDEF"[number % 6] / f"{number}.tir"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    looks = look_at(folder)
    entries = {
        name: ManifestEntry(f"{i:064x}", f"{i:064x}", look.size, look.mtime_ns, look.ctime_ns, 1)
        for i, (name, look) in enumerate(looks.items())
    }
    table = pd.DataFrame(np.random.default_rng(0).random((known, len(COLUMNS))), columns=COLUMNS)
    names = pd.Series(sorted(looks), dtype="str")
    texts = {"file": names, "category": names.str[0], "version": pd.Series(["5.2"] * known, dtype="str")}
    table = pd.concat([pd.DataFrame(texts), table], axis=1)
    return Store(Manifest(1, entries), Partition.of(table.assign(tire_id=physical_tire_ids(table))))


if __name__ == "__main__":
    main()
