"""What a run holds of every file: by how much its most memory grows, from made-up data of two sizes.

Counted is what Python and numpy take at once (tracemalloc) in the run's own process.

Run: python benchmarks/bench_memory.py [--files 5000 20000] [--only look]
     PYTHONPATH=other/src python benchmarks/bench_memory.py --only look --before    # of a former version
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
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from doc_tables import markdown, write_between

from tire_pipeline.command.stored import translator_state
from tire_pipeline.datasets import (
    CsvTableDataset,
    FramePartsDataset,
    HtmlPageDataset,
    IngestStoreDataset,
    ReportPartsDataset,
    TextFolderDataset,
    TirFolderDataset,
)
from tire_pipeline.files.atomic import write_bytes
from tire_pipeline.files.packed import pack
from tire_pipeline.reporting.mismatch.explained_recordings import collect_explained
from tire_pipeline.reporting.mismatch.mismatch_overview import draw_overview, rows_to_keep
from tire_pipeline.reporting.translation.translated_folder_page import translate_page
from tire_pipeline.retraining import Manifest, ManifestEntry, Store
from tire_pipeline.tire_table.one_nominal_load import NormalizeParameters
from tire_pipeline.translation.curves.of_files import DRAWN_OUTPUTS
from tire_pipeline.translation.files.chosen_files import choose_files
from tire_pipeline.translation.files.translated_block import BAND_COLUMNS, TranslatedPart, packed_part
from tire_pipeline.translation.files.translated_folder import (
    TRANSLATED_TOGETHER,
    join_translated,
    translate_each,
)
from tire_pipeline.translation.parameters import TranslateParameters

ROOT = Path(__file__).resolve().parents[1]
STORED = ROOT / "tests/data_of_0_1"
"""Training data and a fitted translator."""
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


def look(count: int, place: Path) -> Callable[[], None]:
    """``translate`` looks at the folder, and divides the files into tasks."""
    for number in range(count):
        file = place / f"tir/{'ABCEF'[number % 5]}/tire_{number:08d}.tir"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    (training,) = STORED.glob("03_primary/normalized_table.parquet/*/*.parquet")
    table, asked = pd.read_parquet(training), TranslateParameters()

    def run() -> None:
        chosen = choose_files(TirFolderDataset(path=str(place / "tir")).load(), asked)
        translate_each(_translator(), chosen, table, asked, NormalizeParameters(), 0)

    return run


def join(count: int, place: Path) -> Callable[[], None]:
    """``translate`` joins what its tasks gave (made up here), and writes files, report, tables and page."""
    parts: dict[str, Callable[[], bytes]] = {}
    for start in range(0, count, TRANSLATED_TOGETHER):
        some = range(start, min(start + TRANSLATED_TOGETHER, count))
        stored = place / f"{start}.zip"
        stored.write_bytes(_made_part([f"{'ABCEF'[number % 5]}/tire_{number:08d}.tir" for number in some]))
        parts[stored.name] = stored.read_bytes
    return partial(_join, str(place), parts)


def _join(place: str, parts: dict[str, Callable[[], bytes]]) -> None:
    asked = TranslateParameters()
    files, report, *tables, protocols = join_translated(parts, _translator(), asked)
    TextFolderDataset(path=f"{place}/translated").save(files)
    stored = ReportPartsDataset(filepath=f"{place}/report/index.json")
    stored.save(report)
    del files, report
    for number, table in enumerate(tables):
        FramePartsDataset(filepath=f"{place}/{number}/index.json").save(table)
    page, _ = translate_page(stored.load(), parts, protocols, [], asked, "D")
    HtmlPageDataset(filepath=f"{place}/page.html").save(page)


def _translator() -> dict[str, Any]:
    return dict(translator_state(STORED / "06_models/translator.npz")[0])


def _made_part(files: list[str]) -> TranslatedPart:
    """What a task gives of files that were translated."""
    said = {"source": "A", "target": "D", "verdict": "translated", "reason": "", "protocol": ""}
    numbers = dict.fromkeys(("source_probability", "distance", "expected_rms_ratio", "harm_probability"), 0.5)
    words = dict.fromkeys(("supplier_known", "bias_band", "changes"), "100 characters" * 7)
    shape = (len(files), 2, 3)
    curves: dict[str, Any] = {"files": files, "normal_load": np.ones(2), "slip": np.arange(3.0)}
    for part in ("source", "middle", "low", "high"):
        curves |= {f"{output}_{part}": np.ones(shape, np.float32) for output in DRAWN_OUTPUTS}
        curves[f"stiffness_{part}"] = np.ones(shape[:2], np.float32)
    tables = {
        "sources": pd.DataFrame({"file": files, "tire_id": "tire"}),
        "report": pd.DataFrame({"file": files, **said, **numbers, **words, "taught": 0}),
        "coefficients": pd.DataFrame(columns=["file", "coefficient", "from", "to"]),
        "bands": pd.DataFrame(columns=list(BAND_COLUMNS)),
    }
    return packed_part(tables, curves, [], dict.fromkeys(files, b"text"), TranslatedPart)


def splits(count: int, place: Path) -> Callable[[], None]:
    """The table of training and test sets is written and read."""
    stored = CsvTableDataset(filepath=str(place / "splits.csv"), save_args={"index": False})
    side = np.where(np.arange(count) % 5, "train", "test")

    def run() -> None:
        files = [f"A/tire_{number:08d}.tir" for number in range(count)]
        stored.save(pd.DataFrame({"file": files, "random": side, "by_tire": side}))
        stored.load().set_index("file")

    return run


def overview(count: int, place: Path) -> Callable[[], None]:
    """``explain_mismatch`` joins what its tasks gave (made up here), notes it, and draws the page of all."""
    report = {"report.json": b"{}", "page.html": b"<p>", "a_corrected.tir": b"text"}
    explained = {}
    for number in range(count):
        row = {"recording": f"rig/recording_{number:06d}.csv", "verdict": "explained"}
        row |= {"effects": "hidden_load", "summary": "a hidden load of 210 N explains 93%. " * 8}
        explained[f"{number:06d}.zip"] = partial(pack, {"row.json": json.dumps(row).encode(), **report})

    def run() -> None:
        _, table, pages, _ = collect_explained(explained)
        stored = ReportPartsDataset(filepath=f"{place}/overview/index.json")
        stored.save(table)
        del table
        kept = TextFolderDataset(path=f"{place}/rows", suffix=".json", keep=True)
        kept.save(rows_to_keep(stored.load()))
        page, _ = draw_overview(stored.load(), list(pages), kept.load())
        HtmlPageDataset(filepath=f"{place}/page.html").save(page)

    return run


STEPS = {
    "look": (look, "`translate`: looks at the folder", "file"),
    "join": (join, "`translate`: writes files, report, tables and page", "translated file"),
    "manifest": (manifest, "`retrain`: reads and stores its manifest", "file"),
    "splits": (splits, "`bin`: writes `splits`, and reads them again", "training file"),
    "overview": (overview, "`explain_mismatch`: joins, notes and lists what it found", "recording"),
}


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
        if "files" not in found.get(step, {}):
            continue
        few, many = found[step]["files"]
        before = _growth(found[step]["before"]) if "before" in found[step] else "–"
        measured = f"{few:,} and {many:,}, {found[step]['date']}"
        rows.append([does, _growth(found[step]), before, what, measured])
    return markdown(["what", "most memory grows by", "before", "for every", "measured on"], rows)


def _growth(found: dict[str, Any]) -> str:
    few, many = found["files"]
    less, most = found["most_bytes"]
    return f"{max(0.0, most - less) / (many - few) / 1e3:.2f} kB"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, nargs=2, default=(5_000, 20_000))
    parser.add_argument("--only", choices=list(STEPS), help="measure this step; the others stay as they were")
    parser.add_argument("--before", action="store_true", help="what is imported is a former version")
    parser.add_argument("--write", action="store_true", help="only put the table into the documentation")
    asked = parser.parse_args()
    if asked.write:
        write_between(PAGE, "<!-- bench_memory -->", table(json.loads(OUT.read_text())))
        return
    found = json.loads(OUT.read_text()) if OUT.exists() else {}
    for step, (make, _, _) in STEPS.items():
        if asked.only not in (None, step):
            continue
        most_bytes(make, asked.files[0])  # what is imported or grows once does not count
        sizes = [most_bytes(make, count) for count in asked.files]
        new = {"files": list(asked.files), "most_bytes": sizes, "date": time.strftime("%Y-%m-%d")}
        earlier = found.get(step, {})
        if asked.before:
            found[step] = {**earlier, "before": new}
        else:
            found[step] = {**new, **({"before": earlier["before"]} if "before" in earlier else {})}
    write_bytes(OUT, json.dumps(found, indent=1).encode())
    print(table(found))


if __name__ == "__main__":
    main()
