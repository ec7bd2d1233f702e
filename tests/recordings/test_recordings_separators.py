"""Text tables with thousands separators and decimal commas are read as what they are."""

import numpy as np
import pytest

from tire_pipeline.errors import RecordingError
from tire_pipeline.recordings import read_recording
from tire_pipeline.recordings.readers.separators import decimal_shown, separators

ROWS = 60
TIME = 100.0 + 0.05 * np.arange(ROWS)
SLIP = 0.1 * np.sin(TIME)
LOAD = np.linspace(550.5, 2750.3, ROWS)
FORCE = -2300.0 * np.sin(TIME)
HEADER = ("time", "slip_angle", "normal_load", "fy")


def american(value: float, digits: int) -> str:
    return f"{value:,.{digits}f}"


def german(value: float, digits: int) -> str:
    return american(value, digits).translate(str.maketrans(",.", ".,"))


def swiss(value: float, digits: int) -> str:
    return f"{value:.{digits}f}".replace(".", ",")


def table(path, write, delimiter, digits=1, quote="", first=0):
    rows = [
        (write(t, 2), write(a, 6), write(z, digits), write(y, digits))
        for t, a, z, y in zip(TIME, SLIP, LOAD, FORCE, strict=True)
    ]
    rows = rows[first:] + rows[:first]
    lines = [delimiter.join(HEADER), *(delimiter.join(f"{quote}{c}{quote}" for c in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("write", "delimiter", "quote"),
    [
        (american, ";", ""),
        (american, "\t", ""),
        (american, ",", '"'),
        (german, ";", ""),
        (german, "\t", ""),
        (german, ",", '"'),
        (swiss, ",", '"'),
        (swiss, ";", ""),
    ],
)
@pytest.mark.parametrize("first", [0, ROWS - 1])
def test_no_row_is_lost_and_the_note_says_so(tmp_path, write, delimiter, quote, first):
    recording = read_recording(table(tmp_path / "run.csv", write, delimiter, quote=quote, first=first))
    assert np.allclose(recording["normal_load"], np.roll(LOAD, -first), atol=0.06)
    assert np.allclose(recording["fy"], np.roll(FORCE, -first), atol=0.06)
    assert np.allclose(recording["slip_angle"], np.roll(SLIP, -first), atol=1e-6)
    noted = [note for note in recording.attrs["notes"] if "separates thousands" in note]
    assert len(noted) == (0 if write is swiss else 2)


@pytest.mark.parametrize("write", [american, german])
def test_whole_numbers_with_a_sign_that_may_be_either_are_asked_about(tmp_path, write):
    with pytest.raises(RecordingError, match=r"normal_load: .* may have a decimal sign or a thousands sep"):
        read_recording(table(tmp_path / "run.csv", write, ";", digits=0))


def test_three_digits_after_a_decimal_comma_are_no_thousands(tmp_path):
    path = tmp_path / "run.csv"
    rows = zip(TIME, SLIP, 2.0 + LOAD / 3000.0, FORCE / 1000.0, strict=True)
    lines = [f"{t:.2f};{a:.6f};{z:.3f};{y:.3f}".replace(".", ",") for t, a, z, y in rows]
    path.write_text("time;slip_angle;FZ [kN];FY [kN]\n" + "\n".join(lines) + "\n")
    recording = read_recording(path)
    assert np.allclose(recording["normal_load"], 2000.0 + LOAD / 3.0, atol=0.6)
    assert np.allclose(recording["fy"], FORCE, atol=0.6)


def test_a_column_that_is_no_channel_is_left_out_with_a_note(tmp_path):
    path = table(tmp_path / "run.csv", american, ";")
    lines = path.read_text().splitlines()
    path.write_text("\n".join([lines[0] + ";counter", *(line + ";1,234" for line in lines[1:])]) + "\n")
    recording = read_recording(path)
    assert "counter" not in recording
    assert (
        "counter: left out, '1,234' may have a decimal sign or a thousands separator"
        in recording.attrs["notes"]
    )


@pytest.mark.parametrize(
    ("cells", "table", "decimal", "thousands"),
    [
        (["2,750.3", "999.5", "2,750"], ".", ".", ","),
        (["2,750", "999.5", "812.25"], ".", ".", ","),
        (["2,750", "999,5"], ",", ",", ""),
        (["2.750,3", "999,5", "2.750"], ".", ",", "."),
        (["1,234,567", "12"], ".", ".", ","),
        (["2,75", "2,751"], ".", ",", ""),
        (["0,123", "2,751"], ".", ",", ""),
    ],
)
def test_the_column_tells(cells, table, decimal, thousands):
    assert separators(cells, table) == (decimal, thousands, "")


@pytest.mark.parametrize(
    "cells",
    [["2,750", "3,125"], ["2,750", "999"], ["2,750", "2.5"], ["2,750", "2750.5"], ["2,750.3", "2.750,3"]],
)
def test_the_column_does_not_tell(cells):
    assert separators(cells, ".").unclear == cells[0]


def test_the_table_tells_its_decimal_sign():
    assert decimal_shown(["2.750", "278,28"]) == ","
    assert decimal_shown(["2,5", "2.5"]) == ""


@pytest.mark.parametrize("unit", ["Grad", "grd", "°"])
def test_german_degrees(tmp_path, unit):
    path = tmp_path / "run.csv"
    path.write_text(f"t [s];SA [{unit}];FZ [N];FY [N]\n" + "".join(f"{k};{k};3000;{k}\n" for k in range(20)))
    assert np.allclose(read_recording(path)["slip_angle"], np.radians(np.arange(20)))


def test_times_of_day_with_a_decimal_comma(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("time;SA;FZ;FY\n" + "".join(f"10:59:{k:02d},25;0,{k};3000;1,{k}\n" for k in range(20)))
    assert np.allclose(read_recording(path)["time"], np.arange(20.0))
