"""Folders in which nearly nothing is as it should be: the rest is read, and read the same."""

from __future__ import annotations

import gzip
import os
import shutil
import unicodedata
from functools import partial
from pathlib import Path

import pytest
from retraining_files import put, put_fleet, tir_text, update_store

from tire_pipeline.datasets import TirFolderDataset
from tire_pipeline.files.rows_on_disk import joined
from tire_pipeline.tire_table.read_files import IngestParameters, join_files, read_files


def _ingested(folder: Path) -> tuple[list[str], dict[str, str]]:
    """What ``ingest_tir`` reads, and what it sets aside with the reasons."""
    blocks = read_files(TirFolderDataset(path=str(folder)).load())
    done = {name: partial(bytes, block()) for name, block in blocks.items()}
    table, reported, _ = join_files(done, IngestParameters(most_failed_share=1.0))
    report = joined(reported)
    aside = report[report["status"] == "set aside"]
    return sorted(table.frame()["file"]), dict(zip(aside["file"], aside["reason"], strict=True))


def test_a_pipe_behind_a_link_and_names_that_look_the_same(tmp_path):
    folder, outside = tmp_path / "tir", tmp_path / "outside"
    put_fleet(folder, range(2))
    put(outside, "through.tir", tir_text(10))
    os.mkfifo(outside / "pipe.tir")
    (outside / "back").symlink_to(folder)
    (outside / "pipe_by_link.tir").symlink_to("pipe.tir")
    (folder / "A/out").symlink_to(outside)
    alike = [f"A/{unicodedata.normalize(form, 'é')}.tir" for form in ("NFC", "NFD")]
    for number, name in enumerate([*alike, "A/x.tir", "A/x.TIR", "A/x.tir.sidecar.json/y.tir"]):
        put(folder, name, tir_text(20 + number))
    good = {f"{o}/T000{t}.tir" for o in "ABD" for t in range(2)} | {"A/out/through.tir", *alike}
    good |= {"A/x.TIR", "A/x.tir.sidecar.json/y.tir"}
    read, aside = _ingested(folder)
    assert read == sorted(good)
    assert set(aside) >= {"A/out/pipe.tir", "A/out/pipe_by_link.tir", "A/x.tir"}
    assert "the sidecar cannot be read: Is a directory -> write it again, or move it away" in aside["A/x.tir"]
    store, status, _ = update_store(folder)
    assert {name for name, found in status.items() if found == "read"} == good
    assert update_store(folder, store)[1].get("A/out/through.tir") != "read"


def test_contents_of_any_kind_change_no_other_row(tmp_path):
    folder, text = tmp_path / "tir", tir_text(3)
    put_fleet(folder, range(2))
    alone = update_store(folder)[0].table
    good = {
        "D/little_endian.tir": b"\xff\xfe" + text.encode("utf-16-le"),
        "D/big_endian.tir": b"\xfe\xff" + text.encode("utf-16-be"),
        "D/cr_only.tir": text.replace("\n", "\r"),
    }
    bad = {
        "A/empty.tir": b"",
        "A/one_line.tir": b"A" * 4_900_000,
        "A/spaces.tir": b" " * 4_900_000,
        "A/zipped.tir": gzip.compress(text.encode()),
        "A/nul.tir": text.replace("FITTYP", "FIT\0TYP"),
        "A/keys.tir": text + "".join(f"KEY{n} = {n}\n" for n in range(100_000)),
        "A/half_a_letter.tir": b"\xff\xfe" + text.encode("utf-16-le") + b"x",
    }
    for name, content in {**good, **bad}.items():
        put(folder, name, content)
    put(folder, "A/larger_than_the_disk.tir", b"")
    os.truncate(folder / "A/larger_than_the_disk.tir", 10**12)
    store, status, reason = update_store(folder)
    assert {name for name, found in status.items() if found == "pending"} == {
        *bad,
        "A/larger_than_the_disk.tir",
    }
    assert all(reason[name] for name in bad)
    rows = store.table.set_index("file")
    assert set(rows.index) == {*alone["file"], *good}
    assert rows.loc[alone["file"], list(alone.columns[1:])].equals(alone.set_index("file"))
    assert rows.loc[list(good), "PKY1"].nunique() == 1
    assert _ingested(folder)[0] == sorted(rows.index)


@pytest.mark.parametrize(
    "gone", ["before it is listed", "before its files are looked at", "before they are read"]
)
def test_a_folder_that_vanishes_while_it_is_read_takes_nothing_with_it(tmp_path, gone, monkeypatch):
    folder = tmp_path / "tir"
    put_fleet(folder, range(2))
    left = {f"{o}/T000{t}.tir" for o in "AD" for t in range(2)}

    def vanishing(function, path_of_call):
        def changed(*arguments, **named):
            if str(folder / "B") in str(path_of_call(*arguments)):
                shutil.rmtree(folder / "B", ignore_errors=True)
            return function(*arguments, **named)

        return changed

    if gone == "before it is listed":
        monkeypatch.setattr(os, "scandir", vanishing(os.scandir, lambda path: path))
    elif gone == "before its files are looked at":
        monkeypatch.setattr(os, "stat", vanishing(os.stat, lambda path: path))
    else:
        opened = "tire_pipeline.retraining.scan.places.open_regular"
        from tire_pipeline.retraining.scan.places import open_regular

        monkeypatch.setattr(opened, vanishing(open_regular, lambda path: path))
    store, status, _ = update_store(folder)
    assert not (folder / "B").exists()
    assert {name for name, found in status.items() if found == "read"} == left == set(store.manifest.files)
