"""Pages hold everything they need, and nothing of what they show can act."""

import re

import pandas as pd

from tire_pipeline.reporting import Figure, Table, Text, inline_svg, new_figure, render_page

HOSTILE = "<script>alert('x')</script>\"&"


def _page() -> str:
    figure, axes = new_figure()
    axes.plot([0, 1], [1, 0], label=HOSTILE)
    axes.set_xlabel(f"normal_load / N {HOSTILE}")
    axes.legend()
    table = Table(pd.DataFrame({HOSTILE: [HOSTILE, 1.23456]}), caption=HOSTILE, heading=HOSTILE)
    return render_page(
        HOSTILE, [Text([HOSTILE], heading=HOSTILE), table, Figure(figure, HOSTILE)], footer=HOSTILE
    )


def test_hostile_text_is_escaped_everywhere():
    assert "<script" not in _page().lower()


def test_nothing_is_loaded_from_elsewhere():
    page = _page()
    assert not re.search(r"(src|href)\s*=\s*[\"'](?!#)", page.replace("xlink:href", "href"))
    assert "@import" not in page
    assert "url(http" not in page


def test_the_same_figure_gives_the_same_text():
    assert _page() == _page()
    figure, _ = new_figure()
    assert inline_svg(figure).startswith("<svg")


def test_numbers_are_rounded_and_long_tables_counted():
    page = render_page("t", [Table(pd.DataFrame({"x": [1.23456] * 5}), most_rows=2)])
    assert page.count("1.23<") == 2
    assert "3 further rows" in page
