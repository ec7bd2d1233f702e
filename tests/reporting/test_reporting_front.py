"""The front page links what is there and names what is not."""

from __future__ import annotations

import re
from pathlib import Path
from urllib.parse import unquote

from tire_pipeline.reporting import Text, front_page, render_page

TABLES = ("tables/ingest_report.csv", "tables/filter_report.csv")


def _links(page: str) -> list[str]:
    return [unquote(address) for address in re.findall(r'href="([^"]+)"', page)]


def test_an_empty_folder_names_the_command_of_every_report(tmp_path):
    page = front_page(tmp_path)
    assert _links(page) == []
    for command in (
        "kedro run",
        "explain_mismatch",
        "prove_concealed",
        "reproduce_thesis",
        "retrain",
        "translate",
    ):
        assert command in page


def test_every_link_leads_to_a_file_even_with_hostile_names(tmp_path):
    (tmp_path / "mismatch").mkdir()
    for name in ('a"><script>alert(1)</script>.html', "b #?&%.html"):
        (tmp_path / "mismatch" / name.replace("/", "∕")).write_text("<title>&lt;b&gt; tire</title>")
    version = tmp_path / "confusion_matrix.png"
    for when in ("2026-01-01T00.00.00.000Z", "2026-01-02T00.00.00.000Z"):
        (version / when).mkdir(parents=True)
        (version / when / "confusion_matrix.png").write_bytes(b"")
    (tmp_path / "mismatch" / "rig" / "deep").mkdir(parents=True)
    (tmp_path / "tables").mkdir()
    for name in ("mismatch.html", "mismatch/rig/deep/run.html", "translation.html", *TABLES):
        (tmp_path / name).write_text("<title>there</title>")
    (tmp_path / "report.html").write_text("<title>Report</title>")
    page = front_page(tmp_path)
    links = _links(page)
    assert len(links) == 9
    assert {"mismatch.html", "mismatch/rig/deep/run.html", "translation.html", *TABLES} <= set(links)
    for link in links:
        assert Path(tmp_path / link).is_file(), link
    assert any("2026-01-02" in link for link in links)
    assert "<script>" not in page
    assert "<b> tire" not in page
    assert all(f">{name}</a>" in page for name in ("ingest report", "filter report"))
    assert not re.search("https?:", page)


def test_a_recording_is_called_by_its_name_also_where_there_is_but_one(tmp_path):
    (tmp_path / "mismatch" / "rig").mkdir(parents=True)
    (tmp_path / "mismatch" / "rig" / "run 1.html").write_text("<title>run 1.csv</title>")
    assert ">Where recording and simulation differ: rig/run 1</a>" in front_page(tmp_path)


def test_it_begins_with_the_first_sentence_of_each_report_and_its_pictures(tmp_path):
    lead = '<title>x</title><div class="main"><p>From 297 N to 69 N &lt;&amp;.</p><p>More.</p></div>'
    (tmp_path / "report.html").write_text(lead)
    (tmp_path / "mismatch.html").write_text("<title>x</title><p>no main message</p>")
    for name in ("force_curves.png", "confusion_matrix.png"):
        newest = tmp_path / name / "2026-01-02"
        newest.mkdir(parents=True)
        (newest / name).write_bytes(b"")
    page = front_page(tmp_path)
    assert page.index("From 297 N to 69 N &lt;&amp;.") < page.index("Tables (CSV)")
    assert "More." not in page
    assert "no main message" not in page
    for name in ("force_curves.png", "confusion_matrix.png"):
        assert page.index(f'<img src="{name}/2026-01-02/{name}"') < page.index("Tables (CSV)")


def test_a_command_in_the_first_sentence_of_a_report_is_set_as_code(tmp_path):
    """It stood there as <code>kedro run</code>, with the angle brackets."""
    text = Text(["`kedro run` translates <code> all."], emphasis=True)
    (tmp_path / "report.html").write_text(render_page("Report", [text]))
    assert "<code>kedro run</code> translates &lt;code&gt; all." in front_page(tmp_path)


def test_a_table_is_listed_with_what_it_holds(tmp_path):
    (tmp_path / "tables").mkdir()
    for name in ("splits", "other"):
        (tmp_path / "tables" / f"{name}.csv").write_text("a\n")
    page = front_page(tmp_path, {"splits": "Training or test, for each file.", "absent": "Not there."})
    assert "Training or test, for each file. 20" in page  # and the date
    assert "Not there." not in page
