"""A dictionary written item by item is the same file as written at once."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tire_pipeline.datasets import JsonFileDataset, JsonItemsDataset
from tire_pipeline.datasets.text_files.json_file import item_texts

_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)


@settings(deadline=None)
@given(st.dictionaries(st.text(), _VALUES, max_size=4), st.integers(0, 3))
def test_the_text_is_that_of_the_whole(data, indent):
    assert "".join(item_texts(data, indent)) == json.dumps(data, indent=indent)


class _OneAtATime(Mapping):
    """Notes which value is asked for."""

    def __init__(self, written) -> None:
        self.written = written

    def __getitem__(self, name: str) -> object:
        self.written.append(name)
        return {"name": name, "line\nbreak": [1.5, None]}

    def __iter__(self) -> Iterator[str]:
        return iter("abc")

    def __len__(self) -> int:
        return 3


def test_each_value_is_asked_for_once_in_order(tmp_path):
    asked: list[str] = []
    place = str(tmp_path / "items.json")
    JsonItemsDataset(filepath=place, save_args={"indent": 1}).save(_OneAtATime(asked))
    assert asked == ["a", "b", "c"]
    whole = str(tmp_path / "whole.json")
    JsonFileDataset(filepath=whole, save_args={"indent": 1}).save(dict(_OneAtATime([])))
    assert (tmp_path / "items.json").read_bytes() == (tmp_path / "whole.json").read_bytes()
    assert JsonItemsDataset(filepath=place).load() == dict(_OneAtATime([]))


@pytest.mark.parametrize("data", [{}, {"a": {}}])
def test_nothing_is_written_as_nothing(tmp_path, data):
    JsonItemsDataset(filepath=str(tmp_path / "e.json")).save(data)
    assert json.loads((tmp_path / "e.json").read_text()) == data
