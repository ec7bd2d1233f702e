"""Files that change while they are read, and clocks that are wrong."""

from __future__ import annotations

import os
import time

import pytest
from retraining_files import put, tir_text, update_store

from tire_pipeline.retraining import Manifest, Store, difference, ingest, settled_difference
from tire_pipeline.retraining.scan.places import fingerprint
from tire_pipeline.tir import read_tir


def test_a_file_that_never_stops_growing_ends_the_reading(folder, monkeypatch):
    path = put(folder, "A/1.tir", tir_text(1, "A"))
    taken = []

    def read(file):
        taken.append(file)
        with path.open("a") as stream:
            stream.write("! one more line\n")
        return read_tir(file)

    store, report = ingest(Store(), folder, difference(folder, Manifest(), settle_seconds=0.0), read)
    assert dict(zip(report["file"], report["status"], strict=True))["A/1.tir"] == "growing"
    assert "A/1.tir" not in set(store.table["file"])
    huge = folder / "A/huge.tir"
    with huge.open("wb") as stream:
        stream.truncate(1 << 40)  # a terabyte that takes no room
    assert update_store(folder)[1]["A/huge.tir"] == "pending"


def test_clocks_that_go_back_neither_keep_a_file_out_nor_let_half_of_one_in(folder):
    text = tir_text(3, "A")
    put(folder, "A/3.tir", text[:200], age=-86400)  # written before the clock went back a day
    naps = []

    def grow(seconds):
        naps.append(seconds)
        if len(naps) <= 3:
            put(folder, "A/3.tir", text if len(naps) == 3 else text[: 200 + len(naps)], age=-86400)

    found = settled_difference(folder, Manifest(), settle_seconds=5.0, most_wait_seconds=60.0, sleep=grow)
    assert "A/3.tir" in found.added
    assert found.added["A/3.tir"][1] == fingerprint(folder / "A/3.tir")
    assert (folder / "A/3.tir").read_text() == text
    assert naps == [5.0] * 4


def test_a_server_whose_clock_is_ahead_keeps_nothing_out(folder):
    put(folder, "A/3.tir", tir_text(3, "A"), age=-86400)
    found = settled_difference(
        folder, Manifest(), settle_seconds=5.0, most_wait_seconds=2.0, sleep=lambda seconds: None
    )
    assert "A/3.tir" in found.added


@pytest.mark.parametrize("date", [0, -86400, 1, 2**33])
def test_dates_of_1970_before_and_far_ahead(folder, date):
    os.utime(folder / "A/1.tir", (date, date))
    store, status, _ = update_store(folder)
    assert status["A/1.tir"] == "read"
    again, _ = Manifest.from_json(store.manifest.to_json())
    assert not difference(folder, again)
    put(folder, "A/1.tir", tir_text(9, "A"))
    os.utime(folder / "A/1.tir", (date, date))
    assert set(difference(folder, again, now=time.time() + 60).changed) == {"A/1.tir"}
