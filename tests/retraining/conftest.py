"""A folder of two organisations' files."""

from __future__ import annotations

import pytest
from retraining_files import put, tir_text


@pytest.fixture
def folder(tmp_path):
    put(tmp_path / "tir", "A/1.tir", tir_text(1, "A"))
    put(tmp_path / "tir", "B/2.tir", tir_text(2, "B"))
    return tmp_path / "tir"
