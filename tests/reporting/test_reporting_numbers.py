"""Numbers as pages, messages and tables write them: one rule in all places."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tire_pipeline.command.outcome import digits
from tire_pipeline.mismatch.report.words import shown
from tire_pipeline.pages.numbers_in_words import how_many, in_digits
from tire_pipeline.reporting import Table, render_page
from tire_pipeline.tir import read_tir

ROOT = Path(__file__).resolve().parents[2]
POWER_OF_TEN = re.compile(r"\de\+\d")


@pytest.mark.parametrize("most", [2, 3, 4, 6])
def test_large_numbers_have_no_power_of_ten_and_no_digit_of_small_ones_is_invented(most):
    for value in [*np.geomspace(0.01, 1e9, 400), *(10.0**k - 10.0 ** (k - most) / 3 for k in range(1, 9))]:
        text = in_digits(value, most)
        assert not POWER_OF_TEN.search(text), (value, text)
        assert float(text.replace(",", "")) == pytest.approx(value, rel=0.51 * 10.0 ** (1 - most))
        assert len(text.replace(",", "").replace(".", "").lstrip("0")) <= max(most, len(f"{value:.0f}"))


def test_zero_has_no_sign():
    assert in_digits(-0.0) == "0"


def test_what_is_no_number():
    assert [in_digits(value) for value in (float("nan"), float("inf"), -float("inf"))] == ["–", "∞", "-∞"]


def test_the_places_that_write_three_digits_agree():
    value = 999.7
    page = render_page("t", [Table(pd.DataFrame({"a": [value], "b": [1e-3]}), unlike=True)])
    assert "1,000" in page
    assert not POWER_OF_TEN.search(page)
    assert shown("pressure", value * 1e3) == "1,000 kPa"
    assert digits(128062.0) == "128,062"


def test_a_notebook_shows_a_stiffness_as_engineers_write_it():
    card = read_tir(ROOT / "examples" / "tire.tir")._repr_html_()
    assert not POWER_OF_TEN.search(card), card
    assert re.search(r"\d\d,\d{3}", card)


def test_nouns_follow_their_counts():
    assert [how_many(n, "sample") for n in (0, 1, 2, 1234)] == [
        "0 samples",
        "1 sample",
        "2 samples",
        "1,234 samples",
    ]
