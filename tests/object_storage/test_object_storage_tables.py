"""Tables in a bucket: a bit that flips there is noticed."""

from __future__ import annotations

import pandas as pd
import pytest
from kedro.io import DatasetError, Version

from tire_pipeline.datasets import ParquetTableDataset
from tire_pipeline.files.objects import Objects


def test_a_bit_that_flips_in_a_stored_table_is_told_by_the_object(bucket):
    folder = Objects(f"{bucket}/data")
    table = pd.DataFrame({"file": ["A/1.tir", "A/2.tir"], "PCY1": [1.3, 1.4]})
    dataset = ParquetTableDataset(filepath=f"{folder}/features.parquet", version=Version(None, "1"))
    dataset.save(table)
    pd.testing.assert_frame_equal(dataset.load(), table)
    name = "features.parquet/1/features.parquet"
    content = folder.read(name)
    folder.write(name, content[:40] + bytes([content[40] ^ 4]) + content[41:])
    with pytest.raises(
        DatasetError, match=rf"{folder}/{name}: this stored table is damaged -> it is not used"
    ):
        dataset.load()
