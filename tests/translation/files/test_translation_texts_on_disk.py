"""The translated files of a run: which they are is on the disk, and their texts are read part by part."""

import pytest

from tire_pipeline.files.packed import pack
from tire_pipeline.files.rows_on_disk import RowsOnDisk
from tire_pipeline.translation.files.translated_folder import TranslatedTexts


@pytest.fixture
def read():
    """Numbers of the parts, as they are read."""
    return []


@pytest.fixture
def texts(read):
    """Four files of two parts, and one that was not translated."""
    parts = [
        {"texts/B/1.tir": b"b1", "texts/A/9.tir": b"a9", "report.parquet": b""},
        {"texts/A/1.tir": b"a1", "texts/C/é.tir": b"c"},
    ]

    def load(number):
        read.append(number)
        return pack(parts[number])

    rows = RowsOnDisk(["file", "part"])
    rows.add([("C/é.tir", 1), ("A/1.tir", 1), ("A/refused.tir", None), ("B/1.tir", 0), ("A/9.tir", 0)])
    return TranslatedTexts(rows, [lambda: load(0), lambda: load(1)])


def test_each_part_is_read_once(texts, read):
    assert {name: text() for name, text in texts.items()} == {
        "A/9.tir": b"a9",
        "B/1.tir": b"b1",
        "A/1.tir": b"a1",
        "C/é.tir": b"c",
    }
    assert read == [0, 1]


def test_only_what_was_translated_is_there(texts, read):
    assert len(texts) == 4
    assert "A/refused.tir" not in texts
    assert "A/never.tir" not in texts
    assert sorted(texts) == ["A/1.tir", "A/9.tir", "B/1.tir", "C/é.tir"]
    assert texts["C/é.tir"]() == b"c"
    assert read == [1]
