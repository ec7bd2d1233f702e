"""The page of all recordings: those of the last run, and every report that earlier runs have left."""

from __future__ import annotations

import json
from types import SimpleNamespace

import pandas as pd
import pytest

from tire_pipeline.datasets import TextFolderDataset
from tire_pipeline.errors import RecordingError
from tire_pipeline.files.packed import pack
from tire_pipeline.reporting.mismatch.explain_task import corrected_files
from tire_pipeline.reporting.mismatch.explained_recordings import (
    ExplainParameters,
    collect_explained,
    explain_each,
)
from tire_pipeline.reporting.mismatch.mismatch_overview import draw_overview, rows_to_keep
from tire_pipeline.reporting.mismatch.result_names import result_place
from tire_pipeline.tir.sidecar import sidecar_path


def found(recording: str, verdict: str, summary: str) -> pd.DataFrame:
    row = {"recording": recording, "verdict": verdict, "summary": summary, "effects": "camber"}
    return pd.DataFrame([{**row, "alternatives": "", "held_out": "", "problem": ""}])


def test_a_report_of_an_earlier_run_is_listed_with_what_it_says():
    before, now = found("a/one.csv", "explained", "Camber is missing."), found("two.csv", "agrees", "Same.")
    rows = {**rows_to_keep(before), **rows_to_keep(now)}
    page, outcome = draw_overview(now, ["a/one.html", "two.html"], rows)
    assert "Reports of earlier runs" in page
    assert "Camber is missing." in page
    assert 'href="mismatch/a/one.html"' in page
    assert 'href="mismatch/two.html"' in page
    assert outcome == ["1 recording: 1 agrees.", "two.csv: Same."]


def test_a_report_that_the_user_deleted_is_listed_no_longer():
    before, now = found("a/one.csv", "explained", "Camber is missing."), found("two.csv", "agrees", "Same.")
    page, _ = draw_overview(now, ["two.html"], {**rows_to_keep(before), **rows_to_keep(now)})
    assert "one.csv" not in page


def test_a_report_of_a_run_that_noted_nothing_is_linked():
    page, _ = draw_overview(found("two.csv", "agrees", "Same."), ["old.html", "two.html"], {})
    assert 'href="mismatch/old.html"' in page
    assert "Open it to see what was found." in page


def test_a_recording_made_again_is_listed_once():
    rows = rows_to_keep(found("two.csv", "explained", "Camber is missing."))
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
    rows = rows_to_keep(pd.concat([found(name, "agrees", f"Of {name}.") for name in names]))
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
    overview = pd.concat([found(name, verdict, "Said.") for name, verdict in names.items()])
    _, outcome = draw_overview(overview, [], {})
    assert outcome[0] == "3 recordings: 2 seem to be of another tire, 1 agrees."


def test_where_none_could_be_explained_each_problem_is_told_up_to_three():
    def task(name):
        row = {"recording": name, "problem": f"{name} has no load"}
        return lambda: pack({"row.json": json.dumps(row).encode(), "report.json": b"null"})

    for names, told in ((["a", "b"], "a: a has no load; b: b has no load"), (list("abcde"), "; and 2 more")):
        with pytest.raises(RecordingError, match=told):
            collect_explained({name: task(name) for name in names})
