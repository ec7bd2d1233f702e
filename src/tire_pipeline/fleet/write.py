"""Write a fleet to the folders of docs/reference/architecture.md, whole or not at all."""

from __future__ import annotations

import io
import json
import os
import shutil
from pathlib import Path

import numpy as np
import pandas as pd

from tire_pipeline.errors import DomainError
from tire_pipeline.files.folder_walk import holds_anything
from tire_pipeline.fleet.make import Fleet, make_fleet
from tire_pipeline.fleet.parameters import FleetParameters
from tire_pipeline.fleet.settings import FleetSettings


def build_fleet(
    parameters: FleetParameters, target_category: str, seed: int
) -> tuple[dict[str, bytes], dict[str, bytes], dict[str, bytes]]:
    """Make every file of the fleet.

    Parameters
    ----------
    parameters : FleetParameters
    target_category : str
        Its measurements of the evaluation tires are sealed.
    seed : int

    Returns
    -------
    truth, evaluation, files : dict of str to bytes
        By relative path. The training files come last: until they are there, the fleet counts as not made.
    """
    settings = FleetSettings(target=target_category, seed=seed, **parameters.model_dump())
    fleet = make_fleet(settings)
    return truth_files(fleet), encoded(fleet.evaluation), encoded(fleet.files)


def write_fleet(fleet: Fleet, raw_folder: str | Path) -> dict[str, Path]:
    """Write ``tir/``, ``evaluation/`` and ``truth/`` below ``data/01_raw``.

    Each folder is first written under a temporary name and then renamed, so that no later run meets
    half of one. Existing ``evaluation/`` and ``truth/`` folders are replaced; ``tir/`` may hold the
    user's own files and is never touched if it holds any file.

    Parameters
    ----------
    fleet : Fleet
    raw_folder : path
        ``data/01_raw``.

    Returns
    -------
    dict of str to Path
        The folders ``tir``, ``evaluation`` and ``truth``.

    Raises
    ------
    DomainError
        If ``tir/`` already holds files, or the disk cannot take the fleet.
    """
    raw = Path(raw_folder)
    tir = raw / "tir"
    if holds_anything(tir, but=[".gitkeep"]):
        raise DomainError(
            "the folder for the fleet already holds files",
            where=str(tir),
            todo="move them away, or choose another tir_folder; nothing was changed",
        )
    parts: dict[str, dict[str, bytes]] = {
        "tir": encoded(fleet.files),
        "evaluation": encoded(fleet.evaluation),
        "truth": truth_files(fleet),
    }
    staged: dict[str, Path] = {}
    try:
        for name, files in parts.items():
            staged[name] = raw / f".{name}.{os.getpid()}.part"
            _write_folder(staged[name], files)
    except OSError as error:
        for folder in staged.values():
            shutil.rmtree(folder, ignore_errors=True)
        raise DomainError(
            f"the fleet cannot be written: {error.strerror}",
            where=str(raw),
            todo="free some space (80 MB) or correct the permissions, then run again",
        ) from error
    # The training files come last: while they are absent, the fleet counts as not made.
    for name in ("truth", "evaluation", "tir"):
        shutil.rmtree(raw / name, ignore_errors=True)
        staged[name].rename(raw / name)
    return {name: raw / name for name in parts}


def truth_files(fleet: Fleet) -> dict[str, bytes]:
    """Return the sealed truth as files: texts, tables (Parquet), regimes (JSON) and curves (NPZ).

    Parameters
    ----------
    fleet : Fleet

    Returns
    -------
    dict of str to bytes
        By path relative to ``truth/``.
    """
    truth = fleet.truth
    files = encoded({f"first/{path}": text for path, text in truth.first.items()})
    files |= encoded({f"second/{path}": text for path, text in truth.second.items()})
    files["tires.parquet"] = _parquet(truth.tires.reset_index())
    files["files.parquet"] = _parquet(truth.files)
    files["evaluation.parquet"] = _parquet(truth.evaluation)
    files["regimes.json"] = json.dumps(truth.regimes, indent=1, sort_keys=True).encode()
    files["settings.json"] = json.dumps(truth.settings, indent=1, sort_keys=True).encode()
    for name, curves in truth.curves.items():
        buffer = io.BytesIO()
        np.savez(buffer, allow_pickle=False, **curves)
        files[f"curves_{name}.npz"] = buffer.getvalue()
    return files


def read_truth_tables(folder: str | Path) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Read ``tires`` (by tire) and ``files`` of a written truth.

    Parameters
    ----------
    folder : path
        ``data/01_raw/truth``.

    Returns
    -------
    tires, files : pandas.DataFrame
    """
    folder = Path(folder)
    tires = pd.read_parquet(folder / "tires.parquet").set_index("tire")
    return tires, pd.read_parquet(folder / "files.parquet")


def encoded(texts: dict[str, str]) -> dict[str, bytes]:
    """Texts as the bytes that are written: Windows-1252, line ends as the manufacturers have them."""
    return {path: text.encode("cp1252") for path, text in texts.items()}


def _parquet(table: pd.DataFrame) -> bytes:
    buffer = io.BytesIO()
    table.to_parquet(buffer, index=False)
    return buffer.getvalue()


def _write_folder(folder: Path, files: dict[str, bytes]) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    made: set[Path] = set()
    for path, content in files.items():
        full = folder / path
        if full.parent not in made:
            full.parent.mkdir(parents=True, exist_ok=True)
            made.add(full.parent)
        full.write_bytes(content)
