"""Small .tir files for the retraining tests: two organisations measure the same tires with their own bias."""

from __future__ import annotations

import os
import time
from pathlib import Path

import numpy as np

from tire_pipeline.files.rows_on_disk import joined
from tire_pipeline.retraining import Store, difference, ingest
from tire_pipeline.tire_table.read_files import IngestParameters, join_files, read_files

BIAS = {"A": 0.10, "B": -0.10, "D": 0.0}
HEAD = """[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
[MODEL]
FITTYP = 6
[DIMENSION]
UNLOADED_RADIUS = {radius}
WIDTH = {width}
ASPECT_RATIO = 0.55
RIM_RADIUS = 0.2032
[INERTIA]
MASS = {mass}
[VERTICAL]
FNOMIN = 4000
"""
LATERAL = {"PCY1": 1.3, "PDY1": 0.95, "PDY2": -0.2, "PEY1": -0.7, "PEY2": -0.5, "PKY1": -20.0, "PKY2": 2.0}
LATERAL |= {"PHY1": 0.003, "PHY2": 0.001, "PVY1": 0.02, "PVY2": -0.01}


def tir_text(tire: int, organisation: str = "D", shift: float = 0.0) -> str:
    """One organisation's file of one physical tire; ``shift`` moves all coefficients."""
    own = np.random.default_rng(tire)
    size = {"radius": round(0.3 + 0.0001 * (tire % 400), 4), "width": 0.2 + 0.001 * (tire // 400)}
    scale = 1.0 + 0.02 * own.standard_normal(len(LATERAL)) + BIAS[organisation] + shift
    values = dict(zip(LATERAL, np.array(list(LATERAL.values())) * scale, strict=True))
    lines = [f"{name} = {value:.9g}" for name, value in values.items()]
    return HEAD.format(**size, mass=9.0) + "[LATERAL_COEFFICIENTS]\n" + "\n".join(lines) + "\n"


def put(folder: Path, name: str, text: str | bytes, *, age: float = 3600.0) -> Path:
    """Write a file whose last change seems ``age`` seconds ago."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    then = time.time() - age
    os.utime(path, (then, then))
    return path


def put_fleet(folder: Path, tires: range, organisations: str = "ABD", shift: float = 0.0) -> None:
    """All organisations' files of some tires."""
    for tire in tires:
        for organisation in organisations:
            put(folder, f"{organisation}/T{tire:04d}.tir", tir_text(tire, organisation, shift))


def update_store(folder: Path, store: Store | None = None) -> tuple[Store, dict[str, str], dict[str, str]]:
    """Take up what lies in the folder now; the status and the reason of each file besides."""
    store = store or Store()
    store, report = ingest(store, folder, difference(folder, store.manifest, settle_seconds=0.0))
    by_file = report.set_index("file")
    return store, by_file["status"].to_dict(), by_file["reason"].to_dict()


def ingest_all(partitions: dict, parameters: IngestParameters):
    """Read all files as the pipeline ``ingest_tir`` does."""
    table, report, summary = join_files(read_files(partitions), parameters)
    return table, joined(report), summary
