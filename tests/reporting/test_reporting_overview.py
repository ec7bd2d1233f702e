"""The page of all recordings: those of the last run, and every report that earlier runs have left."""

from __future__ import annotations

import json
import re
from types import SimpleNamespace

import pandas as pd
import pytest

from tire_pipeline.datasets import ReportPartsDataset, TextFolderDataset
from tire_pipeline.errors import RecordingError
from tire_pipeline.files import rows_on_disk
from tire_pipeline.files.packed import pack, seal_of
from tire_pipeline.mismatch.inference.learnt.sizes import learnt
from tire_pipeline.reporting.mismatch import mismatch_overview
from tire_pipeline.reporting.mismatch.explain_task import corrected_files
from tire_pipeline.reporting.mismatch.explained_recordings import (
    ExplainParameters,
    collect_explained,
    explain_each,
    refuse_none_explained,
)
from tire_pipeline.reporting.mismatch.mismatch_overview import draw_overview, rows_to_keep
from tire_pipeline.reporting.mismatch.result_names import result_place
from tire_pipeline.tir.sidecar import sidecar_path


def found(recording: str, verdict: str, summary: str) -> list[pd.DataFrame]:
    row = {"recording": recording, "verdict": verdict, "summary": summary, "effects": "camber"}
    return [pd.DataFrame([{**row, "alternatives": "", "held_out": "", "problem": ""}])]


def noted(overview: list[pd.DataFrame]) -> dict[str, bytes]:
    return {place: read() for place, read in rows_to_keep(overview).items()}


def test_a_report_of_an_earlier_run_is_listed_with_what_it_says():
    before, now = found("a/one.csv", "explained", "Camber is missing."), found("two.csv", "agrees", "Same.")
    rows = {**noted(before), **noted(now)}
    page, outcome = draw_overview(now, ["a/one.html", "two.html"], rows)
    assert "Reports of earlier runs" in page
    assert "Camber is missing." in page
    assert 'href="mismatch/a/one.html"' in page
    assert 'href="mismatch/two.html"' in page
    assert outcome == ["1 recording: 1 agrees.", "two.csv: Same."]


def test_a_report_that_the_user_deleted_is_listed_no_longer():
    before, now = found("a/one.csv", "explained", "Camber is missing."), found("two.csv", "agrees", "Same.")
    page, _ = draw_overview(now, ["two.html"], {**noted(before), **noted(now)})
    assert "one.csv" not in page


def test_a_report_of_a_run_that_noted_nothing_is_linked():
    page, _ = draw_overview(found("two.csv", "agrees", "Same."), ["old.html", "two.html"], {})
    assert 'href="mismatch/old.html"' in page
    assert "Open it to see what was found." in page


def test_a_recording_made_again_is_listed_once():
    rows = noted(found("two.csv", "explained", "Camber is missing."))
    page, _ = draw_overview(found("two.csv", "agrees", "Same."), ["two.html"], rows)
    assert "Camber is missing." not in page
    assert page.count('href="mismatch/two.html"') == 1


def test_corrected_files_of_earlier_runs_stay_and_outdated_ones_go(tmp_path):
    corrected = TextFolderDataset(path=str(tmp_path / "corrected"), keep=True)
    corrected.save({"one_corrected.tir": "1", "two_corrected.tir": "2"})
    corrected.save({"two_corrected.tir": None, "three_corrected.tir": "3", "never_corrected.tir": None})
    assert corrected.load() == {"one_corrected.tir": b"1", "three_corrected.tir": b"3"}


def test_recordings_that_differ_by_their_format_alone_have_results_of_their_own():
    names = ["a/run.csv", "a/run.CSV", "a/run.mat", "a/run.tdx", "a/together", "run.csv"]
    assert len({result_place(name, ".html") for name in names}) == len(names)
    assert result_place("a/run.csv", ".html") == "a/run.html"
    rows = noted([part for name in names for part in found(name, "agrees", f"Of {name}.")])
    pages = [result_place(name, ".html") for name in names]
    page, _ = draw_overview(found("new.csv", "agrees", "Same."), pages, rows)
    assert all(f"Of {name}." in page for name in names)


