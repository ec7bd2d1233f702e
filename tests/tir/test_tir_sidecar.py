"""Corrections beside a .tir file."""

from __future__ import annotations

import json

import numpy as np
import pytest
from tir_samples import tir_text

from tire_pipeline.errors import TirError, TirSyntaxError
from tire_pipeline.tir import read_sidecar, read_tir, write_sidecar, write_tir
from tire_pipeline.tir.sidecar import sidecar_path

EFFECTS = {
    "temperature": {"reference": 60.0, "parameters": {"slope": [-0.004, 1e-4, "1/K"]}},
    "wear": {"rate": 1e-9},
}


@pytest.fixture
def tire_path(tmp_path):
    path = tmp_path / "tire.tir"
    path.write_text(tir_text())
    return path


def test_round_trip(tire_path):
    assert read_sidecar(tire_path) is None
    assert "sidecar" not in read_tir(tire_path).metadata
    written = write_sidecar(tire_path, EFFECTS)
    assert written.name == "tire.tir.sidecar.json"
    assert read_sidecar(tire_path) == EFFECTS
    assert read_tir(tire_path).metadata["sidecar"] == EFFECTS
    assert "sidecar" not in read_tir(tire_path.read_bytes(), path=str(tire_path)).metadata


def test_numpy_numbers_become_plain(tire_path):
    write_sidecar(tire_path, {"wear": {"rate": np.float64(0.5), "curve": np.arange(3)}})
    assert read_sidecar(tire_path) == {"wear": {"rate": 0.5, "curve": [0, 1, 2]}}


@pytest.mark.parametrize("value", [float("nan"), float("inf"), object(), {1, 2}])
def test_what_is_not_json_is_refused(tire_path, value):
    with pytest.raises(TirError, match="do not fit JSON"):
        write_sidecar(tire_path, {"wear": {"rate": value}})
    assert not sidecar_path(tire_path).exists()


GOOD = {"format": "tire-pipeline sidecar", "format_version": 1, "effects": {}}


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x80\x04\x95",
        b"[]",
        b"{}",
        b"[" * 100_000,
        b" " * 1_000_001,
        json.dumps({**GOOD, "format": "another"}).encode(),
        json.dumps({**GOOD, "format_version": 2}).encode(),
        json.dumps({**GOOD, "effects": [1]}).encode(),
        json.dumps({**GOOD, "effects": {"wear": 1}}).encode(),
        json.dumps({**GOOD, "effects": {"wear": {"rate": float("nan")}}}).encode(),
    ],
)
def test_a_wrong_sidecar_is_named(tire_path, content: bytes):
    sidecar_path(tire_path).write_bytes(content)
    with pytest.raises(TirSyntaxError, match=r"tire\.tir\.sidecar\.json: the sidecar"):
        read_tir(tire_path)


def test_the_sidecar_goes_with_the_model(tire_path, tmp_path):
    write_sidecar(tire_path, EFFECTS)
    copy = write_tir(read_tir(tire_path), tmp_path / "copy.tir")
    assert read_sidecar(copy) == EFFECTS


def test_a_sidecar_of_another_model_is_never_left(tire_path):
    tire = read_tir(tire_path)
    write_sidecar(tire_path, EFFECTS)
    tire_path.unlink()
    with pytest.raises(TirError, match="there are corrections for a file of that name"):
        write_tir(tire, tire_path)
    write_tir(tire, tire_path, overwrite=True)
    assert "sidecar" not in read_tir(tire_path).metadata
