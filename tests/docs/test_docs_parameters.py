"""The page of the pipelines says what each parameter means."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def pipelines_page(monkeypatch):
    monkeypatch.setattr(sys, "path", [str(ROOT / "docs/_build"), *sys.path])
    import pipelines_page

    return pipelines_page


def test_each_parameter_has_a_meaning(pipelines_page):
    rows = [row for rows in pipelines_page.parameters(ROOT / "conf/base").values() for row in rows]
    assert len(rows) > 50
    assert [key for key, _, meaning in rows if not meaning] == []


def test_a_pattern_in_a_comment_is_shown_as_it_is_typed(pipelines_page, tmp_path):
    (tmp_path / "parameters.yml").write_text('a: {b: ""}   # such as *_2019*.tir\n')
    (row,) = pipelines_page.parameters(tmp_path)["a"]
    assert row == ("a.b", '""', r"such as \*_2019\*.tir")
