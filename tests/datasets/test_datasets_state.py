"""A model's state comes back as it was, or not at all."""

import io
import zipfile

import numpy as np
import pytest

from tire_pipeline.datasets import StateDataset
from tire_pipeline.errors import DomainError
from tire_pipeline.files.state_files import pack_state, unpack_state

STATE = {
    "name": "forest",
    "depth": np.int64(10),
    "threshold": np.array([0.5, 1.5]),
    "classes": np.array(["A", "B"]),
    "trees": {"left": np.arange(3), "note": "x", "deeper": {"w": np.zeros((2, 2))}},
}


def test_round_trip_keeps_every_value():
    back = unpack_state(pack_state(STATE))
    assert back["name"] == "forest"
    assert back["depth"] == 10
    np.testing.assert_array_equal(back["threshold"], STATE["threshold"])
    np.testing.assert_array_equal(back["classes"], STATE["classes"])
    np.testing.assert_array_equal(back["trees"]["left"], STATE["trees"]["left"])
    np.testing.assert_array_equal(back["trees"]["deeper"]["w"], np.zeros((2, 2)))


def test_same_state_same_content():
    one, two = pack_state(STATE), pack_state(dict(reversed(STATE.items())))
    names = [zipfile.ZipFile(io.BytesIO(each)).read("sha256") for each in (one, two)]
    assert names[0] == names[1]


@pytest.mark.parametrize("change", [0x01, 0xFF])
def test_a_changed_byte_is_refused_wherever_it_is(change):
    whole, refused = pack_state(STATE), 0
    for position in range(len(whole)):
        content = bytearray(whole)
        content[position] ^= change
        try:
            back = unpack_state(bytes(content))
        except DomainError:
            refused += 1
            continue
        np.testing.assert_equal(back, unpack_state(whole))  # a byte that carries nothing
    assert refused > len(whole) / 2


def test_an_exchanged_member_is_refused():
    source = zipfile.ZipFile(io.BytesIO(pack_state(STATE)))
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as target:
        for name in source.namelist():
            data = source.read(name)
            if name == "threshold.npy":
                other = io.BytesIO()
                np.save(other, np.array([9.0, 9.0]))
                data = other.getvalue()
            target.writestr(name, data)
    with pytest.raises(DomainError, match="checksum"):
        unpack_state(buffer.getvalue())


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"cos\nsystem\n(S'true'\ntR."])
def test_anything_else_is_refused(content):
    with pytest.raises(DomainError, match="damaged"):
        unpack_state(content)


def test_objects_are_not_stored():
    with pytest.raises(DomainError, match="plain numbers"):
        pack_state({"bad": np.array([object()])})


def test_dataset_saves_and_loads(tmp_path):
    dataset = StateDataset(filepath=str(tmp_path / "model.npz"))
    dataset.save(STATE)
    assert dataset.load()["name"] == "forest"
    assert [p.name for p in tmp_path.iterdir()] == ["model.npz"]
