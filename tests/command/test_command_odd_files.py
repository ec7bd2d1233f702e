"""``tire show``, ``compare`` and ``translate`` on files that lack something or contradict themselves."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from command_line import COEFFICIENTS, page, run, told

from tire_pipeline.magic_formula import TireModel
from tire_pipeline.tir import read_tir, write_tir

pytestmark = pytest.mark.slow


def figures(file):
    found = told("show", file, "--no-page")["key_figures"]
    return {name: each["value"] for name, each in found.items()}


def without(*names):
    write_tir(TireModel.from_coefficients({n: v for n, v in COEFFICIENTS.items() if n not in names}), "b.tir")


@pytest.mark.parametrize(
    ("lacking", "said"),
    [
        ("PDY1", "There is no side force: PDY1 is 0 or missing."),
        ("PKY1", "The side force does not follow the slip angle: the cornering stiffness (PKY1) is 0."),
    ],
)
def test_what_is_left_of_a_side_force_without_level_or_stiffness_is_no_friction(folder, lacking, said):
    """An offset was the largest lateral friction, beside a stiffness of a force that is not there."""
    without(lacking)
    write_tir(read_tir("b.tir").replace(PVY1=0.02), "c.tir")
    found = figures("c.tir")
    assert found["cornering stiffness"] is None
    assert found["largest lateral friction"] is None
    assert found["slip stiffness"] > 0.0
    assert said in " ".join(run("show", "c.tir", "--no-page").stdout.split())


def test_files_of_no_load_in_common_are_not_compared_unless_one_is_stated(folder):
    """Newtons read as kN were "in other axes", and differed by 2e26%."""
    ranged = read_tir("a.tir").replace(FZMIN=1500.0, FZMAX=8000.0)
    write_tir(ranged, "b.tir")
    Path("c.tir").write_text(Path("b.tir").read_text().replace("'newton'", "'kilonewton'"))
    error = run("compare", "b.tir", "c.tir", code=2).stderr
    assert "no normal load at which both files are valid: b.tir from 1,500 to 8,000 N, c.tir from" in error
    assert "FNOMIN = 4e+06 N is implausible" in error
    assert "At 4,000 N" in run("compare", "b.tir", "c.tir", "--load", 4000, "--no-page").stdout


def test_what_is_unusual_in_a_file_is_said_where_it_is_compared(folder):
    text = Path("a.tir").read_text()
    line = next(line for line in text.splitlines() if line.startswith("PKY1"))
    Path("b.tir").write_text(text.replace(line, f"{line}\nPKY1 = -30"))
    said = " ".join(run("compare", "a.tir", "b.tir", "--no-page").stdout.split())
    assert "b.tir: PKY1 has two values" in said
    assert "a.tir: " not in said
    assert "1 coefficient differs." in said


def test_compare_says_that_a_left_tire_stands_beside_a_right_one(folder):
    text = Path("a.tir").read_text()
    for side in ("LEFT", "RIGHT"):
        Path(f"{side}.tir").write_text(text.replace("[MODEL]", f"[MODEL]\nTYRESIDE = '{side}'"))
    said = " ".join(run("compare", "LEFT.tir", "RIGHT.tir", "--no-page").stdout.split())
    assert "A is a left tire and B a right one: each is taken as it was measured" in said
    assert "tire and B" not in run("compare", "a.tir", "LEFT.tir", "--no-page").stdout


def test_compare_has_no_figure_of_a_moment_that_neither_file_has(folder):
    write_tir(read_tir("a.tir").replace(PKY1=-21.0), "b.tir")
    shown = run("compare", "a.tir", "b.tir", "--no-page").stdout
    (moment,) = [line for line in shown.splitlines() if line.startswith("Mz")]
    assert moment.split()[1:3] == ["–", "–"]


@pytest.mark.parametrize(
    ("turned", "said"),
    [
        (
            {"PKY1": 22.0},
            "a positive slip angle gives a positive Fy (PKY1 = 22)",
        ),
        (
            {"PKY2": -2.1},
            "a positive slip angle gives a positive Fy (PKY1 = -22)",
        ),
        (
            {"PKX1": -22.0},
            "a positive slip ratio gives a negative Fx (PKX1 = -22)",
        ),
    ],
)
def test_a_force_of_the_other_sign_than_in_iso_axes_is_said(folder, turned, said):
    write_tir(read_tir("a.tir").replace(**turned), "b.tir")
    shown = " ".join(run("show", "b.tir", "--page", "b.html").stdout.split())
    assert shown.count(said) == 1
    assert "note: F" not in shown
    assert page(Path("b.html")).count(said) == 1
    assert said in " ".join(run("compare", "a.tir", "b.tir").stdout.split())
    for name in ("a.tir", "examples/tire.tir"):
        usual = Path(__file__).parents[2] / name if "/" in name else name
        assert "ISO W" not in run("show", usual, "--no-page").stdout


def test_a_stiffness_that_no_tire_has_is_said_and_is_no_row_of_digits(folder):
    """A stiffness of 32 digits stood in the first sentence, without a word."""
    write_tir(read_tir("a.tir").replace(PKY1=-1e30, PDX1=12.0), "b.tir")
    shown = " ".join(run("show", "b.tir", "--no-page").stdout.split())
    assert "PKY1 = -1e+30 is implausible: no tire is so stiff for its load" in shown
    assert "PDX1 = 12 is implausible: no tire has such a friction" in shown
    assert re.search(r"cornering stiffness 5\.\d+e\+31 N/deg", shown)


def test_show_has_no_row_for_the_peak_of_a_force_that_is_not_there(folder):
    without("PDX1", "PCX1", "PKX1")
    shown = run("show", "b.tir", "--no-page").stdout
    assert "slip ratio of the peak" not in shown
    assert "slip angle of the peak" in shown
    assert "slip ratio of the peak" in run("show", "a.tir", "--no-page").stdout


@pytest.mark.parametrize(("shift", "told_so"), [(-0.04, True), (0.04, False)], ids=["mirrored", "as a tire"])
def test_a_file_whose_camber_pushes_the_wrong_way_is_told(folder, shift, told_so):
    """``PHY3`` shifts the slip angle with camber: the other way round the wheel runs away from its lean."""
    write_tir(TireModel.from_coefficients({**COEFFICIENTS, "PHY3": shift}), "b.tir")
    said = " ".join(run("show", "b.tir", "--no-page").stdout.split())
    assert ("away from the side to which the wheel leans" in said) is told_so
    assert (figures("b.tir")["camber stiffness"] < 0.0) is told_so


@pytest.mark.parametrize(
    "arguments",
    [("--load", "-5"), ("--load", "nan"), ("--load", "inf"), ("--camber", "95"), ("--camber", "nan")],
)
def test_a_load_or_camber_that_cannot_be_is_refused(folder, arguments):
    """At infinite load two files differed by 3e17 N."""
    for call in (("show", "a.tir"), ("compare", "a.tir", "b.tir")):
        error = run(*call, *arguments, code=2).stderr
        assert f"Invalid value for '{arguments[0]}'" in error


def test_a_name_that_is_not_utf8_is_shown_and_json_can_be_read(folder):
    """With a strict terminal --json ended in a traceback; the page's name was printed in another way."""
    odd = os.fsdecode(b"m\xfcnchen.tir")
    Path(odd).write_bytes(Path("a.tir").read_bytes())
    assert run("show", odd).stdout.endswith("written: m\\xfcnchen_show.html\n")
    assert Path(os.fsdecode(b"m\xfcnchen_show.html")).is_file()
    found = told("show", odd)
    assert (found["file"], found["written"]) == ("m\\xfcnchen.tir", ["m\\xfcnchen_show.html"])
