"""A bit that flips anywhere in a stored table is noticed, and the error names the file and what to do."""

from __future__ import annotations

import json
import random
from collections.abc import Callable

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
from kedro.io import DatasetError
from kedro.io.core import Version

from tire_pipeline.datasets import (
    CsvTableDataset,
    FramePartsDataset,
    IngestStoreDataset,
    JsonFileDataset,
    ParquetTableDataset,
)
from tire_pipeline.datasets.storage.sealed import json_as_sealed, sealed_json, sealed_parquet
from tire_pipeline.errors import DomainError
from tire_pipeline.kedro_runs.run_errors import one_line
from tire_pipeline.retraining import Manifest, Store
from tire_pipeline.retraining.scan.manifest import ManifestEntry
from tire_pipeline.retraining.stored_table.partition import Partition
from tire_pipeline.tire_table import from_models

FLIPS = 600


def _table(rows: int = 300) -> pd.DataFrame:
    rng = np.random.default_rng(1)
    table = pd.DataFrame(
        rng.normal(size=(rows, 4)), columns=["PKY1", "PDY1", "FNOMIN", "tire_pipeline.sha256"]
    )
    table["file"] = [f"A/{number}.tir" for number in range(rows)]
    table["bin"] = rng.integers(0, 9, rows).astype("int8")
    table["gap"] = np.where(rng.random(rows) < 0.5, np.nan, 1.0)
    return table


def _flipped(content: bytes, at: int, bit: int) -> bytes:
    return content[:at] + bytes([content[at] ^ (1 << bit)]) + content[at + 1 :]


@pytest.mark.parametrize("index", [None, "files"])
def test_a_table_comes_back_as_it_was_and_any_reader_can_read_it(tmp_path, index):
    table = _table() if index is None else _table().set_index("file")
    dataset = ParquetTableDataset(filepath=str(tmp_path / "features.parquet"))
    dataset.save(table)
    pd.testing.assert_frame_equal(dataset.load(), table)
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "features.parquet"), table)
    assert (tmp_path / "features.parquet").read_bytes() == sealed_parquet(table)


def test_what_was_stored_without_a_hash_is_read(tmp_path):
    _table().to_parquet(tmp_path / "features.parquet")
    stored = ParquetTableDataset(filepath=str(tmp_path / "features.parquet")).load()
    pd.testing.assert_frame_equal(stored, _table())


def test_a_flip_within_a_page_is_told_by_the_file_with_what_to_do(tmp_path):
    path = tmp_path / "features.parquet"
    dataset = ParquetTableDataset(filepath=str(path))
    dataset.save(_table())
    page = pq.read_metadata(path).row_group(0).column(0).data_page_offset
    path.write_bytes(_flipped(path.read_bytes(), page + 900, 3))
    assert not pd.read_parquet(path).equals(_table()), "Parquet itself does not notice"
    with pytest.raises(DatasetError) as raised:
        dataset.load()
    assert str(raised.value).splitlines()[-1] == (
        f"{path}: this stored table is damaged -> it is not used: run the pipeline that makes "
        "'features' (or `kedro run`); a new version takes its place"
    )


def _loaded(load: Callable[[], list[pd.DataFrame]]) -> list[pd.DataFrame] | str:
    """The tables, or the words of the error."""
    try:
        return load()
    except (DatasetError, DomainError) as error:
        return str(error)


def _same(found: list[pd.DataFrame], expected: list[pd.DataFrame]) -> bool:
    return len(found) == len(expected) and all(map(pd.DataFrame.equals, found, expected))


