"""``tire check``: the channels of a recording, and what cannot be explained."""

from __future__ import annotations

import re

import numpy as np
import pandas as pd
import pytest
from command_line import page, record, run, told

pytestmark = pytest.mark.slow


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
    renamed = pd.read_csv("run.csv").rename(columns={"fy": "Kraft_y"})
    renamed["slip_angle"] = np.degrees(renamed["slip_angle"])
    renamed.to_csv("own.csv", index=False)
    own = told("check", "own.csv", "--name", "Kraft_y=fy", "--unit", "slip_angle=deg", "--no-page")
    assert own["channels"]["fy"]["channel"] == "Kraft_y"
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


def test_adapted_sae_axes_can_be_stated(folder):
    """The check asked for axes="adapted SAE", and --axes refused them."""
    record("run.csv", seconds=5.0)
    rows = pd.read_csv("run.csv")
    rows.assign(slip_angle=-rows["slip_angle"]).to_csv("turned.csv", index=False)
    assert "--axes adapted-SAE" in run("check", "turned.csv", "--no-page").stdout
    for stated in ("adapted-SAE", "turned.csv:adapted_sae"):
        shown = run("check", "turned.csv", "--axes", stated, "--no-page").stdout
        assert "at a positive slip angle the side force is negative, as in ISO W." in shown
        assert "adapted-SAE" not in shown
    assert "is not ISO, SAE or adapted-SAE" in run("check", "turned.csv", "--axes", "XYZ", code=2).output


def test_check_says_the_rate_and_which_sign_the_side_force_has(folder):
    record("run.csv", seconds=5.0)
    shown = run("check", "run.csv", "--no-page").stdout
    assert "CSV, 250 samples over 4.98 s at 50 Hz." in shown
    assert "at a positive slip angle the side force is negative, as in ISO W." in shown
    rows = pd.read_csv("run.csv")
    rows.assign(fy=-rows["fy"]).to_csv("turned.csv", index=False)
    assert "the side force is positive, unlike in ISO W" in run("check", "turned.csv", "--no-page").stdout
    rows.assign(fy=rows["fy"].abs()).to_csv("lost.csv", index=False)
    assert "the side force does not follow the slip angle" in run("check", "lost.csv", "--no-page").stdout


def test_a_column_may_have_an_equals_sign_in_its_name(folder):
    record("run.csv", seconds=5.0)
    pd.read_csv("run.csv").rename(columns={"fy": "F=ma"}).to_csv("own.csv", index=False)
    found = told("check", "own.csv", "--name", "F=ma=fy", "--unit", "F=ma=kN", "--no-page")
    assert found["channels"]["fy"]["channel"] == "F=ma"
    assert found["channels"]["fy"]["highest"] > 1e6


def test_check_says_what_to_do_about_a_file_of_another_format_or_unit(folder):
    record("run.csv", seconds=1.0)
    assert "-> save it again" in run("check", "run.csv", "--format", "MAT", code=2).stderr
    assert "--unit 'fy=N'" in run("check", "run.csv", "--unit", "fy=deg", code=2).stderr


def test_of_many_columns_of_no_known_name_the_terminal_shows_the_first(folder):
    """2,000 lines of the table hid what was said above it."""
    record("run.csv")
    table = pd.read_csv("run.csv")
    more = pd.DataFrame({f"bus_{number}": 0.0 for number in range(300)}, index=table.index)
    pd.concat([more, table], axis=1).to_csv("log.csv", index=False)
    printed = run("check", "log.csv").stdout
    assert len(printed.splitlines()) < 60
    assert "--json has 280 more columns of no known name" in printed
    assert "bus_19 " in printed
    assert "\nfy " in printed
    assert len(told("check", "log.csv", "--no-page")["channels"]) == 300 + len(table.columns)
