"""The table after any history equals the table of one reading of what lies there."""

from __future__ import annotations

import json
from dataclasses import astuple, replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from retraining_files import put, tir_text

from tire_pipeline.errors import DomainError
from tire_pipeline.retraining import Manifest, ManifestEntry, Store, difference, ingest
from tire_pipeline.retraining.scan import manifest
from tire_pipeline.tir import read_tir


def _update(store, folder, read=read_tir):
    return ingest(store, folder, difference(folder, store.manifest), read)


def _status(report):
    return dict(zip(report["file"], report["status"], strict=True))


@pytest.mark.parametrize("seed", range(4))
def test_step_by_step_equals_all_at_once(tmp_path, seed):
    rng = np.random.default_rng(seed)
    store = Store()
    for _ in range(8):
        for number in rng.integers(0, 12, 4):
            name = f"{'AB'[number % 2]}/{number}.tir"
            kind = rng.integers(0, 4)
            if kind == 0:
                (tmp_path / name).unlink(missing_ok=True)
            else:
                text = tir_text(int(rng.integers(0, 50)), "A")
                extra = "PDY3 = 0.1\n" if kind == 1 else ""
                put(tmp_path, name, text + extra)
        store, _ = _update(store, tmp_path)
    fresh, _ = _update(Store(), tmp_path)
    pd.testing.assert_frame_equal(store.table, fresh.table)
    assert store.manifest.digest == fresh.manifest.digest


def test_only_new_files_are_read(tmp_path):
    for tire in range(5):
        put(tmp_path, f"A/{tire}.tir", tir_text(tire))
    store, _ = _update(Store(), tmp_path)
    put(tmp_path, "A/00.tir", tir_text(9))
    read = []
    _update(store, tmp_path, lambda path: (read.append(Path(path).name), read_tir(path))[1])
    assert read == ["00.tir"]


def test_no_change_keeps_the_sequence_and_the_table(tmp_path):
    put(tmp_path, "A/1.tir", tir_text(1))
    store, _ = _update(Store(), tmp_path)
    again, report = _update(store, tmp_path)
    assert again.manifest == store.manifest
    assert again.partition is store.partition
    assert report.empty


def test_a_bad_file_is_pending_and_read_again_only_when_it_changes(tmp_path):
    put(tmp_path, "A/1.tir", tir_text(1))
    put(tmp_path, "A/bad.tir", bytes(range(256)))
    store, report = _update(Store(), tmp_path)
    assert _status(report) == {"A/1.tir": "read", "A/bad.tir": "pending"}
    assert store.table["file"].tolist() == ["A/1.tir"]
    store, report = _update(store, tmp_path, lambda path: pytest.fail("was read"))
    assert _status(report) == {"A/bad.tir": "pending"}
    assert "bad.tir" in report["reason"].iloc[0]
    put(tmp_path, "A/bad.tir", tir_text(2))
    store, report = _update(store, tmp_path)
    assert _status(report) == {"A/bad.tir": "read"}
    assert len(store.table) == 2


def test_an_earlier_reading_stays_while_the_file_is_bad(tmp_path):
    put(tmp_path, "A/1.tir", tir_text(1))
    store, _ = _update(Store(), tmp_path)
    put(tmp_path, "A/1.tir", tir_text(1)[:40])
    after, report = _update(store, tmp_path)
    assert "an earlier reading stays" in report["reason"].iloc[0]
    pd.testing.assert_frame_equal(after.table, store.table)
    assert after.manifest.digest == store.manifest.digest
    (tmp_path / "A/1.tir").unlink()
    gone, _ = _update(after, tmp_path)
    assert gone.table.empty


def test_a_file_that_changes_while_it_is_read_is_not_taken(tmp_path):
    put(tmp_path, "A/1.tir", tir_text(1))

    def read(path):
        tire = read_tir(path)
        put(tmp_path, "A/1.tir", tir_text(2))
        return tire

    store, report = _update(Store(), tmp_path, read)
    assert _status(report) == {"A/1.tir": "growing"}
    assert store.table.empty
    store, _ = _update(store, tmp_path)
    pd.testing.assert_frame_equal(store.table, _update(Store(), tmp_path)[0].table)
    assert len(store.table) == 1


def test_the_manifest_says_what_came_since(tmp_path):
    put(tmp_path, "A/1.tir", tir_text(1))
    store, _ = _update(Store(), tmp_path)
    before = store.manifest.sequence
    put(tmp_path, "A/2.tir", tir_text(2))
    put(tmp_path, "A/bad.tir", "nothing")
    store, _ = _update(store, tmp_path)
    assert store.manifest.read_after(before) == ["A/2.tir"]
    copy, _ = Manifest.from_json(store.manifest.to_json())
    assert copy == store.manifest


@pytest.mark.parametrize("count", [0, 1, 2, 5, 6])
def test_a_manifest_is_written_and_read_in_pieces(monkeypatch, count):
    """It is what it was when all of it was one value: stored ones stay readable, and equal ones equal."""
    monkeypatch.setattr(manifest, "ENTRIES_TOGETHER", 2)
    names = ['A/"files":{}.tir', 'B/,"files":{".tir', "C/\u00fc\U0001f600.tir", "a}}", "D/1", "\\x0a,", "E:["]
    entries = {
        n: ManifestEntry(f"{i}", "0" * (i % 2), i, 2**62, -i, i, "why, {") for i, n in enumerate(names)
    }
    known = Manifest(3, dict(list(entries.items())[:count]), revision=4)
    table = {"count": 2, "parts": {"0": ["part", ["PCY1"]]}}
    content = known.to_json(table=table)
    numbers = {"format": 1, "sequence": 3, "revision": 4, "table": table}
    whole = {**numbers, "files": {name: astuple(known.files[name]) for name in sorted(known.files)}}
    assert content == json.dumps(whole, separators=(",", ":")).encode()
    for stored in (content, json.dumps(whole, indent=1).encode()):
        assert Manifest.from_json(stored) == (known, {"table": table})
    assert Manifest.without_files(content) == Manifest(3, {}, revision=4)
    assert known.is_in(content)
    others = [
        replace(known, sequence=2),
        replace(known, revision=5),
        Manifest(3, entries | {"z": entries["D/1"]}, 4),
    ]
    assert not any(other.is_in(content) for other in others)
    for end in range(1, len(content)):
        with pytest.raises(DomainError, match="damaged"):
            Manifest.from_json(content[:-end])
