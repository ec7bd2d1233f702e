"""Pages hold everything they need, and nothing of what they show can act."""

import html
import io
import re
import warnings
from itertools import pairwise

import pandas as pd

from tire_pipeline.pages.drawing import name_ticks
from tire_pipeline.pages.safe_page import source_hash
from tire_pipeline.reporting import Figure, Links, Table, Text, inline_svg, new_figure, render_page

HOSTILE = "<script>alert('x')</script>\"&\u202e$\\frac$"


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


def test_a_figure_that_is_higher_than_wide_may_fill_a_printed_page():
    """The channels of a recording, one panel each, were printed as small as a single panel."""
    high, _ = new_figure(11, 1, width=9.0, height=13.0)
    low, _ = new_figure()
    assert 'class="tall"' in render_page("t", [Figure(high)])
    assert 'class="tall"' not in render_page("t", [Figure(low)])


def test_numbers_are_rounded_and_long_tables_counted():
    page = render_page("t", [Table(pd.DataFrame({"x": [1.23456] * 5}), most_rows=2)])
    assert page.count("1.23<") == 2
    assert "3 further rows" in page


def test_coefficients_have_the_digits_that_they_were_given():
    frame = pd.DataFrame({"coefficient": ["R0", "CZ", "LONGVL"], "value": [0.376, 175000.0, 16.7]})
    cells = [row[1][0] for row, _ in Table(frame, digits=8, unlike=True).rows]
    assert cells == ["0.376", "175,000", "16.7"]


def test_a_column_has_one_number_of_decimals_unless_a_small_value_would_be_lost():
    frame = pd.DataFrame(
        {"ratio": [0.143, 0.1304, 1.03], "mixed": [250.0, 0.02, 3.0], "name": ["a", "b", "c"]}
    )
    table = Table(frame)
    cells = [[text for text, _ in row] for row, _ in table.rows]
    assert cells == [["0.14", "250", "a"], ["0.13", "0.02", "b"], ["1.03", "3", "c"]]
    assert table.heads == [("ratio", True), ("mixed", True), ("name", False)]
    page = render_page("t", [table])
    assert '<th scope="col" class="number">ratio</th>' in page
    assert '<th scope="col">name</th>' in page


def test_a_command_is_set_as_code_and_nothing_of_it_is_markup():
    page = render_page("t", [Text(["run `a <b>` now"]), Links([("x.html", "x", "made by `y`")])])
    assert "run <code>a &lt;b&gt;</code> now" in page
    assert "made by <code>y</code>" in page


def test_the_policy_names_the_one_style_and_allows_attributes_only_beside_figures():
    page = _page()
    policy = html.unescape(re.search(r'Content-Security-Policy" content="([^"]+)"', page)[1])
    (style,) = re.findall(r"<style[^>]*>(.*?)</style>", page, re.S)
    assert f"style-src {source_hash(style)};" in policy
    assert policy.startswith("default-src 'none'; ")
    assert "script-src" not in policy
    assert "style-src-attr 'unsafe-inline'" in policy
    plain = render_page("t", [Text(["no figure"])])
    assert "unsafe-inline" not in plain
    assert not re.search(r"\sstyle\s*=", plain)


def test_direction_characters_are_shown_and_a_dollar_is_a_dollar():
    page = _page()
    assert "\u202e" not in page
    assert page.count("⟨U+202E⟩$\\frac$") == page.count("alert(")


def test_a_logarithmic_axis_keeps_its_powers_beside_names_with_dollars():
    figure, axes = new_figure()
    axes.plot([0, 1], [1, 1000])
    axes.set_yscale("log")
    axes.set_xticks([0, 1], ["$\\frac$", "a$b"])
    svg = inline_svg(figure)
    assert ">$\\frac$</text>" in svg
    assert ">$\\mathdefault" not in svg


def test_percentages_stand_on_the_right_with_their_dashes():
    frame = pd.DataFrame({"change": ["+1.2%", "–"], "share": ["5% of it", "–"], "none": ["–", "–"]})
    table = Table(frame)
    assert table.heads == [("change", True), ("share", False), ("none", False)]
    assert [[number for _, number in row] for row, _ in table.rows] == [[True, False, False]] * 2


def test_a_table_without_rows_says_none_and_nothing_is_a_dash():
    page = render_page("t", [Table(pd.DataFrame({"file": []}), heading="Files that cannot be read")])
    assert "<p>None.</p>" in page
    assert "<table" not in page
    (row,) = Table(pd.DataFrame({"released": [None]}, dtype=object)).rows
    assert row[0] == [("–", False)]


def test_long_names_leave_room_for_the_figure():
    """Names of twenty letters and more overlapped, and left the axes no room at all."""
    names = [f"Tire Testing Centre \u202eNumber {k}, Hall B" for k in range(6)]
    figure, axes = new_figure(width=4.0, height=4.0)
    name_ticks(axes.xaxis, names)
    name_ticks(axes.yaxis, names)
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # Matplotlib warns where axes have no room
        figure.canvas.draw()
    labels = axes.get_xticklabels()
    boxes = [label.get_window_extent() for label in labels]
    assert not any(one.overlaps(other) for one, other in pairwise(boxes))
    assert [label.get_text()[-6:] for label in labels] == ["Hall B"] * 6


def test_a_picture_shows_direction_characters_too():
    figure, axes = new_figure()
    axes.set_title("a\u202ex.tir")
    figure.savefig(io.BytesIO(), format="png")
    assert axes.get_title() == "a⟨U+202E⟩x.tir"