def test_no_flip_anywhere_gives_another_table(tmp_path):
    path = tmp_path / "features.parquet"
    dataset = ParquetTableDataset(filepath=str(path))
    dataset.save(_table())
    content, rng, refused = path.read_bytes(), random.Random(2), 0
    pages = len(content) - int.from_bytes(content[-8:-4], "little") - 8
    for number in range(FLIPS):
        at = rng.randrange(pages) if number % 2 else rng.randrange(pages, len(content))
        path.write_bytes(_flipped(content, at, rng.randrange(8)))
        found = _loaded(lambda: [dataset.load()])
        assert "damaged" in found if isinstance(found, str) else _same(found, [_table()])
        refused += isinstance(found, str)
    assert refused > 0.98 * FLIPS
    for length in (0, 3, 100, len(content) // 2, len(content) - 1):
        path.write_bytes(content[:length])
        assert "damaged" in _loaded(lambda: [dataset.load()])


def test_no_flip_in_the_list_of_parts_gives_another_table(tmp_path):
    path = tmp_path / "table.json"
    dataset = FramePartsDataset(filepath=str(path))
    dataset.save([lambda: _table(20), lambda: _table(30)])
    content, whole = path.read_bytes(), [_table(20), _table(30)]
    for at in range(len(content)):
        path.write_bytes(_flipped(content, at, at % 8))
        found = _loaded(lambda: [load() for load in dataset.load()])
        assert "damaged -> it is not used" in found if isinstance(found, str) else _same(found, whole)
    path.write_bytes(json.dumps({"parts": json.loads(content)["parts"]}).encode())
    assert len(dataset.load()) == 2, "as a former version stored it"


def test_no_flip_in_the_manifest_of_what_was_read_gives_another_store(tmp_path):
    dataset = IngestStoreDataset(path=str(tmp_path / "ingested"))
    entry = ManifestEntry("5e" * 32, "5e" * 32, 7, 8, 9, 1)
    frame = from_models([]).reindex(range(1)).assign(file="A/1.tir", category="A", PCY1=1.3)
    dataset.save(Store(Manifest(1, {"A/1.tir": entry, "B/2.tir": entry}), Partition.of(frame)))
    path = tmp_path / "ingested/manifest.json"
    content, stored = path.read_bytes(), dataset.load()
    for at in range(len(content)):
        path.write_bytes(_flipped(content, at, at % 8))
        try:
            found = dataset.load()
        except DatasetError as error:
            found = str(error)
        assert found == stored or "the next run reads all files again" in found


def test_a_text_with_its_hash_is_json_and_gives_the_text_again():
    text = b'{"parts":[],"sha256":"x"}'
    stored = sealed_json(text)
    assert json.loads(sealed_json(b'{"parts":[]}'))["parts"] == []
    assert json_as_sealed(stored, "here", "again") == text
    assert json_as_sealed(text, "here", "again") == text, "written without"
    with pytest.raises(DomainError, match="here: this file is damaged -> again"):
        json_as_sealed(stored.replace(b"parts", b"qarts"), "here", "again")


SPLITS = pd.DataFrame({"file": ["A/1.tir", "B/2.tir"], "part": ["test", "training"]})
BESIDE = {
    "splits.csv": (CsvTableDataset, SPLITS),
    "best.json": (JsonFileDataset, {"name": "mixed_model", "errors": {"mixed_model": 0.052}}),
    "sources.json": (JsonFileDataset, ["A/1.tir", "B/2.tir"]),
}


def _beside(folder, name, *, sealed=True):
    kind, data = BESIDE[name]
    dataset = kind(filepath=str(folder / name), version=Version(None, "2026-11-30T00.00.00.000Z"))
    dataset.save(data)
    (path,) = (folder / name).glob(f"*/{name}")
    seal = path.with_name(f"{name}.sha256")
    assert seal.exists()
    if not sealed:
        seal.unlink()
    return dataset, path, data


@pytest.mark.parametrize("name", BESIDE)
@pytest.mark.parametrize("sealed", [True, False])
def test_a_table_or_json_comes_back_also_of_before_there_were_hashes(tmp_path, name, sealed):
    dataset, _, data = _beside(tmp_path, name, sealed=sealed)
    back = dataset.load()
    assert back.equals(data) if isinstance(data, pd.DataFrame) else back == data


@pytest.mark.parametrize("name", BESIDE)
def test_no_flip_and_no_half_of_a_table_or_json_is_trusted(tmp_path, name):
    dataset, path, _ = _beside(tmp_path, name)
    content = path.read_bytes()
    flipped = [_flipped(content, at, bit) for at in range(len(content)) for bit in (0, 5)]
    for other in [*flipped, content[: len(content) // 2], b""]:
        path.write_bytes(other)
        with pytest.raises(DatasetError) as raised:
            dataset.load()
        said = one_line(raised.value)
        assert f"{path}: this stored file is damaged -> it is not used: run the pipeline that makes" in said


def test_a_hash_without_its_file_is_no_version(tmp_path):
    _, path, _ = _beside(tmp_path, "best.json")
    path.unlink()
    newest = JsonFileDataset(filepath=str(tmp_path / "best.json"), version=Version(None, None))
    assert not newest.exists()


def test_a_file_without_versions_may_be_changed_by_hand(tmp_path):
    dataset = CsvTableDataset(filepath=str(tmp_path / "mine.csv"))
    dataset.save(SPLITS)
    (tmp_path / "mine.csv").write_text("file,part\nC/3.tir,test\n")
    assert dataset.load()["file"].tolist() == ["C/3.tir"]
    assert [each.name for each in tmp_path.iterdir()] == ["mine.csv"]