@pytest.mark.parametrize("stem", ["x" * 251, r"\xfc" * 251, "\u00fc" * 125])
def test_results_of_a_long_name_lie_where_they_are_sought(tmp_path, stem):
    recording = f"a/{stem}.csv"
    tir, sidecar = corrected_files(recording)
    assert sidecar == f"{tir}.sidecar.json"
    places = [tir, sidecar, result_place(recording, ".html"), result_place(recording, ".json")]
    dataset = TextFolderDataset(path=str(tmp_path / "made"))
    dataset.save(dict.fromkeys(places, "x"))
    assert set(dataset.load()) == set(places)


def _report() -> SimpleNamespace:
    """What is asked of a report that corrects its model and needs a sidecar for it."""

    def to_tir(path):
        path.write_text("tir")
        sidecar_path(path).write_text("sidecar")

    return SimpleNamespace(
        verdict="explained",
        stated_verdict="explained",
        summary="Wear is missing.",
        notes=[],
        effects=[SimpleNamespace(name="wear", alternatives=(), kind="physics")],
        held_out=None,
        to_dict=dict,
        to_html=lambda path, pages: path.write_text("page"),
        corrected=SimpleNamespace(question=None, to_tir=to_tir),
    )


def test_every_recording_has_results_of_its_own_however_it_is_called(tmp_path, monkeypatch):
    monkeypatch.setattr(
        "tire_pipeline.reporting.mismatch.explain_task.explain_recordings", lambda *_, **__: _report()
    )
    names = ["a/run.csv", "a/run.txt", f"a/{'x' * 251}.csv", "a/" + r"\xfc" * 251 + ".csv"]
    recordings = dict.fromkeys(names, lambda **_: (SimpleNamespace(path="a/model.tir"), pd.DataFrame()))
    reports, _, pages, corrected = collect_explained(explain_each(recordings, ExplainParameters()))
    assert len(reports) == len(pages) == len(names)
    assert sorted(read() for read in corrected.values()) == sorted([b"sidecar", b"tir"] * len(names))
    TextFolderDataset(path=str(tmp_path / "pages")).save(pages)
    TextFolderDataset(path=str(tmp_path / "corrected")).save(corrected)
    assert all((tmp_path / "pages" / name).is_file() for name in pages)
    assert all((tmp_path / "corrected" / name).is_file() for name in corrected)


def test_verdicts_are_counted_in_words():
    names = {"a.csv": "another tire", "b.csv": "another tire", "c.csv": "agrees"}
    overview = [part for name, verdict in names.items() for part in found(name, verdict, "Said.")]
    _, outcome = draw_overview(overview, [], {})
    assert outcome[0] == "3 recordings: 2 seem to be of another tire, 1 agrees."


def test_of_many_recordings_the_first_and_of_earlier_reports_the_newest_are_listed(monkeypatch):
    monkeypatch.setattr(mismatch_overview, "MOST_LISTED", 2)
    now = [part for name in "abcde" for part in found(f"{name}.csv", "agrees", f"Of {name}.")]
    rows, pages = noted(now), [f"{name}.html" for name in "abcde"]
    for name, date in (("x", "2026-01-02 10:00"), ("y", "2026-01-03 10:00"), ("z", "2026-01-01 10:00")):
        said = json.loads(noted(found(f"{name}.csv", "agrees", f"Of {name}."))[f"{name}.json"])
        rows[f"{name}.json"] = json.dumps({**said, "run": date}).encode()
        pages.append(f"{name}.html")
    page, outcome = draw_overview(now, pages, rows)
    assert outcome[0] == "5 recordings: 5 agree."
    assert [name for name in "abcdexyz" if f'href="mismatch/{name}.html"' in page] == ["a", "b", "x", "y"]
    assert "3 more are not listed here. All recordings of the last run are in the table (CSV) below." in page
    assert "1 more is not listed here. The pages of all are in the folder mismatch" in page
    assert page.index("mismatch/y.html") < page.index("mismatch/x.html")
    assert "4 further rows are in the data file." in page


