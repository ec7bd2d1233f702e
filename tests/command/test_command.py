"""The command ``tire`` as an engineer types it: short results, pages, JSON, errors of one line."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from contextlib import contextmanager

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from tire_pipeline.command.cli import COMMANDS, WarningsInOneLine, tire
from tire_pipeline.magic_formula import TireModel
from tire_pipeline.magic_formula.parameters.assumed_radius import ASSUMED_RADIUS
from tire_pipeline.tir import read_tir, write_tir

pytestmark = pytest.mark.slow

COEFFICIENTS = {
    "FNOMIN": 4000.0,
    "UNLOADED_RADIUS": 0.32,
    "LONGVL": 16.7,
    "PCY1": 1.35,
    "PDY1": 1.02,
    "PDY2": -0.1,
    "PEY1": -1.2,
    "PKY1": -22.0,
    "PKY2": 2.1,
    "PCX1": 1.6,
    "PDX1": 1.1,
    "PKX1": 22.0,
    "PHY3": 0.01,
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty folder to work in, with a tire."""
    monkeypatch.chdir(tmp_path)
    write_tir(TireModel.from_coefficients(COEFFICIENTS), "a.tir")
    return tmp_path


def record(name: str, *, seed: int = 0, friction: float = 1.0, seconds: float = 80.0) -> None:
    rng = np.random.default_rng(seed)
    time = np.arange(0.0, seconds, 0.02)
    angle = 0.16 * np.sin(2.0 * np.pi * time / 7.0)
    load = np.array([2500.0, 4500.0, 6000.0])[(time // 14.0).astype(int) % 3]
    fy = (
        friction
        * TireModel.from_coefficients(COEFFICIENTS).forces(slip_angle=angle / friction, normal_load=load).fy
    )
    columns = {"time": time, "slip_angle": angle, "normal_load": load}
    noise = 25.0 * rng.standard_normal(time.size)
    pd.DataFrame({**columns, "fy": fy + noise}).to_csv(name, index=False)


def run(*arguments: str, code: int = 0):
    leftovers = dict.fromkeys(("COLUMNS", "FORCE_COLOR", "TTY_COMPATIBLE"))  # of other tests
    each = [str(argument) for argument in arguments]
    result = CliRunner(env=leftovers).invoke(tire, each, catch_exceptions=False)
    assert result.exit_code == code, result.output
    return result


def told(*arguments: str, code: int = 0):
    return json.loads(run(*arguments, "--json", code=code).stdout)


def page(path) -> str:
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"""(src|href)\s*=\s*["'](?!#|data:)""", text.replace("xlink:href", "href"))
    return text


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
    assert "At the nominal load: cornering stiffness 1,192 N/deg, largest lateral" in " ".join(text.split())
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


def test_compare_gives_the_difference_of_an_output_that_only_one_file_has(folder):
    moment = {"QBZ1": 10.0, "QCZ1": 1.1, "QDZ1": 0.1}
    write_tir(TireModel.from_coefficients({**COEFFICIENTS, **moment}), "b.tir")
    shown = run("compare", "a.tir", "b.tir", "--no-page").stdout
    found = told("compare", "a.tir", "b.tir")["differences"]["mz"]
    line = next(line for line in shown.splitlines() if line.startswith("Mz"))
    assert found["rms"] > 0.0
    assert float(line.split()[1].replace(",", "")) == pytest.approx(found["rms"], rel=1e-3)


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


def test_fit_writes_what_was_measured(folder):
    record("run.csv")
    before = (folder / "run.csv").read_bytes()
    found = told("fit", "run.csv", "-o", "out.tir", "--unloaded-radius", "0.305")
    fitted = read_tir("out.tir")
    assert fitted.value("UNLOADED_RADIUS") == 0.305
    assert (folder / "run.csv").read_bytes() == before
    assert fitted.coefficients["PDY1"] == pytest.approx(found["coefficients"]["PDY1"])
    assert found["relative_rms"]["fy"] < 0.01
    angles = pd.read_csv("run.csv")["slip_angle"]
    assert fitted.ranges["slip_angle"][2:] == pytest.approx((angles.min(), angles.max()), abs=1e-6)
    assert "camber" not in fitted.ranges, "one camber is no range"
    there = read_tir("a.tir").forces(slip_angle=0.1, normal_load=4500.0).fy
    assert fitted.forces(slip_angle=0.1, normal_load=4500.0).fy == pytest.approx(there, rel=0.02)
    assert "Points: measured at pure slip" in page(folder / "out_fit.html")
    assert "out.tir" in run("fit", "run.csv", "-o", "out.tir", code=2).stderr


def test_fit_gives_no_residual_of_a_force_that_it_could_not_fit(folder):
    record("run.csv", seconds=30.0)
    pd.read_csv("run.csv").assign(fx=12.0).to_csv("run.csv", index=False)
    found = told("fit", "run.csv", "-o", "out.tir", "--no-page")
    assert "fx" in found["not_fitted"]
    assert "fx" not in found["relative_rms"]
    assert "Fx: recorded, but" in run("fit", "run.csv", "-o", "out2.tir", "--no-page").stdout
    assert "There is no longitudinal force" in run("show", "out.tir", "--no-page").stdout


def test_a_poor_fit_does_not_look_like_a_success(folder):
    record("run.csv", seconds=30.0)
    degrees = pd.read_csv("run.csv").assign(slip_angle=lambda r: np.degrees(r["slip_angle"]))
    degrees.to_csv("run.csv", index=False)
    result = run("fit", "run.csv", "-o", "out.tir")
    lines = result.stdout.split("\n")
    assert lines[1].startswith("POOR FIT of Fy, not to be used:")
    assert "slip_angle looks like degrees" in result.stdout.replace("\n", " ")
    assert "POOR FIT of Fy, not to be used" in page(folder / "out_fit.html")
    assert "POOR FIT of Fy, not to be used" in (folder / "out.tir").read_text()


def test_fit_takes_several_recordings_together(folder):
    record("run1.csv", seconds=30.0)
    record("run2.csv", seed=1, seconds=30.0)
    found = told("fit", "run1.csv", "run2.csv", "-o", "out.tir", "--start", "a.tir", "--no-page")
    assert found["recordings"] == ["run1.csv", "run2.csv"]
    assert any("joined" in note for note in found["notes"])


def test_explain_several_together_and_one_held_out(folder):
    for k, name in enumerate(("one.csv", "two.csv", "three.csv")):
        record(name, seed=k, friction=0.88)
    result = told(
        "explain", "a.tir", "one.csv", "two.csv", "three.csv", "--hold-out", "two.csv", "-o", "report.html",
        "--corrected", "corrected.tir",
    )  # fmt: skip
    assert [effect["name"] for effect in result["effects"]] == ["friction_scale"]
    assert result["recordings"] == ["one.csv", "three.csv"]
    error = result["held_out"]["errors"]["fy"]
    assert error["rms_after"] < 0.5 * error["rms_before"]
    assert read_tir("corrected.tir").coefficients["LMUY"] == pytest.approx(0.88, abs=0.02)
    assert "Tested on a held-out recording" in page(folder / "report.html")
    assert result["written"] == ["corrected.tir", "report.html"]


def test_a_held_out_recording_need_not_be_among_the_explained(folder):
    record("one.csv", friction=0.88, seconds=45.0)
    record("two.csv", seed=1, friction=0.88, seconds=45.0)
    without = {name: value for name, value in COEFFICIENTS.items() if name != "UNLOADED_RADIUS"}
    write_tir(TireModel.from_coefficients(without), "b.tir")
    text = run("explain", "b.tir", "one.csv", "--hold-out", "two.csv", "--no-page").stdout
    assert "On two.csv, which was held out" in text
    assert f"no UNLOADED_RADIUS, and {ASSUMED_RADIUS} m is taken for it" in " ".join(text.split())


def test_what_was_found_is_told_though_no_corrected_file_may_be_written(folder):
    record("run.csv", seconds=30.0)
    wrong = pd.read_csv("run.csv")
    wrong.assign(fy=-wrong["fy"]).to_csv("wrong.csv", index=False)
    result = run("explain", "a.tir", "wrong.csv", "--corrected", "corrected.tir", code=2)
    found = "the recording agrees with the model only in other axes"
    assert "a.tir and wrong.csv: explained, axes open" in result.stdout
    assert re.search(r"sign_convention of (fy|slip_angle)", result.stdout)
    assert found in " ".join(result.stdout.split())
    assert "corrected.tir: nothing corrected is written" in result.stderr
    assert found in page(folder / "a_explain.html")
    assert not (folder / "corrected.tir").exists()


def test_a_difference_larger_than_the_force_has_no_exponent(folder):
    write_tir(read_tir("a.tir").replace(PDY1=6.0, PKY1=-130.0), "b.tir")
    text = run("compare", "a.tir", "b.tir", "--no-page").stdout
    assert re.search(r"Fy \d\d\d%", text)
    assert "e+" not in text


def test_a_file_or_a_pipe_gets_whole_names(folder):
    """Tables were 80 columns wide there, and broke the names of channels."""
    record("run.csv")
    rows = pd.read_csv("run.csv").assign(tread_temperature=60.0, simulated_forces_of_the_other_program=1.0)
    rows.to_csv("run.csv", index=False)
    assert "simulated_forces_of_the_other_program" in run("check", "run.csv", "--no-page").stdout
    (line,) = (e for e in run("check", "run.csv").stdout.splitlines() if e.startswith("tread_temperature "))
    assert len(line) < 200


def test_check_lists_channels_and_fails_on_what_cannot_be_explained(folder):
    record("run.csv")
    found = told("check", "run.csv")
    assert found["usable"]
    assert found["channels"]["fy"]["unit"] == "N"
    assert "<svg" in page(folder / "run_check.html")
    pd.read_csv("run.csv").drop(columns="fy").to_csv("none.csv", index=False)
    assert "cannot be explained" in run("check", "none.csv", "--no-page", code=1).stdout
    renamed = pd.read_csv("run.csv").rename(columns={"fy": "Querkraft"})
    renamed["slip_angle"] = np.degrees(renamed["slip_angle"])
    renamed.to_csv("own.csv", index=False)
    own = told("check", "own.csv", "--name", "Querkraft=fy", "--unit", "slip_angle=deg", "--no-page")
    assert own["channels"]["fy"]["channel"] == "Querkraft"
    assert own["channels"]["slip_angle"]["highest"] == pytest.approx(0.16, abs=1e-3)


def test_check_shows_no_digits_below_those_of_the_channel(folder):
    table = pd.DataFrame({"time": np.arange(50) / 50.0, "slip_angle": np.linspace(-0.2, 0.2, 50) + 3e-9})
    table.assign(normal_load=4000.0, fy=-1e4 * table["slip_angle"]).to_csv("run.csv", index=False)
    row = next(line for line in run("check", "run.csv").stdout.splitlines() if line.startswith("slip_angle"))
    assert row.split()[3:] == ["-0.2", "0", "0.2", "0"]
    assert told("check", "run.csv")["channels"]["slip_angle"]["median"] == pytest.approx(3e-9)


def test_check_has_one_sign_for_what_has_no_unit(folder):
    """It was "-" for a ratio, "none" as the file wrote it, and nothing where no unit was stated."""
    record("run.csv", seconds=5.0)
    rows = pd.read_csv("run.csv").rename(columns={"fy": "fy [N]"}).assign(slip_ratio=0.0, RUN=18.0)
    rows["ratio [none]"] = 0.1
    rows.to_csv("run.csv", index=False)
    shown = {line.split()[0]: line.split() for line in run("check", "run.csv").stdout.splitlines() if line}
    units = {name: row[-5] for name, row in shown.items() if len(row) > 4}
    assert units["fy"] == "N"
    assert {units["slip_ratio"], units["RUN"], units["ratio"]} == {"-"}


def test_the_page_of_a_check_has_the_digits_of_each_channel(folder):
    """The median of a speed of 22.18 to 22.26 m/s was 22, because pressures stand in the same column."""
    record("run.csv", seconds=5.0)
    rows = pd.read_csv("run.csv")
    rows.assign(speed=np.linspace(22.18, 22.26, len(rows)), pressure=250000.0).to_csv("run.csv", index=False)
    run("check", "run.csv")
    (row,) = re.findall(r"<tr><td>speed</td>.*?</tr>", page(folder / "run_check.html"))
    assert re.findall(r">([\d.]+)<", row) == ["22.18", "22.22", "22.26", "0"]


def test_check_says_that_names_tell_the_axes(folder):
    """A TYDEX file was "read as ISO, which is assumed", though its channels name their axes."""
    record("run.csv", seconds=5.0)
    names = {"fy": "FYW", "normal_load": "FZW", "slip_angle": "SLIPANGL"}
    pd.read_csv("run.csv").rename(columns=names).to_csv("tydex.csv", index=False)
    assert (
        "Read with axes by the names of the channels (TYDEX): at a positive"
        in run("check", "tydex.csv").stdout
    )
    assert "Read with ISO W axes, which were not stated: at a positive" in run("check", "run.csv").stdout
    assert "Read with SAE axes, as stated: at a positive" in run("check", "run.csv", "--axes", "SAE").stdout


def test_check_says_what_to_do_about_a_file_of_another_format_or_unit(folder):
    record("run.csv", seconds=1.0)
    assert "-> save it again" in run("check", "run.csv", "--format", "MAT", code=2).stderr
    assert "--unit 'fy=N'" in run("check", "run.csv", "--unit", "fy=deg", code=2).stderr


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
        (("check", "a.tir", "--name", "x"), "'x' is not COLUMN=CHANNEL, such as Querkraft=fy"),
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
