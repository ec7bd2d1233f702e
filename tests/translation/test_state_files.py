import numpy as np
import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.state_files import prefixed, read_state, without_prefix, write_state


def test_everything_comes_back(tmp_path):
    state = {
        "classes": np.array(["Ä", "B"]),
        "weights": np.linspace(0, 1, 6).reshape(2, 3).T,
        "flags": np.array([True, False]),
        "empty": np.zeros((0, 3), dtype=np.int64),
        "name": "forest",
        "count": np.int64(3),
        "scale": 0.1,
        "none": None,
    }
    write_state(tmp_path / "folder" / "model.v1", state)
    back = read_state(tmp_path / "folder" / "model.v1")
    assert back.keys() == state.keys()
    for name, value in state.items():
        if isinstance(value, np.ndarray):
            assert back[name].dtype.kind == value.dtype.kind
            np.testing.assert_array_equal(back[name], value)
        else:
            assert back[name] == value
    assert sorted(p.name for p in (tmp_path / "folder").iterdir()) == [
        "model.v1.json",
        "model.v1.safetensors",
    ]


def test_prefixes_nest():
    state = {**prefixed("a", {"x": 1}), **prefixed("ab", {"x": 2})}
    assert without_prefix("a", state) == {"x": 1}
    assert without_prefix("ab", state) == {"x": 2}


def test_missing_file_is_named(tmp_path):
    with pytest.raises(DomainError, match="incomplete"):
        read_state(tmp_path / "nothing")
