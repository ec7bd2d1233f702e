"""The benchmark of the translated files' page makes its page: 4,000 files stay under 10 MB."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow
BENCH = Path(__file__).resolve().parents[2] / "benchmarks" / "bench_translated_page.py"
MOST = 10e6
FILES = 400


def test_the_page_of_made_up_files_is_small_enough_for_4000_of_them():
    page = runpy.run_path(str(BENCH))["made_up"](FILES)
    assert "Content-Security-Policy" in page
    assert len(page.encode()) * 4000 / FILES < MOST
