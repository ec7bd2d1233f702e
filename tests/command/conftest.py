"""Fixtures of the command's tests."""

from __future__ import annotations

import pytest
from command_line import COEFFICIENTS

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tir import write_tir


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty folder to work in, with a tire."""
    monkeypatch.chdir(tmp_path)
    write_tir(TireModel.from_coefficients(COEFFICIENTS), "a.tir")
    return tmp_path