def test_the_table_of_recordings_is_stored_in_parts_in_their_order(tmp_path, monkeypatch):
    def task(name):
        row = {"recording": name, "verdict": "agrees", "summary": f"=Of {name}."}
        members = {"row.json": json.dumps(row).encode(), "report.json": b"{}", "page.html": b""}
        return lambda: pack(members)

    monkeypatch.setattr(rows_on_disk, "REPORT_ROWS", 2)
    names = ["b.csv", "a.csv", "c.csv"]
    _, overview, pages, _ = collect_explained({name: task(name) for name in names})
    stored = ReportPartsDataset(filepath=str(tmp_path / "mismatch_overview.json"))
    stored.save(overview)
    parts = list(stored.load())
    assert [len(part) for part in parts] == [2, 1]
    assert [name for part in parts for name in part["recording"]] == names
    page, outcome = draw_overview(parts, pages, noted(parts))
    assert outcome[0] == "3 recordings: 3 agree."
    assert "Reports of earlier runs" not in page.split("<h2>", 1)[1]


def test_where_none_could_be_explained_each_problem_is_told_up_to_three():
    def task(name):
        row = {"recording": name, "problem": f"{name} has no load"}
        return lambda: pack({"row.json": json.dumps(row).encode(), "report.json": b"null"})

    for names, told in ((["a", "b"], "a: a has no load; b: b has no load"), (list("abcde"), "; and 2 more")):
        _, overview, pages, _ = collect_explained({name: task(name) for name in names})
        page, outcome = draw_overview(
            overview, ["a.html"], noted(found("a", "explained", "Camber is missing."))
        )
        assert not pages
        assert outcome[0] == f"{len(names)} recordings: {len(names)} could not be used."
        assert all(f"{name} has no load" in page for name in names)
        assert page.index("a has no load") < page.index("<h2>Reports of") < page.index("Camber is")
        assert "mismatch_overview.csv" not in page
        with pytest.raises(RecordingError, match=told):
            refuse_none_explained(overview, outcome)


def test_the_page_says_when_the_last_run_was():
    page, _ = draw_overview(found("two.csv", "agrees", "Same."), ["two.html"], {})
    assert re.search(r"The last run was on \d{4}-\d\d-\d\d \d\d:\d\d\.", page)


def test_a_damaged_note_of_an_earlier_run_costs_its_line_only():
    """Half of a note ended the run in a traceback of the JSON reader."""
    now = found("two.csv", "agrees", "Same.")
    for note in (b'{"recording": "a/one', b"\x00\xff", b"[1]"):
        page, _ = draw_overview(now, ["a/one.html", "two.html"], {**noted(now), "a/one.json": note})
        assert 'href="mismatch/a/one.html"' in page
        assert "Open it to see what was found." in page


def test_learnt_sizes_that_are_not_what_was_written_are_refused(tmp_path):
    path = tmp_path / "mismatch_sizes.json"
    path.write_text(json.dumps({"sizes": learnt().to_dict()}))
    path.with_name("mismatch_sizes.json.sha256").write_bytes(seal_of(path.read_bytes()))
    assert explain_each({}, ExplainParameters(learnt=str(path))) == {}
    path.write_text(path.read_text().replace("1", "2", 1))
    with pytest.raises(RecordingError, match=r"mismatch_sizes\.json: these learnt sizes are damaged -> run"):
        explain_each({}, ExplainParameters(learnt=str(path)))
    path.with_name("mismatch_sizes.json.sha256").unlink()
    assert explain_each({}, ExplainParameters(learnt=str(path))) == {}
