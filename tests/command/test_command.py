"""The command ``tire`` as an engineer types it: short results, pages, JSON, errors of one line."""

from __future__ import annotations

import re
import subprocess
import sys
from contextlib import contextmanager

import numpy as np
import pytest
from command_line import COEFFICIENTS, page, run, told

from tire_pipeline.command.cli import COMMANDS, WarningsInOneLine
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.compare import compare_models
from tire_pipeline.tir import read_tir, write_tir

pytestmark = pytest.mark.slow


def test_help_names_every_subcommand_and_imports_none():
    code = (
        "import sys\nfrom tire_pipeline.command.cli import tire\n"
        "try:\n    tire(['--help'])\nexcept SystemExit:\n    pass\n"
        "print(sorted(m for m in sys.modules if 'numpy' in m or 'kedro' in m or 'command.' in m))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert all(f"  {name} " in done.stdout for name in COMMANDS)
    assert done.stdout.splitlines()[-1] == "['tire_pipeline.command.cli']"


@pytest.mark.parametrize("name", COMMANDS)
def test_each_subcommand_has_help_and_the_shared_options(name):
    text = run(name, "--help").stdout
    assert all(option in text for option in ("--json", "--no-page", "--page"))


def test_python_m_runs_the_command(folder):
    call = [sys.executable, "-m", "tire_pipeline.command", "show", "a.tir", "--no-page"]
    done = subprocess.run(call, capture_output=True, text=True, check=True)
    assert "Magic Formula 5.2, nominal load 4 kN" in done.stdout


@pytest.mark.parametrize(
    "call", [("show", "a.tir"), ("compare", "a.tir", "b.tir"), ("convert", "a.tir", "--to", "6.1")]
)
def test_a_subcommand_that_lasts_shows_that_it_works(folder, monkeypatch, call):
    write_tir(TireModel.from_coefficients(COEFFICIENTS).replace(PKY1=-20.0), "b.tir")
    under_way, shown = [], []

    @contextmanager
    def watched(what, now_at=lambda: ""):
        under_way.append(lambda: f"{what} ({now_at()})")
        yield
        under_way.pop()

    def reads(*arguments, **options):
        shown.extend(label() for label in under_way)
        return read_tir(*arguments, **options)

    monkeypatch.setattr("tire_pipeline.progress.under_way", watched)
    monkeypatch.setattr("tire_pipeline.tir.read_tir", reads)
    run(*call, "--no-page")
    assert shown[0] == f"tire ({call[0]})"
    assert not under_way


def test_show_says_version_ranges_and_what_is_missing(folder):
    model = read_tir("a.tir").replace(FZMIN=500.0, FZMAX=9000.0)
    write_tir(model, "b.tir")
    text = run("show", "b.tir").stdout
    assert "At the nominal load: cornering stiffness 1,190 N/deg, largest lateral" in " ".join(text.split())
    assert "There is no combined slip" in text
    assert "There is no aligning moment" in text
    assert "No ranges are stated" not in text
    assert "No ranges are stated" in run("show", "a.tir", "--no-page").stdout
    assert re.search(r"normal load +0\.5 +9 +kN", text)
    found = told("show", "b.tir", "--no-page")
    assert found["version"] == "5.2"
    assert found["ranges"]["normal_load"] == [500.0, 9000.0]
    assert found["coefficients"]["PKY1"] == -22.0
    small = model.forces(slip_angle=1e-6, normal_load=4000.0).fy
    stiffness = found["key_figures"]["cornering stiffness"]["value"]
    assert stiffness == pytest.approx(abs(small) / 1e-6 * np.pi / 180.0, rel=1e-3)
    html = page(folder / "b_show.html")
    assert "<svg" in html
    assert "largest lateral friction" in html


def test_a_line_break_in_a_name_begins_no_line(folder):
    (folder / "a.tir").rename("a\n0 errors.tir")
    lines = run("show", "a\n0 errors.tir", "--no-page").stdout.splitlines()
    assert "a⟨U+000A⟩0 errors.tir" in lines[0]
    assert not any(line.startswith("0 errors") for line in lines)


def test_a_warning_is_a_line_and_said_once(capsys):
    show = WarningsInOneLine()
    for text in ("one\nthing", "one\nthing", "another"):
        show(UserWarning(text))
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 2
    assert all(line.startswith("warning: ") for line in lines)


def test_a_missing_radius_is_said_once_in_the_result(folder):
    without = {name: value for name, value in COEFFICIENTS.items() if name != "UNLOADED_RADIUS"}
    write_tir(TireModel.from_coefficients({**without, "QDZ1": 0.1}), "b.tir")
    shown = run("show", "b.tir", "--no-page")
    assert "there is no UNLOADED_RADIUS" in shown.stdout
    assert "relaxation lengths: forces follow" not in shown.stdout
    assert shown.stderr == ""
    compared = run("compare", "a.tir", "b.tir", "--no-page")
    said = "b.tir states no UNLOADED_RADIUS, so its moments and relaxation lengths cannot be computed"
    assert " ".join(compared.stdout.split()).count(said) == 1
    assert "a.tir states no" not in compared.stdout
    assert compared.stderr == ""


def test_a_radius_that_the_file_lacks_is_stated(folder):
    without = {name: value for name, value in COEFFICIENTS.items() if name != "UNLOADED_RADIUS"}
    write_tir(TireModel.from_coefficients({**without, "QDZ1": 0.1}), "b.tir")
    assert "0 is used" not in run("show", "b.tir", "--no-page").stdout  # nothing stands in for it
    assert told("show", "b.tir", "--no-page")["key_figures"]["largest aligning moment"]["value"] is None
    stated = ("--unloaded-radius", "0.32", "--no-page")
    found = told("show", "b.tir", *stated)
    assert found["key_figures"]["largest aligning moment"]["value"] > 0.0
    run("convert", "b.tir", "--to", "6.1", *stated)
    assert read_tir("b_6.1.tir").coefficients["UNLOADED_RADIUS"] == 0.32


def test_compare_measures_the_forces_apart(folder):
    write_tir(read_tir("a.tir").replace(LMUY=0.9, PKY1=-21.0), "b.tir")
    found = told("compare", "a.tir", "b.tir", "--load", 4000)
    assert set(found["coefficients"]) == {"LMUY", "PKY1"}
    assert found["coefficients"]["PKY1"] == [-22.0, -21.0]
    assert found["differences"]["fx"]["rms"] == 0.0
    assert 0.02 < found["differences"]["fy"]["share"] < 0.11
    assert "Coefficients that differ" in page(folder / "a_against_b.html")
    assert "B minus A" in run("compare", "a.tir", "b.tir").stdout


def test_compare_gives_the_change_from_the_first_file_to_the_second(folder):
    write_tir(read_tir("a.tir").replace(PKY1=1.25 * COEFFICIENTS["PKY1"]), "b.tir")
    for files, change in ((("a.tir", "b.tir"), "+25.0%"), (("b.tir", "a.tir"), "-20.0%")):
        shown = run("compare", *files, "--no-page").stdout.splitlines()
        assert next(line for line in shown if line.startswith("cornering stiffness")).split()[-2] == change


def test_compare_takes_the_camber_in_degrees(folder):
    first = read_tir("a.tir")
    second = first.replace(PHY3=0.05)
    write_tir(second, "b.tir")
    apart = compare_models(first, second, loads=[4000.0], camber=np.radians(3.0))
    wanted = {each.output: each.rms for each in apart}["fy"]
    found = told("compare", "a.tir", "b.tir", "--load", 4000, "--camber", 3, "--no-page")
    assert found["differences"]["fy"]["rms"] == pytest.approx(wanted)
    assert told("compare", "a.tir", "b.tir", "--no-page")["differences"]["fy"]["rms"] == 0.0


def test_compare_gives_the_difference_of_an_output_that_only_one_file_has(folder):
    moment = {"QBZ1": 10.0, "QCZ1": 1.1, "QDZ1": 0.1}
    write_tir(TireModel.from_coefficients({**COEFFICIENTS, **moment}), "b.tir")
    shown = run("compare", "a.tir", "b.tir", "--no-page").stdout
    found = told("compare", "a.tir", "b.tir")["differences"]["mz"]
    line = next(line for line in shown.splitlines() if line.startswith("Mz"))
    assert found["rms"] > 0.0
    assert float(line.split()[1].replace(",", "")) == pytest.approx(found["rms"], rel=1e-3)
    assert "A has no Mz." in shown


def test_compare_states_no_share_of_a_force_that_the_second_file_lacks(folder):
    ahead = [name for name in COEFFICIENTS if name.startswith(("PCX", "PDX", "PEX", "PKX", "PHX", "PVX"))]
    write_tir(TireModel.from_coefficients({n: v for n, v in COEFFICIENTS.items() if n not in ahead}), "b.tir")
    shown = run("compare", "a.tir", "b.tir", "--no-page").stdout
    assert "B has no Fx." in shown
    assert "Fx 0%" not in shown
    assert "-100" not in shown
    slip_stiffness = next(line for line in shown.splitlines() if line.startswith("slip stiffness"))
    assert slip_stiffness.split()[-2] == "–"


def test_compare_warns_of_other_axes(folder):
    write_tir(read_tir("a.tir").replace(PKY1=22.0, PHY3=-0.01), "b.tir")
    assert "the files are in different axes" in " ".join(run("compare", "a.tir", "b.tir").stdout.split())


def test_convert_keeps_the_forces_and_says_what_it_cannot_keep(folder):
    result = told("convert", "a.tir", "--to", "6.1")
    assert read_tir("a_6.1.tir").version == "6.1"
    assert result["differences"]["fy"]["share"] < 1e-12
    assert not re.search(r"[+-]0\.0%", page(folder / "a_6.1_convert.html"))
    assert any("PHY3" in note for note in result["notes"])
    assert "PHY3 has no exact place in 6.1" in (folder / "a_6.1.tir").read_text()
    assert "there is a file of that name" in run("convert", "a.tir", "--to", "6.1", code=2).stderr
    run("convert", "a.tir", "--to", "6.1", "--overwrite", "--no-page")


def test_a_difference_larger_than_the_force_has_no_exponent(folder):
    write_tir(read_tir("a.tir").replace(PDY1=6.0, PKY1=-130.0), "b.tir")
    text = run("compare", "a.tir", "b.tir", "--no-page").stdout
    assert re.search(r"Fy \d\d\d%", text)
    assert "e+" not in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("show", "none.tir"), "none.tir: cannot be read"),
        (("show", "bad.tir"), "bad.tir"),
        (("show", "a.tir", "--page", "a.tir"), "the page is HTML"),
        (("show", "a.tir", "-o", "a.tir"), "the page is HTML"),
        (("compare", "a.tir", "a.tir"), "this file is given twice"),
        (("convert", "a.tir", "--to", "7.0"), "Magic Formula version '7.0' is not known"),
        (("convert", "a.tir", "--to", "6.1", "-o", "a.tir", "--overwrite"), "never changed"),
        (("convert", "a.tir", "--to", "6.1", "-o", "no/such/folder.tir"), "no/such: there is no such folder"),
        (("explain", "a.tir", "none.csv", "-o", "no/such/page.html"), "no/such: there is no such folder"),
        (("explain", "a.tir", "none.csv", "--corrected", "a.tir"), "choose another --corrected"),
        (("check", "none.csv"), "no such file"),
        (("check", "a.tir", "--name", "x"), "'x' is not COLUMN=CHANNEL, such as Kraft_y=fy"),
        (("check", "a.tir", "--unit", "SA"), "'SA' is not COLUMN=UNIT, such as SA=deg"),
        (("show", "."), "this is a folder -> give one .tir file"),
        (("explain", "a.tir", "none.csv"), "no such file"),
        (("translate", "a.tir", "--model", "none"), "there is no such model"),
        (("shw", "a.tir"), "Did you mean 'show'?"),
    ],
)
def test_errors_are_one_line_and_exit_code_2(folder, arguments, message):
    (folder / "bad.tir").write_text("nothing of a tire\n")
    before = (folder / "a.tir").read_bytes()
    result = run(*arguments, code=2)
    assert message in result.stderr
    assert "Traceback" not in result.output
    assert len([line for line in result.stderr.splitlines() if "rror" in line]) == 1
    assert (folder / "a.tir").read_bytes() == before
    assert sorted(path.name for path in folder.iterdir()) == ["a.tir", "bad.tir"]
