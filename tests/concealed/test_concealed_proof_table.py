"""``benchmarks/proof_table.py`` shows the last run's tables, and commits them only if it is told to."""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path

import pandas as pd
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

import proof_table

from tire_pipeline.concealed.real.published import published

SEED = 99_999_999


@pytest.fixture
def data(tmp_path):
    """A data folder after a run of both halves: the committed tables as another seed would give them."""
    scores, made = published()
    simulated = pd.read_csv(proof_table.RESULTS / "proof_scores.csv")
    details = {"published": False, "made": {**made, "seed": SEED}}
    for name, text in {
        "proof_scores.csv": simulated.assign(n=simulated["n"] + 1).to_csv(index=False),
        "proof_misses.csv": (proof_table.RESULTS / "proof_misses.csv").read_text(),
        "real_proof_details.json": json.dumps(details),
        "real_proof_misses.csv": (proof_table.RESULTS / "real_proof_misses.csv").read_text(),
        "real_proof_scores.csv": scores.to_csv(index=False),
    }.items():
        place = tmp_path / "07_model_output" / name / "2026-01-01T00.00.00.000Z" / name
        place.parent.mkdir(parents=True)
        place.write_text(text)
    return tmp_path


@pytest.fixture
def committed(tmp_path, monkeypatch):
    """Copies of what is committed, which the script takes for the originals."""
    place = tmp_path / "repository"
    shutil.copytree(proof_table.RESULTS, place / "results")
    for name in ("REAL", "PAGE", "RESULTS_PAGE"):
        monkeypatch.setattr(proof_table, name, Path(shutil.copy(getattr(proof_table, name), place)))
    monkeypatch.setattr(proof_table, "RESULTS", place / "results")
    monkeypatch.setattr(proof_table, "RUNS", place / "results" / proof_table.RUNS.name)
    return place


def _bytes(folder: Path) -> dict[str, bytes]:
    return {str(path): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def _call(monkeypatch, capsys, *arguments: str) -> str:
    monkeypatch.setattr(sys, "argv", ["proof_table.py", *arguments])
    proof_table.main()
    return capsys.readouterr().out


def test_a_look_at_the_last_run_writes_nothing(data, committed, monkeypatch, capsys):
    """The committed tables were rewritten even without --write."""
    before = _bytes(committed)
    printed = _call(monkeypatch, capsys, "--data", str(data))
    assert f"seed {SEED}" in printed
    assert _bytes(committed) == before


def test_what_is_written_is_what_was_shown(data, committed, monkeypatch, capsys):
    shown = _call(monkeypatch, capsys, "--data", str(data))
    assert _call(monkeypatch, capsys, "--data", str(data), "--write") == shown
    assert f"seed {SEED}" in proof_table.RESULTS_PAGE.read_text()
    assert f'"seed": {SEED}' in proof_table.REAL.read_text().splitlines()[0]
    assert SEED in set(pd.read_csv(proof_table.RUNS)["seed"])
    again = _bytes(committed)
    _call(monkeypatch, capsys, "--data", str(data), "--write")
    assert _bytes(committed) == again
